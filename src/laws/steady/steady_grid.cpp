#include "steady/steady_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace railstrata {

int SteadyGrid::active_stations() const {
  return std::clamp(static_cast<int>(std::lround((front + active) / dx)), 1, nx);
}

double SteadyGrid::depth(int row) const {
  return std::accumulate(thickness.begin(), thickness.begin() + row, 0.0) +
         0.5 * thickness[static_cast<std::size_t>(row)];
}

double SteadyGrid::share(int i) const {
  const double end = front - nx * dx, begin = -active - hold;
  const double s = std::clamp((x(i) - end) / (begin - end), 0.0, 1.0);
  return 0.5 - 0.5 * std::cos(std::numbers::pi * s);
}

}  // namespace railstrata
