#include "bem/several_patches.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bem/pressure_on_rail.hpp"
#include "bem/wheel_on_patches.hpp"

namespace railstrata {

SharedLoad share_between(const CaseSpec& spec, const Placement& placement, const std::vector<ContactPlace>& places,
                         double descent, const BemOptions& options, Merging merging,
                         std::vector<std::vector<BemStart>> smooth) {
  SharedLoad alone;
  alone.descent = descent;
  std::vector<PatchPlace> patches = patch_places(placement, places);
  alone.alone = patches.front();
  alone.places = places.size();
  if (patches.size() > 1) {
    WheelOnPatches wheel(spec, placement, patches, descent, options);
    smooth.push_back(wheel.settle(smooth.size(), merging == Merging::at_once ? 0.0 : kSurelyOne));
    alone.meet = wheel.meeting();
    SharedLoad out = wheel.take();
    const bool bears_all = out.patches.size() == 1 && out.patches.front().contacts.size() == 1 &&
                           out.patches.front().contacts.front().rail_s == placement.contact.rail_s;
    if (!bears_all) {
      out.alone = std::move(alone.alone);
      out.places = alone.places;
      out.meet = alone.meet;
      out.smooth = std::move(smooth);
      return out;
    }
  }
  alone.smooth = std::move(smooth);
  return alone;
}

std::vector<ContactPlace> merged(std::vector<ContactPlace> places, const PatchesMeet& meet) {
  for (ContactPlace& p : places)
    if (p.patch == meet.from) p.patch = meet.into;
  put_in_order(places);
  return places;
}

double share_merged(const PatchesMeet& meet) { return fade(meet.reach); }

SharedLoad share_load(const CaseSpec& spec, const Placement& placement, std::vector<ContactPlace> places,
                      double descent, const BemOptions& options, Merging merging, bool& near_merging) {
  constexpr double kFar = 2;  // reach: more than a percent of descent away
  SharedLoad out;
  put_in_order(places);
  for (;;) {
    out = share_between(spec, placement, places, descent, options, merging, std::move(out.smooth));
    if (!out.meet) return out;
    if (merging == Merging::by_reach) {
      near_merging = near_merging || out.meet->reach < kFar;
      if (share_merged(*out.meet) < 0.5) return out;
    }
    places = merged(std::move(places), *out.meet);
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
