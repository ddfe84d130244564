#pragma once
// Whether to trust the runs of a report.
#include <string>
#include <vector>

#include "report/report.hpp"

namespace railstrata {

/// The checks of each run, and every finite element run against a half-space run of the same case (limits:
/// judge/check_limits.hpp; largest von Mises stress below the rail's surface where it lies deeper than an element). The
/// peak of q at the border of stick and slip is as narrow as a cell shows it: q_max is compared on cells as large as
/// the elements where that solution is there (shear_on_elements). For two runs of different cases the options that
/// differ are listed.
std::vector<ReportCheck> report_checks(const std::vector<ReportRun>& runs);

/// Whether each run lasts (judge/judgement.hpp), of those whose case gives a strength; named where there are several.
std::vector<ReportAnswer> run_answers(const std::vector<ReportRun>& runs);

/// The verdict of the page in one line: "all 13 checks hold", "1 of 13 checks fails: Largest shear 9.52 %, limit 7 %".
struct ReportVerdict {
  bool ok = false;
  std::string text;
};
ReportVerdict verdict_of(const Report& report);

}  // namespace railstrata
