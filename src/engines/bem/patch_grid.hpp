#pragma once
// The potential contact area: a rectangle of equal cells in the contact plane.
#include <algorithm>
#include <cstddef>
#include <vector>

namespace railstrata {

inline constexpr double kDefaultCell = 0.25e-3;                        ///< m, side of a cell
inline constexpr double kSmallestCell = 0.02e-3, kLargestCell = 5e-3;  ///< m: what commands and tools take

/// nx x ny cells of size dx x dy; cell (i, j) is centred at (x0 + i dx, y0 + j dy) and has index j + ny i (y fastest,
/// as in ContactField). Metres. A line contact has one column of cells, as long as the line, and knows no ends of it.
struct PatchGrid {
  int nx = 0, ny = 0;
  double dx = 0, dy = 0;
  double x0 = 0, y0 = 0;
  bool line = false;  ///< plane strain: ny = 1

  std::size_t size() const { return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny); }
  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(ny) + static_cast<std::size_t>(j);
  }
  double x(int i) const { return x0 + i * dx; }
  double y(int j) const { return y0 + j * dy; }
  double x_of(std::size_t cell) const { return x(static_cast<int>(cell) / ny); }
  double y_of(std::size_t cell) const { return y(static_cast<int>(cell) % ny); }
  double cell_area() const { return dx * dy; }
  /// The shorter side of a cell; of a line, whose dy is its length, dx.
  double finest() const { return line ? dx : std::min(dx, dy); }
};

/// The largest value in the outermost ring of cells, at least 0; of a line at its two ends.
inline double largest_at_rim(const std::vector<double>& v, const PatchGrid& g) {
  double most = 0;
  for (int i = 0; i < g.nx && !g.line; ++i) most = std::max({most, v[g.index(i, 0)], v[g.index(i, g.ny - 1)]});
  for (int j = 0; j < g.ny; ++j) most = std::max({most, v[g.index(0, j)], v[g.index(g.nx - 1, j)]});
  return most;
}

/// Cells centred on the origin: 2 i + 1 by 2 j + 1.
inline PatchGrid centred_grid(int half_nx, int half_ny, double dx, double dy) {
  return {2 * half_nx + 1, 2 * half_ny + 1, dx, dy, -half_nx * dx, -half_ny * dy};
}

/// Grid of a line contact: 2 i + 1 cells of a line.
inline PatchGrid line_grid(int half_nx, double dx, double length) {
  PatchGrid grid = centred_grid(half_nx, 0, dx, length);
  grid.line = true;
  return grid;
}

}  // namespace railstrata
