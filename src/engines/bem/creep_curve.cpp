#include "bem/creep_curve.hpp"

#include <cmath>
#include <optional>

#include "bem/one_patch.hpp"
#include "core/faults.hpp"
#include "halfspace/creep_theories.hpp"
#include "model/drive_at_contact.hpp"
#include "rules/support.hpp"

namespace railstrata {

std::vector<CreepCurvePoint> creep_curve(const CaseSpec& spec, const Placement& placement, VariedCreepage varied,
                                         const std::vector<double>& creepages, const BemOptions& options) {
  require_support(uses::kCreepCurve, spec);
  const std::optional<double>& approach = spec.vehicle.approach;
  FirstPatch first = press_first(spec, placement, options);
  CasePatch& patch = first.laid;
  const RigidContact& plane = first.one.plane();
  const double weight = approach ? std::cos(plane.angle) * patch.frictionless.load : spec.vehicle.load();
  const RollingEllipse ellipse =
      rolling_ellipse(hertz_estimate(spec, plane), patch.contact.friction, patch.wheel.substrate, patch.rail.substrate);
  const double hertz_bound = ellipse.friction * ellipse.contact.load;
  const bool along_x = varied == VariedCreepage::longitudinal;
  const auto share = [&](const CreepForce& force) { return (along_x ? force.x : force.y) / hertz_bound; };
  drive_contact(spec, plane, weight, patch.contact);
  require_one_plane(placement, patch.frictionless.approach, "geometry.lateral_shift",
                    "a creep curve needs a single contact patch: move the wheel (geometry.lateral_shift) or lower the "
                    "load until it touches at one place; `railstrata bem` solves several patches together");
  std::vector<CreepCurvePoint> curve;
  for (double creepage : creepages) {
    if (varied == VariedCreepage::longitudinal) patch.contact.x = {creepage, {}};
    if (varied == VariedCreepage::lateral) patch.contact.y = {creepage, {}};
    if (varied == VariedCreepage::spin) patch.contact.spin = creepage;
    const RollingSolution s = solve_rolling(*patch.influence, patch.grid, patch.contact, options.rolling);
    const TangentialSolution& t = s.tangential;
    const Creepage c{t.creepage_x, t.creepage_y, patch.contact.spin};
    const double bound = patch.contact.friction * s.normal.load;
    curve.push_back({creepage, (along_x ? t.force_x : t.force_y) / bound, share(fastsim(ellipse, c)),
                     share(polach(ellipse, c)), share(vermeulen_johnson(ellipse, c)), share(linear_theory(ellipse, c)),
                     t.slip_area / (t.slip_area + t.stick_area), (along_x ? t.force_y : t.force_x) / bound,
                     t.moment / bound});
  }
  return curve;
}

}  // namespace railstrata
