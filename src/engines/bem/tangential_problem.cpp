#include "bem/tangential_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bem/cell_slip.hpp"
#include "bem/newton_step.hpp"
#include "bem/normal_problem.hpp"
#include "core/faults.hpp"

namespace railstrata {

namespace {

constexpr double kCoarse = 0.1;  // of the linear systems, while sets still change
constexpr double kClose = 300;   // tolerances: from a continued start with so small an error sets rarely change
constexpr double kSharp = 1e-4;  // of the linear systems, at most

/// Active sets with Newton's method. [Kalker1990 ch. 4]
class Solver {
 public:
  Solver(const InfluenceOperator& influence, const PatchGrid& grid, const TangentialProblem& problem,
         const TangentialOptions& options)
      : options_(options), s_(influence, grid, problem), newton_(s_) {}

  /// Newton steps until the slip conditions hold. The linear systems are solved roughly while cells change sets, and as
  /// sharply as the error asks for once the sets stand.
  TangentialSolution solve(const TangentialSolution* start) {
    for (std::size_t i = 0; i < s_.n; ++i) s_.set[i] = s_.problem.traction_bound[i] > 0 ? kStick : kOutside;
    check_forces();
    if (start) s_.adopt(*start, true);
    s_.update_slip();
    if (start && fill_new_cells(*start)) s_.update_slip();
    int changed = update_sets();
    s_.follow_slip();
    double error = violation();
    const bool continued = start && start->extrapolated;
    const double goal =
        start ? std::min(options_.tolerance, std::max(NormalOptions::kRoundOff, options_.share_of_first * error))
              : options_.tolerance;
    for (; error > goal && outer_ < options_.max_outer; ++outer_) {
      const bool stand = changed == 0 && (outer_ > 0 || (continued && error < kClose * options_.tolerance));
      if (!stand)
        newton_.take(kCoarse);
      else if (continued)
        newton_.take(kSharp, 0.4 * goal * scale_);
      else
        newton_.take(std::clamp(0.3 * goal / error, kSharp, kCoarse));
      s_.update_slip();
      changed = update_sets();
      s_.follow_slip();
      error = violation();
    }
    if (error <= goal || options_.partial) return solution();
    if (s_.varying && !newton_.directions().empty())
      throw CaseError(
          fmt::format("no steady state was found under the given force: {} may not carry it",
                      s_.problem.falling.falls() ? "friction that falls with slip" : "a third-body layer that yields"),
          "give drive.creepage instead, which has a solution beyond the largest force too",
          s_.problem.falling.falls() ? "friction.law" : "third_body.yield_shear");
    throw NumericalError("the tangential contact problem did not converge");
  }

 private:
  void check_forces() {
    available_ = sum(s_.problem.third_body.hardening > 0 || !s_.varying ? s_.problem.traction_bound : s_.carried);
    const double available = available_ * s_.grid.cell_area(),
                 wanted = std::hypot(s_.problem.x.force.value_or(0),
                                     s_.problem.y.force.value_or(0) / s_.problem.lateral_share);
    constexpr double kRoundOff = 1e-12;  // of the sum: a force of all the friction there is has no solution either
    if (wanted >= (1 - kRoundOff) * available && wanted > 0)
      throw CaseError(
          fmt::format("friction cannot carry the tangential force: {:.4g} kN of at most {:.4g} kN", 1e-3 * wanted,
                      1e-3 * available),
          s_.varying && s_.problem.third_body.yields()
              ? "lower the traction or raise the friction coefficient or third_body.yield_shear"
              : "lower the traction or raise the friction coefficient",
          s_.varying && s_.problem.third_body.yields() ? "third_body.yield_shear" : "drive.friction_coefficient");
  }

  /// Cells that have come into contact since: as if alone. Left without traction they would mislead the first Newton
  /// step.
  bool fill_new_cells(const TangentialSolution& start) {
    bool any = false;
    for (std::size_t i = 0; i < s_.n; ++i) {
      const double slip = magnitude(s_.slip[i], s_.slip[s_.n + i]);
      if (s_.set[i] == kOutside || start.state[i] != ContactState::separated || slip == 0) continue;
      const double g = s_.bound[i], q = std::min(g, slip / s_.L.self());
      if (q == g) s_.set[i] = kSlip;
      s_.q[i] = q * s_.slip[i] / slip;
      s_.q[s_.n + i] = q * s_.slip[s_.n + i] / slip;
      any = true;
    }
    return any;
  }
  /// Cells that exceed the traction bound slip, those that would slip against their traction stick: s·q < 0 would
  /// feed energy in; the threshold is round-off of the largest rigid slip. Returns how many changed.
  int update_sets() {
    return static_cast<int>(ordered_sum_of(s_.n, [&](std::size_t i) -> double {
      if (s_.set[i] == kLoosened) {
        s_.set[i] = kSlip;
        return 1;
      }
      if (s_.set[i] != kSlip ||
          s_.slip[i] * s_.q[i] + s_.slip[s_.n + i] * s_.q[s_.n + i] >= -1e-9 * scale_ * s_.bound[i])
        return 0;
      s_.set[i] = kStick;
      return 1;
    }));
  }

  /// Largest violation of the slip conditions and of the given forces, as TangentialOptions::tolerance counts it.
  double violation() {
    struct Largest {
      double wrong = 0, rigid = 0;  // squares
    };
    std::vector<Largest> part(pieces_of(s_.n));
    for_pieces(s_.n, 2, [&](std::size_t k, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (s_.set[i] == kOutside) continue;
        const double x = s_.given.rigid[i] + s_.creepage[0], y = s_.given.rigid[s_.n + i] + s_.creepage[1],
                     g = s_.bound[i];
        const double across = (s_.slip[i] * s_.q[s_.n + i] - s_.lateral_slip(i) * s_.q[i]) / g;
        const double against = std::min(0.0, s_.slip[i] * s_.q[i] + s_.slip[s_.n + i] * s_.q[s_.n + i]) / g;
        part[k].rigid = std::max({part[k].rigid, x * x + y * y,
                                  1e-4 * (s_.given.history[i] * s_.given.history[i] +
                                          s_.given.history[s_.n + i] * s_.given.history[s_.n + i])});
        part[k].wrong = std::max(part[k].wrong, s_.set[i] == kStick
                                                    ? s_.slip[i] * s_.slip[i] + s_.slip[s_.n + i] * s_.slip[s_.n + i]
                                                    : across * across + against * against);
      }
    });
    Largest all;
    for (const Largest& p : part) all = {std::max(all.wrong, p.wrong), std::max(all.rigid, p.rigid)};
    scale_ = std::sqrt(all.rigid);
    double force = bound_violation() * available_;
    for (int direction : newton_.directions()) force = std::max(force, std::abs(s_.missing_force(direction)));
    return std::max(all.wrong > 0 ? std::sqrt(all.wrong / all.rigid) : 0.0, force > 0 ? force / available_ : 0.0);
  }

  /// Largest deviation of a cell's traction from a bound that varies, over that bound.
  double bound_violation() const {
    double worst = 0;
    if (s_.varying)
      for (std::size_t i = 0; i < s_.n; ++i)
        if (s_.set[i] == kSlip) worst = std::max(worst, std::abs(s_.carried[i] / s_.varying->wanted(i) - 1));
    return worst;
  }

  /// With the spin's lateral slip in the middle of the step; after update_slip.
  StepSlip step_slip() const {
    StepSlip out{Plane(s_.n, 0.0), Plane(s_.n, 0.0)};
    const bool rolls = s_.problem.kind != RollingKind::shift;
    for (std::size_t k = 0; k < s_.n; ++k) {
      const bool leaves =
          s_.set[k] == kOutside && rolls && k + s_.ahead < s_.n && s_.problem.traction_bound[k + s_.ahead] > 0;
      if (s_.set[k] != kSlip && !leaves) continue;
      out.x[k] = leaves ? s_.given.rigid[k] + s_.creepage[0] + s_.given.history[k] - s_.L.x(k) : s_.slip[k];
      out.y[k] = leaves ? s_.given.rigid[s_.n + k] + s_.creepage[1] + s_.given.history[s_.n + k] - s_.L.y(k)
                        : s_.slip[s_.n + k];
      if (!s_.given.to_middle_of_step.empty()) out.y[k] += s_.given.to_middle_of_step[k % s_.ahead];
      out.y[k] = s_.slip_y(out.y[k]);
    }
    return out;
  }

  /// How far the ellipse of friction reaches in the direction of each cell's traction; without one, along rolling.
  Plane bound_along_traction(const TangentialSolution& s) const {
    Plane out = s_.problem.traction_bound;
    for (std::size_t k = 0; k < s_.n; ++k)
      if (const double scaled = magnitude(s_.q[k], s_.q[s_.n + k]); scaled > 0)
        out[k] *= magnitude(s.q_x[k], s.q_y[k]) / scaled;
    return out;
  }

  TangentialSolution solution() const {
    TangentialSolution s;
    const auto half = static_cast<std::ptrdiff_t>(s_.n);
    s.q_x.assign(s_.q.begin(), s_.q.begin() + half);
    s.q_y.assign(s_.q.begin() + half, s_.q.end());
    for (double& q : s.q_y) q = s_.traction_y(q);
    s.slip = {Plane(s_.n, 0.0), Plane(s_.n, 0.0)};
    s.state.assign(s_.n, ContactState::separated);
    s.creepage_x = s_.creepage[0];
    s.creepage_y = s_.slip_y(s_.creepage[1]);
    const double dA = s_.grid.cell_area();
    for (std::size_t k = 0; k < s_.n; ++k) {
      if (s_.set[k] == kOutside) continue;
      s.state[k] = s_.set[k] == kStick ? ContactState::stick : ContactState::slip;
      (s_.set[k] == kStick ? s.stick_area : s.slip_area) += dA;
      if (s_.set[k] == kSlip) {
        s.slip.x[k] = s_.slip[k];
        s.slip.y[k] = s_.slip_y(s_.lateral_slip(k));
      }
      s.moment += (s_.grid.x_of(k) * s.q_y[k] - s_.grid.y_of(k) * s.q_x[k]) * dA;
    }
    s.force_x = sum(s.q_x) * dA;
    s.force_y = sum(s.q_y) * dA;
    const StepSlip steps = step_slip();
    s.cell_slip = slip_of_cells(s_.grid, s_.problem.kind, s.state, steps);
    s.dissipation = dissipated(s_.grid, s_.problem.kind, s.q_x, s.q_y, s_.problem.traction_before, steps);
    if (s_.varying) {
      s.plastic = s_.varying->plastic();
      s.lost_friction = s_.varying->lost();
      s.bound = s_.varying->at_rest();
    }
    s.film_flexibility = s_.film_flexibility;
    if (s_.problem.lateral_share != 1) s.bound = bound_along_traction(s);
    s.outer_iterations = outer_;
    s.iterations = s_.L.products();
    return s;
  }

  TangentialOptions options_;
  TangentialState s_;
  NewtonStep newton_;
  double scale_ = 0;      // largest rigid slip
  double available_ = 0;  // friction over the area of a cell
  int outer_ = 0;
};

constexpr Plane TangentialSolution::*kSolutionPlanes[] = {
    &TangentialSolution::q_x,           &TangentialSolution::q_y,   &TangentialSolution::plastic,
    &TangentialSolution::lost_friction, &TangentialSolution::bound, &TangentialSolution::film_flexibility};

/// On the whole grid: nothing bears friction outside the part.
TangentialSolution put_back(const PatchPart& part, TangentialSolution s) {
  for (Plane TangentialSolution::*plane : kSolutionPlanes) s.*plane = part.put(s.*plane);
  for (PlanePair* pair : {&s.slip, &s.cell_slip}) *pair = part.put(*pair);
  s.state = part.put(s.state, ContactState::separated);
  return s;
}

/// Displacement by the film's flexibility beyond the influence operator's.
void add_film(const TangentialSolution& s, PlanePair& u) {
  for (std::size_t k = 0; k < s.film_flexibility.size(); ++k) {
    u.x[k] += s.film_flexibility[k] * s.q_x[k];
    u.y[k] += s.film_flexibility[k] * s.q_y[k];
  }
}

}  // namespace

TangentialProblem on_part(const PatchPart& part, const TangentialProblem& p) {
  TangentialProblem out = p;
  for (Plane* plane : {&out.traction_bound, &out.leading_weight, &out.plastic_before, &out.lost_before})
    *plane = part.take(*plane);
  for (PlanePair* pair : {&out.extra_slip, &out.before, &out.traction_before}) *pair = part.take(*pair);
  out.local_spin = part.take_rows(p.local_spin);
  out.film = part.take(p.film);
  return out;
}

TangentialSolution on_part(const PatchPart& part, const TangentialSolution& s) {
  TangentialSolution out = s;
  for (Plane TangentialSolution::*plane : kSolutionPlanes) out.*plane = part.take(s.*plane);
  for (PlanePair* pair : {&out.slip, &out.cell_slip}) *pair = part.take(*pair);
  out.state = part.take(s.state);
  return out;
}

TangentialSolution solve_tangential(const InfluenceOperator& influence, const PatchGrid& grid,
                                    const TangentialProblem& problem, const TangentialOptions& options,
                                    const TangentialSolution* start) {
  constexpr int kRing = 2;
  const std::optional<PatchPart> part = start && start->extrapolated ? tight_part_with(grid, problem.traction_bound)
                                                                     : part_with(grid, problem.traction_bound, kRing);
  if (!part) return Solver(influence, grid, problem, options).solve(start);
  const std::shared_ptr<const InfluenceOperator> own = influence.part(part->nx, part->ny, part->first_y);
  const TangentialProblem problem_there = on_part(*part, problem);
  const std::optional<TangentialSolution> start_there =
      start ? std::optional<TangentialSolution>(on_part(*part, *start)) : std::nullopt;
  const PatchGrid grid_there = part->grid();
  return put_back(*part, Solver(*own, grid_there, problem_there, options).solve(start_there ? &*start_there : nullptr));
}

Plane rolled_on(const PatchGrid& grid, const Plane& values) {
  if (values.empty()) return {};
  Plane out(values.begin() + grid.ny, values.end());
  out.resize(values.size(), 0.0);
  return out;
}

void roll_on_one_cell(const InfluenceOperator& influence, const PatchGrid& grid, const TangentialSolution& before,
                      RollingConditions& next) {
  next.before = influence.tangential(before.q_x, before.q_y, grid.nx + 1);
  add_film(before, next.before);
  for (Plane* u : {&next.before.x, &next.before.y}) u->erase(u->begin(), u->begin() + grid.ny);
  next.kind = RollingKind::transient;
  next.step = grid.dx;
  next.plastic_before = rolled_on(grid, before.plastic);
  next.lost_before = rolled_on(grid, before.lost_friction);
  next.traction_before = {rolled_on(grid, before.q_x), rolled_on(grid, before.q_y)};
}

void shift_on(const InfluenceOperator& influence, const PatchGrid& grid, const TangentialSolution& before,
              RollingConditions& next) {
  next.kind = RollingKind::shift;
  next.before = influence.tangential(before.q_x, before.q_y, grid.nx);
  add_film(before, next.before);
  next.plastic_before = before.plastic;
}

}  // namespace railstrata
