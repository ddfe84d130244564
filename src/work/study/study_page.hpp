#pragma once
// The page of a study.
#include <filesystem>
#include <vector>

#include "report/checks.hpp"
#include "study/published.hpp"
#include "study/study_file.hpp"
#include "study/study_results.hpp"

namespace railstrata {

/// Writes the page into the study's folder: its figures, tables and checks over all cases that are done; beside it
/// published.csv and claims.csv if the study compares. Returns the verdict that stands on it. Throws CaseError for a
/// result that cannot be read, EnvironmentError for the disk.
ReportVerdict write_study_page(const std::filesystem::path& page, const LoadedStudy& study, const Published& published,
                               std::vector<CaseRow> rows);

}  // namespace railstrata
