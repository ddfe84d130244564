#pragma once
// What stands first on the page of a rail that was followed through its traffic: the verdict, the way over gross
// tonnes, the rail's head with the place that fails first, what decides the range, and every assumption with its key.
#include <string>
#include <vector>

#include "clock/clock.hpp"
#include "collective/collective.hpp"
#include "collective/collective_files.hpp"
#include "traffic/traffic_range.hpp"

namespace railstrata {

struct FollowedTraffic {
  const CaseSpec& spec;
  const std::vector<CollectiveRow>& rows;  ///< on the unworn profile
  const RailDamage& unworn;                ///< of these rows
  const TrafficRange& range;               ///< of one run: nothing is known of the range
  double horizon = 0;                      ///< kg
  double cell = 0;                         ///< m
  const ClockResult& best() const { return range.runs.front().result; }
  bool has_range() const { return range.runs.size() > 1; }
};

/// First crack or none, the layer, what decides the range, what is not known.
std::vector<ReportAnswer> traffic_answers(const FollowedTraffic& traffic);

/// For write_collective_page.
CollectiveFront traffic_front(const FollowedTraffic& traffic);

}  // namespace railstrata
