#include "bem/contact_derivative.hpp"

#include <cmath>

#include "bem/varying_bound.hpp"

namespace railstrata {
namespace {

NormalTarget target_of(const CaseSpec& spec, double normal) {
  return spec.vehicle.approach ? NormalTarget{{}, spec.vehicle.approach} : NormalTarget{normal, {}};
}

bool same_place(const RigidContact& a, const RigidContact& b) {
  return a.rail_s == b.rail_s && a.wheel_s == b.wheel_s && a.x == b.x && a.yaw == b.yaw && a.roll == b.roll;
}

void add(RollingDerivative& d, double factor, const RollingDerivative& other) {
  d.normal.load += factor * other.normal.load;
  d.normal.approach += factor * other.normal.approach;
  d.tangential.force_x += factor * other.tangential.force_x;
  d.tangential.force_y += factor * other.tangential.force_y;
  d.tangential.moment += factor * other.tangential.moment;
  d.tangential.creepage_x += factor * other.tangential.creepage_x;
  d.tangential.creepage_y += factor * other.tangential.creepage_y;
}

}  // namespace

ContactDerivatives::ContactDerivatives(const CaseSpec& spec, const Placement& placement, const BemOptions& options,
                                       const BemNeighbour& solved)
    : spec_(spec),
      placement_(placement),
      options_(options),
      solved_(solved),
      patch_(case_patch_on(solved.grid, spec, placement, options, target_of(spec, solved.solution.normal.load))) {
  drive_contact(spec, placement.contact, spec.vehicle.load(), patch_.contact);
}

bool ContactDerivatives::linear() const {
  const RollingContact& c = patch_.contact;
  const bool force_over_result = spec_.vehicle.approach && (c.x.force.value_or(0) != 0 || c.y.force.value_or(0) != 0);
  return c.kind == RollingKind::steady && !c.heat && !force_over_result &&
         !VaryingBound::needed(TangentialProblem{c, {}, {}, {}});
}

/// The problem of a case that differs a little, under the normal force of this one.
CasePatch ContactDerivatives::beside(const PlacedCase& there, double normal) const {
  const NormalTarget target = target_of(there.spec, normal);
  CasePatch out;
  if (same_place(there.placement.contact, placement_.contact)) {
    out = patch_;
    set_problem(there.spec, there.placement, target, out);
  } else {
    out = case_patch_on(solved_.grid, there.spec, there.placement, options_, target);
  }
  drive_contact(there.spec, there.placement.contact, there.spec.vehicle.load(), out.contact);
  return out;
}

/// Lateral friction by the normal force, N/N.
double ContactDerivatives::by_weight() {
  constexpr double kShare = 1e-6;
  const double normal = solved_.solution.normal.load, step = kShare * normal;
  if (!by_load_) {
    RollingContact more = patch_.contact, less = patch_.contact;
    more.target.load = normal + step;
    less.target.load = normal - step;
    by_load_ = rolling_->by(more, less, step);
  }
  return by_load_->tangential.force_y;
}

ContactDerivative ContactDerivatives::by(const PlacedCase& more, const PlacedCase& less, double step) {
  const auto slope = [&](double above, double below) { return (above - below) / (2 * step); };
  if (!rolling_) rolling_.emplace(*patch_.influence, patch_.grid, patch_.contact, solved_.solution);
  const double normal = solved_.solution.normal.load, lateral = solved_.solution.tangential.force_y,
               angle = placement_.contact.angle, cosine = std::cos(angle), sine = std::sin(angle);
  const CasePatch up = beside(more, normal), down = beside(less, normal);
  RollingDerivative d = rolling_->by(up.contact, down.contact, step);
  ContactDerivative out;
  out.angle = slope(more.placement.contact.angle, less.placement.contact.angle);
  if (!spec_.vehicle.approach) {
    const double by_normal = by_weight(), missing = slope(more.spec.vehicle.load(), less.spec.vehicle.load()) +
                                                    (normal * sine + lateral * cosine) * out.angle +
                                                    d.tangential.force_y * sine;
    add(d, missing / (cosine - by_normal * sine), *by_load_);
  }
  const double force_y = d.tangential.force_y;
  out.force.x = d.tangential.force_x;
  out.force.y = d.normal.load * sine + force_y * cosine + (normal * cosine - lateral * sine) * out.angle;
  out.force.z = -d.normal.load * cosine + force_y * sine + (normal * sine + lateral * cosine) * out.angle;
  out.force.normal = d.normal.load;
  out.force.tangential = force_y;
  out.force.moment = d.tangential.moment;
  out.creepage_x = d.tangential.creepage_x;
  out.creepage_y = d.tangential.creepage_y;
  out.spin = slope(up.contact.spin, down.contact.spin);
  out.approach = d.normal.approach;
  return out;
}

}  // namespace railstrata
