#include "bem/cell_slip.hpp"

#include <cassert>

namespace railstrata {

PlanePair slip_of_cells(const PatchGrid& grid, RollingKind kind, const std::vector<ContactState>& state,
                        const StepSlip& steps) {
  assert(state.size() == grid.size() && steps.x.size() == grid.size() && steps.y.size() == grid.size());
  if (kind == RollingKind::shift) return steps;
  PlanePair out{Plane(grid.size(), 0.0), Plane(grid.size(), 0.0)};
  const auto row = static_cast<std::size_t>(grid.ny);
  const auto in_patch = [&](std::size_t k) { return state[k] != ContactState::separated; };
  for (std::size_t k = 0; k < grid.size(); ++k) {
    if (!in_patch(k)) continue;
    const bool last = k < row || !in_patch(k - row), continued = state[k] == ContactState::slip;
    const bool two = continued && k + row < grid.size() && in_patch(k + row);
    for (const auto& [to, s] : {std::pair(&out.x, &steps.x), std::pair(&out.y, &steps.y)}) {
      const double step = (*s)[k], behind = !last ? (*s)[k - row] : two ? 2 * step - (*s)[k + row] : step;
      (*to)[k] = 0.5 * (step + behind);
    }
  }
  return out;
}

double dissipated(const PatchGrid& grid, RollingKind kind, const Plane& q_x, const Plane& q_y, const PlanePair& before,
                  const StepSlip& steps) {
  assert(q_x.size() == grid.size() && q_y.size() == grid.size());
  assert(steps.x.size() == grid.size() && steps.y.size() == grid.size());
  assert(before.x.size() == before.y.size() && (before.x.empty() || before.x.size() == grid.size()));
  const auto row = static_cast<std::size_t>(grid.ny);
  const auto over_step = [&](const Plane& q, const Plane& q_before, std::size_t k) {
    if (kind == RollingKind::steady) return 0.5 * (q[k] + (k + row < q.size() ? q[k + row] : 0.0));
    return kind == RollingKind::shift || q_before.empty() ? q[k] : 0.5 * (q[k] + q_before[k]);
  };
  double sum = 0;
  for (std::size_t k = 0; k < grid.size(); ++k)
    sum += over_step(q_x, before.x, k) * steps.x[k] + over_step(q_y, before.y, k) * steps.y[k];
  return sum * grid.cell_area();
}

}  // namespace railstrata
