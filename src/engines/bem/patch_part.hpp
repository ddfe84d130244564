#pragma once
// The part of a grid that bears tractions: transforms of its planes cost less than those of the whole.
#include <algorithm>
#include <cassert>
#include <optional>
#include <vector>

#include "bem/patch_grid.hpp"
#include "bem/plane_algebra.hpp"

namespace railstrata {

/// Cells (first_x + i, first_y + j) of a grid.
struct PatchPart {
  PatchGrid whole;
  int first_x = 0, first_y = 0, nx = 0, ny = 0;

  PatchGrid grid() const {
    PatchGrid out = whole;
    out.nx = nx;
    out.ny = ny;
    out.x0 = whole.x(first_x);
    out.y0 = whole.y(first_y);
    return out;
  }

  template <class T>
  std::vector<T> take(const std::vector<T>& values) const {
    if (values.empty()) return {};
    assert(values.size() == whole.size());
    std::vector<T> out;
    out.reserve(grid().size());
    for (int i = 0; i < nx; ++i) {
      const auto row = values.begin() + static_cast<std::ptrdiff_t>(whole.index(first_x + i, first_y));
      out.insert(out.end(), row, row + ny);
    }
    return out;
  }
  PlanePair take(const PlanePair& values) const { return {take(values.x), take(values.y)}; }
  /// The part of values per row of cells along x.
  Plane take_rows(const Plane& values) const {
    return values.empty() ? Plane{} : Plane(values.begin() + first_y, values.begin() + first_y + ny);
  }

  /// On the whole grid; `outside` where the part is not.
  template <class T>
  std::vector<T> put(const std::vector<T>& values, T outside = {}) const {
    if (values.empty()) return {};
    assert(values.size() == static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny));
    std::vector<T> out(whole.size(), outside);
    for (int i = 0; i < nx; ++i)
      std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i) * ny, ny,
                  out.begin() + static_cast<std::ptrdiff_t>(whole.index(first_x + i, first_y)));
    return out;
  }
  PlanePair put(const PlanePair& values) const { return {put(values.x), put(values.y)}; }
};

/// The cells with `bound` > 0 and `ring` more on every side, with even numbers of cells; none where that would save
/// less than a third of them, on a line, and without such cells.
std::optional<PatchPart> part_with(const PatchGrid& grid, const Plane& bound, int ring);

/// The cells with `bound` > 0 and so many more on every side as the grid has, even numbers of cells; none on a line and
/// without such cells.
std::optional<PatchPart> widened_part(const PatchGrid& grid, const Plane& bound, int ring_x, int ring_y);

/// As few as steady rolling needs, a cell before and behind, even numbers of cells; none on a line, without cells with
/// `bound` > 0, and where that is the grid.
std::optional<PatchPart> tight_part_with(const PatchGrid& grid, const Plane& bound);

}  // namespace railstrata
