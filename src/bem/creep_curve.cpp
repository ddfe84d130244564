#include "bem/creep_curve.hpp"

#include "bem/case_patch.hpp"
#include "core/faults.hpp"
#include "halfspace/creep_theories.hpp"

namespace railstrata {

std::vector<CreepCurvePoint> creep_curve(const CaseSpec& spec, const Placement& placement,
                                         const std::vector<double>& creepages, const BemOptions& options) {
  if (!(spec.drive.friction_coefficient > 0))
    throw CaseError("a creep curve needs friction", "set drive.friction_coefficient above zero");
  CasePatch patch = make_case_patch(spec, placement, options, normal_load(static_load(spec), 0, placement.contact));
  const RollingEllipse ellipse = rolling_ellipse(hertz_estimate(spec, placement.contact), patch.contact.friction,
                                                 patch.wheel.substrate, patch.rail.substrate);
  std::vector<CreepCurvePoint> curve;
  for (double creepage : creepages) {
    patch.contact.x = {creepage, {}};
    const RollingSolution s = solve_rolling(*patch.influence, patch.grid, patch.contact, options.rolling);
    const TangentialSolution& t = s.tangential;
    const Creepage c{creepage, 0, patch.contact.spin};
    const double bound = patch.contact.friction * s.normal.load, hertz_bound = ellipse.friction * ellipse.contact.load;
    curve.push_back({creepage, t.force_x / bound, fastsim(ellipse, c).x / hertz_bound,
                     polach(ellipse, c).x / hertz_bound, vermeulen_johnson(ellipse, c).x / hertz_bound,
                     linear_theory(ellipse, c).x / hertz_bound, t.slip_area / (t.slip_area + t.stick_area)});
  }
  return curve;
}

}  // namespace railstrata
