#include "bem/contact_derivative.hpp"

#include <cmath>

#include "bem/varying_bound.hpp"

namespace railstrata {
namespace {

double descent_in(const CaseSpec& spec, const Placement& placement, double descent) {
  return spec.vehicle.approach ? descent_of(placement, *spec.vehicle.approach) : descent;
}

}  // namespace

ContactDerivatives::ContactDerivatives(const CaseSpec& spec, const Placement& placement, const BemOptions& options,
                                       const BemStart& solved, double descent, bool whole)
    : spec_(spec),
      placement_(placement),
      options_(options),
      solved_(solved),
      whole_(whole),
      one_(lowered(spec, placement, descent_in(spec, placement, descent))),
      patch_(one_.lay_on(solved.grid, {{}, solved.solution.normal.approach}, options)) {
  one_.drive(spec.vehicle.load(), patch_.contact);
}

OnePatch ContactDerivatives::lowered(const CaseSpec& spec, const Placement& placement, double descent) const {
  OnePatch out(spec, placement, whole_ ? whole_place(spec, placement, descent) : first_place(spec, placement, descent));
  out.lower(descent);
  return out;
}

bool ContactDerivatives::linear() const {
  const RollingContact& c = patch_.contact;
  const bool force_over_result = spec_.vehicle.approach && (c.x.force.value_or(0) != 0 || c.y.force.value_or(0) != 0),
             one_place = !one_.place().beside_low && !one_.place().beside_high;
  return c.kind == RollingKind::steady && !c.heat && !force_over_result && one_place &&
         !VaryingBound::needed(TangentialProblem{c, {}, {}, {}});
}

ContactDerivatives::Beside ContactDerivatives::beside(const PlacedCase& there, double descent) const {
  const bool here = &there.placement == &placement_ && descent == one_.descent();
  const OnePatch one = here ? one_.in_case(there.spec) : lowered(there.spec, there.placement, descent);
  Beside out;
  out.plane = one.plane();
  if (same_place(one.plane(), one_.plane())) {
    out.patch = patch_;
    set_problem(there.spec, one.placement(), {{}, one.own_approach()}, out.patch);
  } else {
    out.patch = one.lay_on(solved_.grid, {{}, one.own_approach()}, options_);
  }
  one.drive(there.spec.vehicle.load(), out.patch.contact);
  return out;
}

RollingDerivatives& ContactDerivatives::rolling() {
  if (!rolling_) rolling_.emplace(*patch_.influence, patch_.grid, patch_.contact, solved_.solution);
  return *rolling_;
}

PlaneTractions ContactDerivatives::moved(const Beside& there, const RollingDerivative& slope, double step) const {
  PlaneTractions out{there.plane, {}};
  place_cells(there.patch, there.plane, out.field);
  const auto along = [&](const Plane& now, const Plane& by, Plane& moved) {
    for (std::size_t k = 0; k < now.size(); ++k) moved[k] = now[k] + step * by[k];
  };
  const Plane& pressure = solved_.solution.normal.pressure;
  for (std::size_t k = 0; k < pressure.size(); ++k)
    out.field.p[k] = pressure[k] > 0 ? moved_above_zero(pressure[k], step * slope.normal.pressure[k]) : 0.0;
  along(solved_.solution.tangential.q_x, slope.tangential.q_x, out.field.q_x);
  along(solved_.solution.tangential.q_y, slope.tangential.q_y, out.field.q_y);
  return out;
}

std::array<PlaneTractions, 2> ContactDerivatives::tractions(const PlacedCase& more, const PlacedCase& less,
                                                            const std::array<double, 2>& descents, double step) {
  const Beside above = beside(more, descents[0]), below = beside(less, descents[1]);
  const RollingDerivative slope = rolling().by(above.patch.contact, below.patch.contact, step);
  return {moved(above, slope, step), moved(below, slope, -step)};
}

/// As of the target's approach, not of what follows it.
ContactDerivative ContactDerivatives::between(const Beside& more, const Beside& less, double step) {
  const auto slope = [&](double above, double below) { return (above - below) / (2 * step); };
  const RollingDerivative d = rolling().sums_by(more.patch.contact, less.patch.contact, step);
  const double normal = solved_.solution.normal.load, lateral = solved_.solution.tangential.force_y,
               cosine = std::cos(one_.plane().angle), sine = std::sin(one_.plane().angle),
               force_y = d.tangential.force_y;
  ContactDerivative out;
  out.angle = slope(more.plane.angle, less.plane.angle);
  out.force.x = d.tangential.force_x;
  out.force.y = d.normal.load * sine + force_y * cosine + (normal * cosine - lateral * sine) * out.angle;
  out.force.z = -d.normal.load * cosine + force_y * sine + (normal * sine + lateral * cosine) * out.angle;
  out.force.normal = d.normal.load;
  out.force.tangential = force_y;
  out.force.moment = d.tangential.moment;
  out.creepage_x = d.tangential.creepage_x;
  out.creepage_y = d.tangential.creepage_y;
  out.spin = slope(more.patch.contact.spin, less.patch.contact.spin);
  out.approach = d.normal.approach;
  return out;
}

const ContactDerivative& ContactDerivatives::by_descent() {
  constexpr double kShare = 5e-7;  // near enough to the kinks of front and sets, far enough from round-off of the gap
  if (!by_descent_) {
    const double step = kShare * one_.descent();
    const PlacedCase here{spec_, placement_};
    by_descent_ = between(beside(here, one_.descent() + step), beside(here, one_.descent() - step), step);
  }
  return *by_descent_;
}

ContactDerivative ContactDerivatives::by(const PlacedCase& more, const PlacedCase& less, double step) {
  const auto at = [&](const PlacedCase& there) {
    const bool here = &there.placement == &placement_ && there.spec.vehicle.approach == spec_.vehicle.approach;
    return beside(there, here ? one_.descent() : descent_in(there.spec, there.placement, one_.descent()));
  };
  ContactDerivative out = between(at(more), at(less), step);
  if (spec_.vehicle.approach) return out;
  const ContactDerivative& deeper = by_descent();
  const double load = (more.spec.vehicle.load() - less.spec.vehicle.load()) / (2 * step),
               sinking = (load + out.force.z) / -deeper.force.z;
  out.force.x += sinking * deeper.force.x;
  out.force.y += sinking * deeper.force.y;
  out.force.z += sinking * deeper.force.z;
  out.force.normal += sinking * deeper.force.normal;
  out.force.tangential += sinking * deeper.force.tangential;
  out.force.moment += sinking * deeper.force.moment;
  out.creepage_x += sinking * deeper.creepage_x;
  out.creepage_y += sinking * deeper.creepage_y;
  out.spin += sinking * deeper.spin;
  out.approach += sinking * deeper.approach;
  out.angle += sinking * deeper.angle;
  return out;
}

}  // namespace railstrata
