#pragma once
// Reads a result folder as a run of a report.
#include <filesystem>

#include "report/report.hpp"

namespace railstrata {

/// Reads a folder of `run` or `bem`. A position_<mm> folder takes case, provenance and history from the folder it
/// stands in. Throws CaseError as read_result_folder does.
ReportRun read_report_run(const std::filesystem::path& folder);

}  // namespace railstrata
