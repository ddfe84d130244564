#pragma once
// A report with another page inside.
#include "report/framed_page.hpp"
#include "runs/write_report.hpp"

namespace railstrata {

/// The case of a result folder: of a position that of the run's folder. The file need not be there.
std::filesystem::path case_file_of(const std::filesystem::path& folder);

/// Like write_report, with `what_if` in a frame; its text may be empty.
WrittenPage write_framed_report(const std::filesystem::path& page, const std::vector<std::filesystem::path>& folders,
                                bool reference, const FramedPage& what_if);

}  // namespace railstrata
