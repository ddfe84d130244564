#include "bem/tangential_state.hpp"

#include "bem/largest_influence.hpp"

namespace railstrata {

SlipOperator::SlipOperator(const InfluenceOperator& influence, const PatchGrid& grid, const TangentialProblem& problem,
                           const std::vector<LeadingCell>& leading)
    : influence_(influence),
      grid_(grid),
      leading_(leading),
      steady_(problem.kind == RollingKind::steady),
      step_(railstrata::step_length(grid, problem)),
      inverse_step_(1 / step_),
      self_((influence.of_one_cell(0).xx - (steady_ ? influence.of_one_cell(1).xx : 0.0)) / step_),
      n_(grid.size()),
      ahead_(static_cast<std::size_t>(grid.ny)),
      u_(2 * (n_ + ahead_)) {}

void SlipOperator::apply(const double* in) {
  influence_.tangential(in, in + n_, u_.data(), u_.data() + n_ + ahead_, steady_ ? grid_.nx + 1 : grid_.nx);
  ++products_;
  extrapolate_at_leading_cells();
}

/// L + lambda/(1 - lambda) (L - L ahead) in the first cells: written into the displacement that L takes from the
/// empty cell ahead (steady), or into the cell's own. No other cell reads them.
void SlipOperator::extrapolate_at_leading_cells() {
  for (const LeadingCell& first : leading_)
    for (double* u : {u_.data() + first.index, u_.data() + n_ + ahead_ + first.index}) {
      if (steady_)
        u[ahead_] -= first.weight * (u[0] - 2 * u[ahead_] + u[2 * ahead_]);
      else
        u[0] += first.weight * (u[0] - u[ahead_]);
    }
}

void SlipOperator::traction_of(const Plane& displacement, double* out) {
  influence_.precondition_tangential(displacement.data(), displacement.data() + n_, out, out + n_);
  ++products_;
}

double SlipOperator::largest(const Plane& traction_bound, double film) const {
  // Steady: over L of one cell, across, square cells, that of lateral traction in waves along x of nearly two cells:
  // 1.9 for Poisson's ratio 0, 2.1 for 0.3, 2.25 for 0.5; strips of a line contact 1.415. A film's part
  // of L takes from a cell and the one ahead of it alone: row after row, so that it counts once.
  const double largest = grid_.line ? 1.42 : 2.25;
  return (steady_ ? largest * (influence_.of_one_cell(0).yy - influence_.of_one_cell(1).yy - film) + film
                  : largest_tangential_influence(influence_, traction_bound)) /
         step_;
}

TangentialState::TangentialState(const InfluenceOperator& influence, const PatchGrid& cells,
                                 const TangentialProblem& asked)
    : grid(cells),
      problem(asked),
      n(cells.size()),
      ahead(static_cast<std::size_t>(cells.ny)),
      q(2 * n, 0.0),
      slip(2 * n),
      set(n, kOutside),
      given(given_slip(cells, asked)),
      L(influence, cells, asked, given.leading),
      bound(asked.traction_bound.data()),
      creepage{asked.x.creepage, asked.y.creepage} {
  if (!VaryingBound::needed(problem)) return;
  if (problem.falling.falls() || problem.third_body.hardening < 0)
    VaryingBound::require_unique_slip(problem, L.step_length(),
                                      L.largest(problem.traction_bound, problem.third_body.flexibility()));
  varying.emplace(grid, problem, given);
  carried = varying->at_rest();
  bound = carried.data();
}

void TangentialState::update_slip() {
  L.apply(q.data());
  for_both([&](std::size_t i) {
    const bool in_patch = set[i] != kOutside;
    slip[i] = in_patch ? given.rigid[i] + creepage[0] + given.history[i] - L.x(i) : 0.0;
    slip[n + i] = in_patch ? given.rigid[n + i] + creepage[1] + given.history[n + i] - L.y(i) : 0.0;
  });
}

void TangentialState::follow_slip() {
  if (!varying) return;
  Plane& along = varying->along();
  for_both([&](std::size_t i) {
    const double x = q[i], y = q[n + i];
    along[i] = set[i] == kSlip ? (slip[i] * x + lateral_slip(i) * y) / magnitude(x, y) : 0.0;
  });
  varying->follow();
  for_both([&](std::size_t i) {
    if (set[i] == kStick) carried[i] = varying->at_rest(i);
  });
}

}  // namespace railstrata
