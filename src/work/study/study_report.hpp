#pragma once
// The report of a study: figures and trends, all drawn from the study's table and its result folders.
#include <vector>

#include "many/case_row.hpp"
#include "report/report.hpp"
#include "study/study_file.hpp"

namespace railstrata {

/// The report; `folder` of the entries is where it can be opened. Full runs are those the maps show; the verdict is
/// over all cases: those of each, and every finite element case against its half-space case (limits of report_checks).
Report study_report(const StudySpec& study, const std::vector<CaseRow>& entries);

}  // namespace railstrata
