#pragma once
// What a followed rail rests on, with the keys of the case.
#include "report/report.hpp"
#include "traffic/traffic_page.hpp"

namespace railstrata {

/// A row for each: what, its value, its range where it has one, the key that changes it.
ReportTable assumptions_table(const FollowedTraffic& traffic);

}  // namespace railstrata
