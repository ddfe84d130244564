#pragma once
#include <cassert>
#include <cstddef>
#include <vector>

namespace railstrata {

/// Values of rectangles dx x dy at the offsets (i dx, j dy), i = 0 … nx-1, j = 0 … ny-1 (index j + ny i), from what
/// stands at their corners: corner(x, y), and cell(index, ++, -+, +-, --), signs of the corner along x and y.
/// Neighbours share their corners.
template <class Corner, class Cell>
auto corner_table(int nx, int ny, double dx, double dy, Corner&& corner, Cell&& cell) {
  assert(nx > 0 && ny > 0 && dx > 0 && dy > 0);
  const auto pitch = static_cast<std::size_t>(ny);
  std::vector<decltype(corner(dx, dy))> lower(pitch + 1), upper(pitch + 1);
  const auto fill = [&](int i) {
    for (std::size_t j = 0; j <= pitch; ++j) upper[j] = corner((i - 0.5) * dx, (static_cast<double>(j) - 0.5) * dy);
  };
  std::vector<decltype(cell(pitch, upper[0], lower[0], upper[0], lower[0]))> table(static_cast<std::size_t>(nx) *
                                                                                   pitch);
  fill(0);
  for (int i = 0; i < nx; ++i) {
    lower.swap(upper);
    fill(i + 1);
    for (std::size_t j = 0; j < pitch; ++j) {
      const std::size_t k = static_cast<std::size_t>(i) * pitch + j;
      table[k] = cell(k, upper[j + 1], lower[j + 1], upper[j], lower[j]);
    }
  }
  return table;
}

}  // namespace railstrata
