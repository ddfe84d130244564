#pragma once
// The potential contact area: a rectangle of equal cells in the contact plane.
#include <cstddef>
#include <vector>

namespace railstrata {

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
  double cell_area() const { return dx * dy; }
};

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
