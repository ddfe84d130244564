#include "post/plausibility.hpp"

#include <algorithm>
#include <cmath>

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
  const double width = s.contact.patch_width;
  auto warn_above = [&](const char* name, double value, double limit, const char* text) {
    if (value > limit) out.push_back({name, value, limit, text});
  };
  double narrowest = HUGE_VAL;
  for (const LayerSpec& layer : spec.layers) narrowest = std::min(narrowest, layer.width);
  warn_above("patch_wider_than_layer", width, narrowest,
             "the contact patch is wider than the layer [m]: a larger layer.width holds it");
  if (s.run.engine == Engine::fem)
    warn_above("patch_near_border_of_fine_zone", width, spec.mesh.fine_width - 2 * spec.mesh.element_size,
               "the contact patch nearly fills the fine mesh [m]: a larger mesh.fine_width gives it room");
  warn_above("von_mises_above_common_rail_yield", largest_von_mises(s.rail), kCommonRailYield,
             "the elastic stress in the rail is above the proof stress of common rail steels [Pa]: a real rail would "
             "yield there, and shake down or wear");
  return out;
}

}  // namespace railstrata
