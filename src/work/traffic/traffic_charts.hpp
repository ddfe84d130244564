#pragma once
// Pictures of a rail through its traffic (traffic/traffic_page.hpp).
#include "report/report.hpp"
#include "traffic/traffic_page.hpp"

namespace railstrata {

/// Over gross tonnes: shares of ductility, closed cycles and fatigue that are used, up to the failure; removed depth
/// and the layer that is left as shares of round depths; grindings as upright lines.
ReportChart way_chart(const FollowedTraffic& traffic);

/// The head, new and at the end, with the layer's bottom and the place of the first failure, or of the most used metal:
/// depths below the new surface drawn large.
ReportChart failure_chart(const FollowedTraffic& traffic);

/// Lives until the first damage with each input at its ends, the one that decides at the top.
ReportChart deciding_chart(const TrafficRange& range);

}  // namespace railstrata
