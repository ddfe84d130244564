#include "bem/leading_edge.hpp"

#include <algorithm>

namespace railstrata {

Plane leading_weights(const PatchGrid& grid, const NormalSolution& normal) {
  constexpr double kLargest = 0.64;
  Plane weight(grid.size(), 0.0);
  for (int i = 0; i + 2 < grid.nx; ++i)
    for (int j = 0; j < grid.ny; ++j) {
      const std::size_t first = grid.index(i, j), ahead = grid.index(i + 1, j), next = grid.index(i + 2, j);
      if (!(normal.pressure[first] > 0) || normal.pressure[ahead] > 0 || normal.pressure[next] > 0) continue;
      const double gap = std::max(0.0, normal.gap[ahead]), opening = normal.gap[next] - gap;
      if (opening > gap) weight[first] = std::min(gap / opening, kLargest);
    }
  return weight;
}

}  // namespace railstrata
