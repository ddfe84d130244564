#include "bem/patch_part.hpp"

namespace railstrata {
namespace {

/// A range of cells within 0 … count.
struct Range {
  int first = 0, count = 0;
};

/// first … last and `ring` more on both sides, an even number of them where there is room.
Range widened(int first, int last, int ring, int count) {
  Range out{std::max(first - ring, 0), 0};
  out.count = std::min(last + ring, count - 1) - out.first + 1;
  if (out.count % 2 == 0 || out.count == count) return out;
  if (out.first + out.count < count)
    ++out.count;
  else
    out = {out.first - 1, out.count + 1};
  return out;
}

}  // namespace

std::optional<PatchPart> widened_part(const PatchGrid& grid, const Plane& bound, int ring_x, int ring_y) {
  int first_x = grid.nx, last_x = -1, first_y = grid.ny, last_y = -1;
  for (int i = 0; i < grid.nx; ++i)
    for (int j = 0; j < grid.ny; ++j) {
      if (!(bound[grid.index(i, j)] > 0)) continue;
      first_x = std::min(first_x, i);
      last_x = std::max(last_x, i);
      first_y = std::min(first_y, j);
      last_y = std::max(last_y, j);
    }
  if (grid.line || last_x < 0) return {};
  const Range x = widened(first_x, last_x, ring_x, grid.nx), y = widened(first_y, last_y, ring_y, grid.ny);
  return PatchPart{grid, x.first, y.first, x.count, y.count};
}

std::optional<PatchPart> part_with(const PatchGrid& grid, const Plane& bound, int ring) {
  const std::optional<PatchPart> part = widened_part(grid, bound, ring, ring);
  return part && 3 * part->nx * part->ny <= 2 * grid.nx * grid.ny ? part : std::nullopt;
}

std::optional<PatchPart> tight_part_with(const PatchGrid& grid, const Plane& bound) {
  const std::optional<PatchPart> part = widened_part(grid, bound, 1, 0);
  return part && part->nx * part->ny < grid.nx * grid.ny ? part : std::nullopt;
}

}  // namespace railstrata
