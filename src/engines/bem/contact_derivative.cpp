#include "bem/contact_derivative.hpp"

#include <cmath>
#include <utility>

#include "bem/varying_bound.hpp"

namespace railstrata {
namespace {

double descent_in(const CaseSpec& spec, const Placement& placement, double descent) {
  return spec.vehicle.approach ? descent_of(placement, *spec.vehicle.approach) : descent;
}

/// In the order of sums_of_contact.
enum ContactSum : std::size_t { kNormal, kMoment, kAlong, kAcross };

/// The normal force, the moment about it, and the forces that are not given.
std::vector<TractionSum> sums_of_contact(const PatchGrid& grid, const RollingContact& contact) {
  const Plane area(grid.size(), grid.cell_area());
  TractionSum moment{{}, area, area};
  for (std::size_t k = 0; k < grid.size(); ++k) {
    moment.q_x[k] *= -grid.y_of(k);
    moment.q_y[k] *= grid.x_of(k);
  }
  std::vector<TractionSum> out{{area, {}, {}}, std::move(moment)};
  out.push_back(contact.x.force ? TractionSum{} : TractionSum{{}, area, {}});
  out.push_back(contact.y.force ? TractionSum{} : TractionSum{{}, {}, area});
  return out;
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
         !(c.third_body.thickness > 0 && c.third_body.modulus_by_pressure != 0) &&
         !VaryingBound::needed(TangentialProblem{c, {}, {}, {}});
}

/// What the influence of the place beside, of sections, changes in gap and slip under the tractions of the solution.
void ContactDerivatives::carry_influence(CasePatch& there) const {
  const InfluenceOperator &own = *patch_.influence, &other = *there.influence;
  if (!other.stretches()) return;
  const PatchGrid& g = patch_.grid;
  const Plane& p = solved_.solution.normal.pressure;
  const TangentialSolution& t = solved_.solution.tangential;
  RollingContact& asked = there.contact;
  asked.extra_slip.x.resize(g.size(), 0.0);
  asked.extra_slip.y.resize(g.size(), 0.0);
  for (const auto& [op, sign] : {std::pair{&other, 1.0}, std::pair{&own, -1.0}}) {
    Plane u_n(g.size());
    op->normal(p.data(), u_n.data());
    add_scaled(asked.gap, sign, u_n);
    if (t.state.empty()) continue;
    add_scaled(asked.gap, sign, op->normal_from_traction(t.q_x, t.q_y));
    PlanePair u = op->tangential(t.q_x, t.q_y, g.nx + 1);
    const PlanePair by_p = op->tangential_from_pressure(p, g.nx + 1);
    add_scaled(u.x, 1, by_p.x);
    add_scaled(u.y, 1, by_p.y);
    const Plane stretch = op->stretch_of_wheel(p, g.nx + 1);
    const auto ahead = static_cast<std::size_t>(g.ny);
    for (std::size_t k = 0; k < g.size(); ++k) {
      asked.extra_slip.x[k] += sign * ((u.x[k + ahead] - u.x[k]) / g.dx + 0.5 * (stretch[k] + stretch[k + ahead]));
      asked.extra_slip.y[k] += sign * (u.y[k + ahead] - u.y[k]) / g.dx;
    }
  }
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
    carry_influence(out.patch);
  }
  one.drive(there.spec.vehicle.load(), out.patch.contact);
  return out;
}

RollingDerivatives& ContactDerivatives::rolling() {
  if (sums_.empty()) sums_ = sums_of_contact(patch_.grid, patch_.contact);
  if (!rolling_) rolling_.emplace(*patch_.influence, patch_.grid, patch_.contact, solved_.solution, sums_);
  return *rolling_;
}

PlaneTractions ContactDerivatives::tractions_in(const CasePatch& patch, const RigidContact& plane) const {
  PlaneTractions out{plane, {}};
  place_cells(patch, plane, out.field);
  out.field.p = solved_.solution.normal.pressure;
  out.field.q_x = solved_.solution.tangential.q_x;
  out.field.q_y = solved_.solution.tangential.q_y;
  return out;
}

PlaneTractions ContactDerivatives::here() const { return tractions_in(patch_, one_.plane()); }

void ContactDerivatives::weigh(std::vector<TractionSum> sums) {
  sums_ = std::move(sums);
  rolling_.reset();
}

CarriedChange ContactDerivatives::change_of(const PlacedCase& more, const PlacedCase& less,
                                            const std::array<double, 2>& descents, double step) {
  const Beside above = beside(more, descents[0]), below = beside(less, descents[1]);
  return {tractions_in(above.patch, above.plane), tractions_in(below.patch, below.plane),
          rolling().by(above.patch.contact, below.patch.contact, step).sums};
}

/// As of the target's approach, not of what follows it.
ContactDerivative ContactDerivatives::between(const Beside& more, const Beside& less, double step) {
  const auto slope = [&](double above, double below) { return (above - below) / (2 * step); };
  const RollingContact &above = more.patch.contact, &below = less.patch.contact;
  const RollingSlopes d = rolling().by(above, below, step);
  const double normal = solved_.solution.normal.load, lateral = solved_.solution.tangential.force_y,
               cosine = std::cos(one_.plane().angle), sine = std::sin(one_.plane().angle), load = d.sums[kNormal],
               force_y = above.y.force ? slope(*above.y.force, *below.y.force) : d.sums[kAcross];
  ContactDerivative out;
  out.angle = slope(more.plane.angle, less.plane.angle);
  out.force.x = above.x.force ? slope(*above.x.force, *below.x.force) : d.sums[kAlong];
  out.force.y = load * sine + force_y * cosine + (normal * cosine - lateral * sine) * out.angle;
  out.force.z = -load * cosine + force_y * sine + (normal * sine + lateral * cosine) * out.angle;
  out.force.normal = load;
  out.force.tangential = force_y;
  out.force.moment = d.sums[kMoment];
  out.creepage_x = d.creepage_x;
  out.creepage_y = d.creepage_y;
  out.spin = slope(above.spin, below.spin);
  out.approach = d.approach;
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
