#include "post/plausibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "post/check_limits.hpp"

namespace railstrata {
namespace {

double largest_von_mises(const StressSummary& s) {
  double most = 0;
  for (const auto& pair : {s.surface, s.subsurface, s.layer, s.interface, s.matrix})
    if (pair && pair->von_mises.value > most) most = pair->von_mises.value;
  return most;
}

}  // namespace

std::vector<Warning> implausible(const Summary& s, const CaseSpec& spec) {
  std::vector<Warning> out;
  const double width = s.contact.patch.width;
  const auto warn_above = [&](std::string_view name, double value, double limit) {
    const CheckRow& row = check_row(name);
    if (value > limit)
      out.push_back({.name = std::string(name),
                     .value = value,
                     .limit = limit,
                     .text = fmt::format("{} [{}]: {}", row.what, row.unit.si(), row.advice)});
  };
  double narrowest = HUGE_VAL;
  for (const LayerSpec& layer : spec.layers) narrowest = std::min(narrowest, layer.width);
  warn_above("patch_wider_than_layer", width, narrowest);
  if (s.run.engine == Engine::fem)
    warn_above("patch_near_border_of_fine_zone", width, spec.mesh.fine_width - 2 * spec.mesh.element_size);
  warn_above("von_mises_above_common_rail_yield", largest_von_mises(s.rail), kCommonRailYield);
  return out;
}

}  // namespace railstrata
