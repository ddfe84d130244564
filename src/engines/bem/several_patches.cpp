#include "bem/several_patches.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bem/pressure_on_rail.hpp"
#include "bem/wheel_on_patches.hpp"

namespace railstrata {

SharedLoad share_load(const CaseSpec& spec, const Placement& placement, double descent, const BemOptions& options) {
  std::vector<ContactPlace> places = places_of(spec, placement, descent);
  std::vector<std::vector<BemStart>> smooth;
  for (;;) {
    put_in_order(places);
    SharedLoad alone;
    alone.descent = descent;
    alone.smooth = smooth;
    std::vector<PatchPlace> patches = patch_places(placement, places);
    alone.alone = patches.front();
    alone.places = places.size();
    if (patches.size() == 1) return alone;
    WheelOnPatches wheel(spec, placement, patches, descent, options);
    smooth.push_back(wheel.settle(smooth.size()));
    const auto merged = wheel.merged();
    if (!merged) {
      SharedLoad out = wheel.take();
      out.smooth = std::move(smooth);
      if (out.patches.size() > 1 || out.patches.front().contacts.size() > 1) return out;
      const bool first = out.patches.front().contacts.front().rail_s == placement.contact.rail_s;
      return first ? alone : out;
    }
    const auto [into, from] = std::minmax(merged->first, merged->second);
    for (ContactPlace& p : places)
      if (p.patch == from) p.patch = into;
  }
}

double bending_by_others(const CaseSpec& spec, const std::vector<PatchOnWheel>& patches, const PatchOnWheel& one) {
  const auto pressure = [](const PatchOnWheel& p) {
    return PressureOnRail{p.contact, p.patch.grid, p.solution.normal.pressure, p.solution.normal.load};
  };
  const RigidContact& c = one.contact;
  const double own =
      std::min(c.curvature_rolling, std::max(c.curvature_wheel_lateral + c.curvature_rail_lateral, 0.02));
  double bent = 0;
  for (const PatchOnWheel& other : patches)
    if (&other != &one) bent += 2 * pressure(other).at(pressure(one).centre(), 3, modulus_of(spec));
  return bent / own;
}

}  // namespace railstrata
