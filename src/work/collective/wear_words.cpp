#include "collective/wear_words.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/summary_json.hpp"
#include "judge/check_limits.hpp"
#include "judge/plausibility.hpp"

namespace railstrata {
namespace {

/// Of a solved row; null: there is none.
const DamageSummary* damage_of_any(const std::vector<CollectiveRow>& rows) {
  const auto any = std::find_if(rows.begin(), rows.end(), [](const CollectiveRow& r) { return r.sound(); });
  return any == rows.end() ? nullptr : &any->summary.damage;
}

}  // namespace

std::string steel_words(const std::vector<CollectiveRow>& rows, WearLaw law) {
  const DamageSummary* damage = damage_of_any(rows);
  if (!damage || (law != WearLaw::usfd && damage->rail_steel.source != WearSource::given)) return {};
  return law == WearLaw::archard ? "" : "wear of the rail " + damage->rail_steel.text;
}

std::string map_words(const std::vector<CollectiveRow>& rows, WearLaw law) {
  MapShares all;
  for (const CollectiveRow& row : rows)
    for (const PatchDamage& patch : row.patches)
      for (const StreamlineRow& line : patch.rows)
        if (row.sound()) all.add(row.passages * line.width, line.kth_depth, line.kth_seized, line.kth_fast);
  if (law != WearLaw::kth || !(all.outside() > kLargestOutsideMap)) return {};
  return fmt::format("{:.0f} % of the wear lies outside Jendel's map and is not to be believed: {}",
                     100 * all.outside(), outside_words(all));
}

std::string free_words(const std::vector<CollectiveRow>& rows) {
  const auto free = std::count_if(rows.begin(), rows.end(), [](const CollectiveRow& row) {
    return !row.given.traction_coefficient && !row.given.creepage && row.spec.drive.traction() == 0.0;
  });
  if (free == 0) return {};
  return fmt::format("{} of {} loads give no traction and roll free (drive.traction_coefficient = 0)", free,
                     rows.size());
}

nlohmann::ordered_json wear_of_steels(const std::vector<CollectiveRow>& rows) {
  const DamageSummary* any = damage_of_any(rows);
  return any ? steels_json(*any) : nlohmann::ordered_json::object();
}

}  // namespace railstrata
