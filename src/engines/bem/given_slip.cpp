#include "bem/given_slip.hpp"

#include <cassert>

namespace railstrata {

namespace {

void fill_rigid_slip(const PatchGrid& grid, const TangentialProblem& problem, double step, GivenSlip& out) {
  // With whole cells a sixth of a step ahead: between the cell and the middle of the step this cancels most of the
  // leading edge's discretisation error.
  const bool rolls = problem.kind != RollingKind::shift, whole_cells = problem.leading_weight.empty();
  const double ahead = !rolls ? 0.0 : step / (whole_cells ? 6 : 2);
  const bool turns = problem.spin != 0 || !problem.local_spin.empty();
  if (rolls && !whole_cells && turns) out.to_own_place.resize(grid.size());
  if (rolls && whole_cells && turns) out.to_middle_of_step.resize(static_cast<std::size_t>(grid.ny));
  const std::size_t n = grid.size();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t j = k % static_cast<std::size_t>(grid.ny);
    const double local = problem.local_spin.empty() ? problem.spin : problem.spin + problem.local_spin[j];
    out.rigid[k] = -problem.spin * grid.y_of(k) + (problem.extra_slip.x.empty() ? 0.0 : problem.extra_slip.x[k]);
    out.rigid[n + k] = local * (grid.x_of(k) + ahead) + (problem.extra_slip.y.empty() ? 0.0 : problem.extra_slip.y[k]);
    if (!out.to_own_place.empty()) out.to_own_place[k] = -local * step / 3;
    if (!out.to_middle_of_step.empty()) out.to_middle_of_step[j] = local * step / 3;
    if (!problem.before.x.empty()) out.history[k] = problem.before.x[k] / step;
    if (!problem.before.y.empty()) out.history[n + k] = problem.before.y[k] / step;
  }
}

/// Where the first cells of the rows are, and their parts of the slip.
void cut_first_cells(const PatchGrid& grid, const TangentialProblem& problem, double step, GivenSlip& out) {
  if (problem.leading_weight.empty() || problem.kind == RollingKind::shift) return;
  const std::size_t n = grid.size(), ahead = static_cast<std::size_t>(grid.ny);
  out.first_step.assign(n, step);
  for (std::size_t k = 0; k + ahead < n; ++k) {
    const double lambda = problem.leading_weight[k];
    if (!(lambda > 0 && problem.traction_bound[k] > 0)) continue;
    const double weight = lambda / (1 - lambda);
    out.leading.push_back({k, weight});
    out.first_step[k] *= 1 - lambda;
    for (Plane* fixed : {&out.rigid, &out.history})
      for (const std::size_t c : {k, n + k}) (*fixed)[c] += weight * ((*fixed)[c] - (*fixed)[c + ahead]);
  }
}

}  // namespace

GivenSlip given_slip(const PatchGrid& grid, const TangentialProblem& problem) {
  [[maybe_unused]] const auto fits = [&](const Plane& plane) { return plane.empty() || plane.size() == grid.size(); };
  assert(problem.traction_bound.size() == grid.size() && fits(problem.leading_weight));
  assert(fits(problem.extra_slip.x) && fits(problem.extra_slip.y) && fits(problem.before.x) && fits(problem.before.y));
  assert(fits(problem.plastic_before) && fits(problem.lost_before));
  assert(problem.local_spin.empty() || problem.local_spin.size() == static_cast<std::size_t>(grid.ny));
  assert(problem.kind != RollingKind::transient || problem.step > 0);
  GivenSlip out{Plane(2 * grid.size()), Plane(2 * grid.size(), 0.0), {}, {}, {}, {}};
  const double step = step_length(grid, problem);
  fill_rigid_slip(grid, problem, step, out);
  cut_first_cells(grid, problem, step, out);
  return out;
}

}  // namespace railstrata
