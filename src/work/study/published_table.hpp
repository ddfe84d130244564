#pragma once
// A study's results beside published numbers and statements, as tables of its report.
#include <vector>

#include "study/study_report.hpp"

namespace railstrata {

/// Every published number beside ours, with the difference and a reason that follows from the runs: agrees; mesh
/// artefact; other definition; not explained; no result yet.
ReportTable published_table(const Published& published, const std::vector<CaseRow>& entries);
/// Every published statement: confirmed or not, by which numbers.
ReportTable claims_table(const Published& published, const std::vector<CaseRow>& entries);

}  // namespace railstrata
