#include "bem/rolling_derivatives.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bem/leading_edge.hpp"
#include "bem/newton_step.hpp"
#include "core/faults.hpp"

namespace railstrata {
namespace {

/// The cells under pressure, with those ahead of them and, of unlike bodies, beside these, whose gaps the leading edge
/// reads.
PatchPart part_of(const InfluenceOperator& influence, const PatchGrid& grid, const Plane& pressure) {
  return widened_part(grid, pressure, 2, influence.couples() ? 1 : 0).value_or(PatchPart{grid, 0, 0, grid.nx, grid.ny});
}

/// How much the slip of a first cell rises with the gap of an empty one, 1/m, as TangentialState has it.
struct SlipByGap {
  std::size_t first, empty;
  double x, y;
};

}  // namespace

/// z of A^T z = c, by the parts of b.
struct RollingDerivatives::Weights {
  Plane gap;        ///< of the gap less the approach
  Plane slip, own;  ///< of the rigid slip, two planes; of its lateral part from the step's mean to the cell itself
  Plane bound;      ///< of slipping cells
  Plane forces;     ///< of given forces over the area of a cell, in the order of the directions
};

struct RollingDerivatives::System {
  System(const InfluenceOperator& whole, const PatchGrid& cells, const RollingContact& at, const RollingSolution& s)
      : part(part_of(whole, cells, s.normal.pressure)),
        kept(part.nx == cells.nx && part.ny == cells.ny ? nullptr : whole.part(part.nx, part.ny, part.first_y)),
        influence(kept ? *kept : whole),
        grid(part.grid()),
        pressure(part.take(s.normal.pressure)),
        problem(on_part(part, tangential_part(whole, cells, at, s.normal))),
        solution(on_part(part, s.tangential)),
        here(influence, grid, problem),
        newton(here),
        in_contact(influence, pressure),
        n(here.n) {
    take_over(solution, here);
    newton.linearise();
    if (!problem.leading_weight.empty()) find_slip_by_gap(part.take(s.normal.gap));
  }

  void find_slip_by_gap(Plane gap);
  struct Adjoint;
  void solve_tractions(const Plane& wanted, Adjoint& a);
  Plane bound_weights(const Plane& wanted, const Adjoint& a);
  Plane stretch_weights(const Plane& of_slip) const;
  void solve_pressure(const Plane& of_p, const Plane& bound, Adjoint& a);
  Weights taken(Adjoint a, Weights out) const;
  Weights weights_of(const Plane& of_p, const Plane& of_q);
  GivenSlip rigid_slip(const RollingContact& there) const;

  PatchPart part;
  std::shared_ptr<const InfluenceOperator> kept;
  const InfluenceOperator& influence;
  PatchGrid grid;
  Plane pressure;
  TangentialProblem problem;
  TangentialSolution solution;
  TangentialState here;
  NewtonStep newton;
  NormalInverse in_contact;
  std::size_t n;
  std::vector<SlipByGap> by_gap;
  std::vector<Weights> sums, creepages;
};

/// The slip of a first cell is linear in lambda/(1 - lambda).
void RollingDerivatives::System::find_slip_by_gap(Plane gap) {
  const auto counted = [](double weight) { return weight / (1 - weight); };
  TangentialProblem less = problem;
  scale_by(less.leading_weight, 0.5);
  TangentialState with_less(influence, grid, less);
  take_over(solution, with_less);
  NormalSolution normal;
  normal.pressure = pressure;
  normal.gap = std::move(gap);
  for (const LeadingByGap& by : leading_by_gap(influence, grid, normal, film_share(influence))) {
    const std::size_t k = by.first;
    const double weight = problem.leading_weight[k], rest = 1 - weight,
                 by_weight = by.weight / (rest * rest * (counted(weight) - counted(less.leading_weight[k]))),
                 by_slip = -1 / (rest * grid.dx);
    by_gap.push_back(
        {k, by.empty, by_weight * (here.slip[k] - with_less.slip[k]) + by_slip * by.slip_x,
         by_weight * (here.slip[n + k] - with_less.slip[n + k]) + by_slip * problem.lateral_share * by.slip_y});
  }
}

/// z in parts: of tractions and given forces; of the pressure. asked: what they are solved for so far.
struct RollingDerivatives::System::Adjoint {
  Plane z, asked, z_n, asked_n;
  double length = 0, length_n = 0;
  Plane slip, own, displacement;  ///< weights by z
  Plane empty;                    ///< of the gaps of empty cells
};

namespace {

constexpr double kOfTractions = 1e-6, kOfPressure = 1e-7;  // accuracy of each problem

/// Makes `asked` what is wanted and returns by how much it changes.
Plane further(const Plane& wanted, Plane& asked) {
  Plane out = wanted;
  if (!asked.empty()) add_scaled(out, -1, asked);
  asked = wanted;
  return out;
}

void add(Plane& sum, const Plane& more) {
  if (sum.empty()) sum.assign(more.size(), 0.0);
  add_scaled(sum, 1, more);
}

}  // namespace

void RollingDerivatives::System::solve_tractions(const Plane& wanted, Adjoint& a) {
  a.length = std::max(a.length, newton.length_of(wanted));
  add(a.z, newton.adjoint(further(wanted, a.asked), kOfTractions * a.length));
  newton.weights_of_slip(a.z, a.slip, a.own);
  here.L.weights_of_displacement(a.slip.data(), a.displacement);
  a.empty.assign(n, 0.0);
  for (const SlipByGap& by : by_gap) a.empty[by.empty] += a.slip[by.first] * by.x + a.slip[n + by.first] * by.y;
}

/// What tractions on the bound of slipping cells have besides what their sum wants.
Plane RollingDerivatives::System::bound_weights(const Plane& wanted, const Adjoint& a) {
  Plane y(2 * n), out(n, 0.0);
  here.L.weights_of_traction(a.displacement, y.data());
  for (std::size_t c = 0; c < newton.directions().size(); ++c)
    for (std::size_t i = 0; i < n; ++i) y[(newton.directions()[c] ? n : 0) + i] += a.z[2 * n + c];
  for (std::size_t i = 0; i < n; ++i)
    if (here.set[i] == kSlip)
      out[i] = newton.normal()[i] * (wanted[i] - y[i]) + newton.normal()[n + i] * (wanted[n + i] - y[n + i]);
  return out;
}

/// Of the stretch in each cell, which is a rigid slip by its mean over the step.
Plane RollingDerivatives::System::stretch_weights(const Plane& of_slip) const {
  const auto ahead = static_cast<std::size_t>(grid.ny);
  Plane slip(of_slip.begin(), of_slip.begin() + static_cast<std::ptrdiff_t>(n));
  for (const LeadingCell& first : here.given.leading) {
    slip[first.index] += first.weight * of_slip[first.index];
    slip[first.index + ahead] -= first.weight * of_slip[first.index];
  }
  Plane out = slip;
  for (std::size_t i = ahead; i < n; ++i) out[i] += slip[i - ahead];
  scale_by(out, 0.5);
  return out;
}

void RollingDerivatives::System::solve_pressure(const Plane& of_p, const Plane& bound, Adjoint& a) {
  Plane wanted(n);
  influence.normal(a.empty.data(), wanted.data());
  add_scaled(wanted, 1, of_p);
  if (influence.couples()) {
    const auto half = a.displacement.begin() + static_cast<std::ptrdiff_t>(n);
    add_scaled(wanted, -1,
               influence.normal_from_traction({a.displacement.begin(), half}, {half, a.displacement.end()}));
  }
  if (influence.stretches()) add_scaled(wanted, 1, influence.stretch_of_wheel(stretch_weights(a.slip), grid.nx));
  for (std::size_t i = 0; i < n; ++i)
    wanted[i] = pressure[i] > 0 ? wanted[i] + problem.traction_bound[i] / pressure[i] * bound[i] : 0.0;
  a.length_n = std::max(a.length_n, std::sqrt(dot(wanted, wanted)));
  add(a.z_n, in_contact.of(further(wanted, a.asked_n), kOfPressure * a.length_n));
}

RollingDerivatives::Weights RollingDerivatives::System::taken(Adjoint a, Weights out) const {
  out.forces.assign(a.z.begin() + static_cast<std::ptrdiff_t>(2 * n), a.z.end());
  for (std::size_t i = 0; i < n; ++i) {
    const double to_own = here.given.to_own_place.empty() ? 0.0 : here.given.to_own_place[i];
    if (here.set[i] != kSlip || magnitude(here.slip[i], here.slip[n + i]) < 9 * std::abs(to_own)) a.own[i] = 0;
    a.own[i] *= problem.lateral_share;
    a.slip[n + i] *= problem.lateral_share;
  }
  out.slip = std::move(a.slip);
  out.own = std::move(a.own);
  return out;
}

/// Gauss and Seidel's iteration between the two problems, of which each takes what the other's last change asks for;
/// where the bodies do not couple its first round is the answer.
RollingDerivatives::Weights RollingDerivatives::System::weights_of(const Plane& of_p, const Plane& of_q) {
  constexpr double kSettled = 1e-5;  // change of the gap's weights in a round, which leaves some tenths of it
  constexpr int kMostRounds = 60;
  Adjoint a;
  Weights out;
  out.gap.assign(n, 0.0);
  for (int round = 0; round < kMostRounds; ++round) {
    Plane wanted = of_q;
    if (influence.couples() && round > 0) {
      const PlanePair by_gap_weights = influence.tangential_from_pressure(out.gap, grid.nx);
      for (std::size_t i = 0; i < n; ++i) {
        wanted[i] += by_gap_weights.x[i];
        wanted[n + i] += problem.lateral_share * by_gap_weights.y[i];
      }
    }
    solve_tractions(wanted, a);
    out.bound = bound_weights(wanted, a);
    solve_pressure(of_p, out.bound, a);
    double moved = 0, most = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double before = std::exchange(out.gap[i], a.empty[i] - a.z_n[i]);
      moved = std::max(moved, std::abs(out.gap[i] - before));
      most = std::max(most, std::abs(out.gap[i]));
    }
    if (!influence.couples() || moved <= kSettled * most) return taken(std::move(a), std::move(out));
  }
  throw NumericalError("the iteration between the derivatives of normal and tangential contact did not converge");
}

/// Without the displacements by pressure, which stay.
GivenSlip RollingDerivatives::System::rigid_slip(const RollingContact& there) const {
  TangentialProblem at;
  at.spin = there.spin;
  at.local_spin = part.take_rows(there.local_spin);
  at.extra_slip = part.take(there.extra_slip);
  at.traction_bound = problem.traction_bound;
  at.leading_weight = problem.leading_weight;
  return given_slip(grid, at);
}

RollingDerivatives::RollingDerivatives(const InfluenceOperator& influence, const PatchGrid& grid,
                                       const RollingContact& contact, const RollingSolution& solution,
                                       const std::vector<TractionSum>& sums)
    : contact_(contact),
      whole_pressure_(solution.normal.pressure),
      system_(std::make_unique<System>(influence, grid, contact, solution)) {
  System& s = *system_;
  const std::size_t unknown = 2 * s.n + s.newton.directions().size();
  for (const TractionSum& sum : sums) {
    Plane of_p = s.part.take(sum.p), of_q = s.part.take(sum.q_x), of_q_y = s.part.take(sum.q_y);
    of_p.resize(s.n, 0.0);
    of_q.resize(unknown, 0.0);
    for (std::size_t i = 0; i < of_q_y.size(); ++i) of_q[s.n + i] = s.here.traction_y(of_q_y[i]);
    s.sums.push_back(s.weights_of(of_p, of_q));
  }
  for (std::size_t c = 0; c < s.newton.directions().size(); ++c) {
    Plane of_q(unknown, 0.0);
    of_q[2 * s.n + c] = 1;
    s.creepages.push_back(s.weights_of(Plane(s.n, 0.0), of_q));
  }
}

RollingDerivatives::~RollingDerivatives() = default;

RollingSlopes RollingDerivatives::by(const RollingContact& more, const RollingContact& less, double step) const {
  const System& s = *system_;
  const std::size_t n = s.n;
  const auto slope = [&](double above, double below) { return (above - below) / (2 * step); };
  const auto slopes = [&](const Plane& above, const Plane& below) {
    Plane out(std::max(above.size(), below.size()), 0.0);
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = slope(above.empty() ? 0.0 : above[i], below.empty() ? 0.0 : below[i]);
    return out;
  };
  RollingSlopes out;
  out.approach = slope(*more.target.approach, *less.target.approach);
  Plane gap = slopes(s.part.take(more.gap), s.part.take(less.gap));
  for (double& g : gap) g -= out.approach;
  const GivenSlip above = s.rigid_slip(more), below = s.rigid_slip(less);
  const Plane rigid = slopes(above.rigid, below.rigid), own = slopes(above.to_own_place, below.to_own_place);
  Plane bound;
  if (more.friction != less.friction || !contact_.local_friction.empty())
    bound =
        slopes(s.part.take(traction_bound(more, whole_pressure_)), s.part.take(traction_bound(less, whole_pressure_)));
  const double creepage[2] = {contact_.x.force ? 0.0 : slope(more.x.creepage, less.x.creepage),
                              contact_.y.force ? 0.0 : slope(more.y.creepage, less.y.creepage)},
               area = s.grid.cell_area();
  Plane forces;
  if (contact_.x.force) forces.push_back(slope(*more.x.force, *less.x.force) / area);
  if (contact_.y.force) forces.push_back(slope(*more.y.force, *less.y.force) / (area * s.problem.lateral_share));
  const auto change_of = [&](const Weights& w) {
    double sum = dot(w.gap, gap) + dot(w.forces, forces);
    if (!bound.empty()) sum += dot(w.bound, bound);
    if (!own.empty()) sum += dot(w.own, own);
    for (std::size_t i = 0; i < n; ++i)
      sum += w.slip[i] * (rigid[i] + creepage[0]) + w.slip[n + i] * (rigid[n + i] + creepage[1]);
    return sum;
  };
  for (const Weights& w : s.sums) out.sums.push_back(change_of(w));
  out.creepage_x = creepage[0];
  out.creepage_y = creepage[1];
  for (std::size_t c = 0; c < s.creepages.size(); ++c)
    (s.newton.directions()[c] ? out.creepage_y : out.creepage_x) =
        s.newton.directions()[c] ? s.here.slip_y(change_of(s.creepages[c])) : change_of(s.creepages[c]);
  return out;
}

}  // namespace railstrata
