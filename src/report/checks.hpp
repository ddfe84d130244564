#pragma once
// Whether to trust the runs of a report.
#include <vector>

#include "report/report.hpp"

namespace railstrata {

/// What the runs say of themselves, and every finite element run against a half-space run of the same case (limits:
/// p_max 4 %, patch length 6 %, q_max 7 %, largest von Mises stress below the rail's surface 8 % where it lies deeper
/// than an element). Of two runs of different cases it is told which options differ.
std::vector<ReportCheck> report_checks(const std::vector<ReportRun>& runs);

}  // namespace railstrata
