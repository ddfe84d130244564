#include "bem/leading_edge.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace railstrata {

double film_share(const InfluenceOperator& influence, double more) {
  return (influence.film() + more) / (influence.of_one_cell(0).xx - influence.of_one_cell(1).xx + more);
}

Plane leading_weights(const PatchGrid& grid, const NormalSolution& normal, double film) {
  assert(normal.pressure.size() == grid.size());
  constexpr double kLargest = 0.64, kLargestDistance = 0.9;
  Plane weight(grid.size(), 0.0);
  for (int i = 0; i + 2 < grid.nx; ++i)
    for (int j = 0; j < grid.ny; ++j) {
      const std::size_t first = grid.index(i, j), ahead = grid.index(i + 1, j), next = grid.index(i + 2, j);
      if (!(normal.pressure[first] > 0) || normal.pressure[ahead] > 0 || normal.pressure[next] > 0) continue;
      const double gap = std::max(0.0, normal.gap[ahead]), opening = normal.gap[next] - gap;
      if (!(opening > gap)) continue;
      weight[first] = std::min(gap / opening, kLargest);
      if (film > 0 && gap > 0) {
        const double distance = 1 / (std::cbrt(std::pow((gap + opening) / gap, 2)) - 1);
        weight[first] += film * (std::min(distance, kLargestDistance) - weight[first]);
      }
    }
  return weight;
}

PlanePair leading_slip_by_pressure(const InfluenceOperator& influence, const PatchGrid& grid,
                                   const NormalSolution& normal, const Plane& weight) {
  assert(normal.pressure.size() == grid.size() && weight.size() == grid.size());
  const RectangleInfluence& near = influence.of_one_cell(1);
  const auto gap = [&](int i, int j) { return std::max(0.0, normal.gap[grid.index(i, j)]); };
  PlanePair slip{Plane(grid.size(), 0.0), Plane(grid.size(), 0.0)};
  constexpr double kLargest = 0.5;  // of Dundurs' constant
  if (!(std::abs(near.nx) <= kLargest * near.nn)) return slip;
  const double beta = near.nx / near.nn;
  for (int i = 0; i + 2 < grid.nx; ++i)
    for (int j = 0; j < grid.ny; ++j) {
      const std::size_t first = grid.index(i, j);
      if (!(weight[first] > 0)) continue;
      const double next = gap(i + 1, j), beyond = gap(i + 2, j);
      const double left = 2 * beta / (3 * std::numbers::pi) * (1 + weight[first]) * next * std::log(beyond / next);
      const int low = std::max(j - 1, 0), high = std::min(j + 1, grid.ny - 1);
      const double slope_x = (beyond - next) / grid.dx,
                   slope_y = 0.5 * (gap(i + 1, high) - gap(i + 1, low) + gap(i + 2, high) - gap(i + 2, low)) /
                             (std::max(high - low, 1) * grid.dy);
      const double slope = std::hypot(slope_x, slope_y);
      slip.x[first] = left * slope_x / slope;
      slip.y[first] = left * slope_y / slope;
    }
  return slip;
}

}  // namespace railstrata
