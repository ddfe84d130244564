#include "bem/leading_edge.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace railstrata {

double film_share(const InfluenceOperator& influence, double more) {
  return (influence.film() + more) / (influence.of_one_cell(0).xx - influence.of_one_cell(1).xx + more);
}

namespace {

/// Gaps of the first and the second empty cell [m], in the columns low, own and high.
struct GapsAhead {
  double next[3] = {0, 0, 0}, beyond[3] = {0, 0, 0};
};

/// lambda of a gap that opens from `gap` to `next`.
double weight_of(double gap, double next, double film) {
  constexpr double kLargest = 0.64, kLargestDistance = 0.9;
  const double opening = next - gap;
  if (!(opening > gap)) return 0;
  double weight = std::min(gap / opening, kLargest);
  if (film > 0 && gap > 0) {
    const double distance = 1 / (std::cbrt(std::pow((gap + opening) / gap, 2)) - 1);
    weight += film * (std::min(distance, kLargestDistance) - weight);
  }
  return weight;
}

/// m, along x and y; columns: from low to high.
std::array<double, 2> slip_of(const GapsAhead& g, double weight, double beta, const PatchGrid& grid, int columns) {
  const double next = g.next[1], beyond = g.beyond[1],
               left = 2 * beta / (3 * std::numbers::pi) * (1 + weight) * next * std::log(beyond / next),
               slope_x = (beyond - next) / grid.dx,
               slope_y = 0.5 * (g.next[2] - g.next[0] + g.beyond[2] - g.beyond[0]) / (std::max(columns, 1) * grid.dy),
               slope = std::hypot(slope_x, slope_y);
  return {left * slope_x / slope, left * slope_y / slope};
}

/// The first cell of a row and what lies ahead of it.
struct FirstCell {
  std::size_t first = 0, ahead = 0, next = 0;
  std::size_t columns[3] = {0, 0, 0};  ///< cells of the first empty row: low, own, high
  int apart = 0;                       ///< low to high
};

/// kernel(FirstCell) for each one with two empty cells ahead of it on the grid.
template <class Kernel>
void for_first_cells(const PatchGrid& grid, const NormalSolution& normal, Kernel&& kernel) {
  for (int i = 0; i + 2 < grid.nx; ++i)
    for (int j = 0; j < grid.ny; ++j) {
      const int low = std::max(j - 1, 0), high = std::min(j + 1, grid.ny - 1);
      const FirstCell cell{grid.index(i, j),
                           grid.index(i + 1, j),
                           grid.index(i + 2, j),
                           {grid.index(i + 1, low), grid.index(i + 1, j), grid.index(i + 1, high)},
                           high - low};
      if (normal.pressure[cell.first] > 0 && !(normal.pressure[cell.ahead] > 0) && !(normal.pressure[cell.next] > 0))
        kernel(cell);
    }
}

GapsAhead gaps_ahead(const PatchGrid& grid, const NormalSolution& normal, const FirstCell& cell) {
  GapsAhead out;
  for (std::size_t c = 0; c < 3; ++c) {
    out.next[c] = std::max(0.0, normal.gap[cell.columns[c]]);
    out.beyond[c] = std::max(0.0, normal.gap[cell.columns[c] + static_cast<std::size_t>(grid.ny)]);
  }
  return out;
}

/// Dundurs' constant at the surface; 0 beyond its bound.
double beta_of(const InfluenceOperator& influence) {
  constexpr double kLargest = 0.5;
  const RectangleInfluence& near = influence.of_one_cell(1);
  return std::abs(near.nx) <= kLargest * near.nn ? near.nx / near.nn : 0.0;
}

}  // namespace

Plane leading_weights(const PatchGrid& grid, const NormalSolution& normal, double film) {
  assert(normal.pressure.size() == grid.size());
  Plane weight(grid.size(), 0.0);
  for_first_cells(grid, normal, [&](const FirstCell& cell) {
    weight[cell.first] = weight_of(std::max(0.0, normal.gap[cell.ahead]), normal.gap[cell.next], film);
  });
  return weight;
}

PlanePair leading_slip_by_pressure(const InfluenceOperator& influence, const PatchGrid& grid,
                                   const NormalSolution& normal, const Plane& weight) {
  assert(normal.pressure.size() == grid.size() && weight.size() == grid.size());
  PlanePair slip{Plane(grid.size(), 0.0), Plane(grid.size(), 0.0)};
  const double beta = beta_of(influence);
  if (beta == 0) return slip;
  for_first_cells(grid, normal, [&](const FirstCell& cell) {
    if (!(weight[cell.first] > 0)) return;
    const auto [x, y] = slip_of(gaps_ahead(grid, normal, cell), weight[cell.first], beta, grid, cell.apart);
    slip.x[cell.first] = x;
    slip.y[cell.first] = y;
  });
  return slip;
}

std::vector<LeadingByGap> leading_by_gap(const InfluenceOperator& influence, const PatchGrid& grid,
                                         const NormalSolution& normal, double film) {
  constexpr double kShare = 1e-6;  // of the gap, a step of differences
  const double beta = influence.couples() ? beta_of(influence) : 0.0;
  std::vector<LeadingByGap> out;
  for_first_cells(grid, normal, [&](const FirstCell& cell) {
    GapsAhead gaps = gaps_ahead(grid, normal, cell);
    const double step = kShare * gaps.beyond[1];
    gaps.next[1] = std::max(gaps.next[1], 2 * step);
    if (!(weight_of(gaps.next[1], gaps.beyond[1], film) > 0)) return;
    const auto at = [&](double& gap, double by) {
      const double before = std::exchange(gap, gap + by), weight = weight_of(gaps.next[1], gaps.beyond[1], film);
      const auto [x, y] = beta == 0 ? std::array<double, 2>{} : slip_of(gaps, weight, beta, grid, cell.apart);
      gap = before;
      return LeadingByGap{0, 0, weight, x, y};
    };
    for (std::size_t c = 0; c < 3; ++c)
      for (const bool second : {false, true}) {
        const std::size_t empty = cell.columns[c] + (second ? static_cast<std::size_t>(grid.ny) : 0);
        if (normal.pressure[empty] > 0 || (c != 1 && (beta == 0 || empty == cell.columns[1]))) continue;
        double& gap = second ? gaps.beyond[c] : gaps.next[c];
        const LeadingByGap more = at(gap, step), less = at(gap, -step);
        out.push_back({cell.first, empty, (more.weight - less.weight) / (2 * step),
                       (more.slip_x - less.slip_x) / (2 * step), (more.slip_y - less.slip_y) / (2 * step)});
      }
  });
  return out;
}

}  // namespace railstrata
