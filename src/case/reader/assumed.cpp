#include "reader/assumed.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <initializer_list>
#include <vector>

#include "reader/case_tree.hpp"
#include "text/units.hpp"

namespace railstrata {

std::string assumed_in(const LoadedCase& loaded, const Use& use) {
  const CaseSpec& spec = loaded.spec;
  CaseSource source(loaded.file, loaded.source_text);
  static_cast<void>(read_case_tree(source, loaded.overrides));
  const auto gives = [&](std::initializer_list<const char*> keys) {
    return std::any_of(keys.begin(), keys.end(), [&](const char* key) { return source.has(key); });
  };
  const auto each_row = [&](std::optional<double> LoadSpec::*value) {
    return !spec.loads.empty() && std::all_of(spec.loads.begin(), spec.loads.end(),
                                              [=](const LoadSpec& row) { return (row.*value).has_value(); });
  };
  std::vector<std::string> out;
  if (spec.run.rolling && !each_row(&LoadSpec::friction_coefficient) &&
      !gives({"drive.friction_coefficient", "friction.condition", "friction.lateral_table"}))
    out.push_back(fmt::format("friction coefficient {}", spec.drive.friction_coefficient));
  if (!each_row(&LoadSpec::wheel_load) && spec.transient.wheel_load.empty() &&
      !gives(
          {"vehicle.wheel_load", "vehicle.axle_load", "vehicle.sprung_mass", "vehicle.wheel_mass", "vehicle.approach"}))
    out.push_back(fmt::format("wheel load {:.4g} kN", 1e-3 * spec.vehicle.load()));
  if (use.is(uses::kCollective) && !gives({"collective.wear_factor"}))
    out.push_back(fmt::format("wear factor {} (dry laboratory surfaces)", spec.collective.wear_factor));
  return out.empty() ? "" : fmt::format("assumed, for the case does not give them: {}", fmt::join(out, ", "));
}

}  // namespace railstrata
