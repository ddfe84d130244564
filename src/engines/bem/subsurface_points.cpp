#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "bem/layer_correction.hpp"
#include "bem/subsurface.hpp"

namespace railstrata {

namespace {

/// Cubic through four points at 0, 1, 2, 3.
std::array<double, 4> cubic_weights(double t) {
  return {-(t - 1) * (t - 2) * (t - 3) / 6, t * (t - 2) * (t - 3) / 2, -t * (t - 1) * (t - 3) / 2,
          t * (t - 1) * (t - 2) / 6};
}

/// The sixteen cells around a point of the plan with their weights.
struct Around {
  std::size_t first;
  std::array<double, 16> weight{};
  Around(const PatchGrid& g, const Vec3& at) {
    const double u = (at.x - g.x0) / g.dx, v = (at.y - g.y0) / g.dy;
    const int i = std::clamp(static_cast<int>(std::floor(u)) - 1, 0, g.nx - 4),
              j = g.line ? 0 : std::clamp(static_cast<int>(std::floor(v)) - 1, 0, g.ny - 4);
    first = g.index(i, j);
    const std::array<double, 4> x = cubic_weights(u - i),
                                y = g.line ? std::array<double, 4>{1, 0, 0, 0} : cubic_weights(v - j);
    for (std::size_t k = 0; k < weight.size(); ++k) weight[k] = x[k / 4] * y[k % 4];
  }
  double of(const PatchGrid& g, const Plane& v) const {
    double sum = 0;
    const std::size_t columns = g.line ? 1 : 4;
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < columns; ++b)
        sum += weight[4 * a + b] * v[first + a * static_cast<std::size_t>(g.ny) + b];
    return sum;
  }
};

/// Lengths of the grid beyond its rim, and points of a transform with layers: what lies farther feels a point load, and
/// costs minutes and memory without end.
constexpr double kFarthest = 10, kMostPoints = 2e7;

double length_of(const PatchGrid& grid) { return std::max(grid.nx * grid.dx, grid.line ? 0.0 : grid.ny * grid.dy); }

[[noreturn]] void refuse_far(const PatchGrid& grid, const Vec3& p, double reach) {
  throw std::out_of_range(fmt::format(
      "a point is too far away, at x = {:.4g} m, y = {:.4g} m: points may reach {:.3g} m beyond the grid of x = {:.4g} "
      "to {:.4g} m, y = {:.4g} to {:.4g} m ({:.3g} of its lengths, to limit time and memory); coordinates are in "
      "metres; farther away the contact acts as a point load",
      p.x, p.y, reach, grid.x0, grid.x(grid.nx - 1), grid.y0, grid.y(grid.ny - 1), reach / length_of(grid)));
}

/// A number of the cells of a patch, and of the ring of cells around it, by what they have next to it.
class AroundPatch {
 public:
  AroundPatch(const PatchGrid& grid, const Plane& pressure) : grid_(grid), pressure_(pressure) {}

  /// next(value beside, value behind it): of a cell without pressure, from those with it on one side.
  template <class Next>
  void fill(Plane& values, Next&& next) const {
    const Plane given = values;
    for (int i = 0; i < grid_.nx; ++i)
      for (int j = 0; j < grid_.ny; ++j) {
        if (presses(i, j)) continue;
        double sum = 0, sides = 0;
        for (const auto& [a, b] : kSides) {
          if (!presses(i + a, j + b)) continue;
          const double beside = given[grid_.index(i + a, j + b)];
          sum += next(beside, presses(i + 2 * a, j + 2 * b) ? given[grid_.index(i + 2 * a, j + 2 * b)] : 2 * beside);
          ++sides;
        }
        values[grid_.index(i, j)] = sides > 0 ? sum / sides : 0;
      }
  }
  /// Second differences along a side, where the cell and those on both sides press; 0 elsewhere.
  Plane curvature(const Plane& values, int a, int b) const {
    Plane out(values.size(), 0.0);
    for (int i = 0; i < grid_.nx; ++i)
      for (int j = 0; j < grid_.ny; ++j)
        if (presses(i, j) && presses(i - a, j - b) && presses(i + a, j + b))
          out[grid_.index(i, j)] =
              values[grid_.index(i - a, j - b)] - 2 * values[grid_.index(i, j)] + values[grid_.index(i + a, j + b)];
    return out;
  }
  /// Linear between cells, (x, y) in cells.
  double at(const Plane& values, double x, double y) const {
    const int i = std::clamp(static_cast<int>(std::floor(x)), 0, std::max(0, grid_.nx - 2)),
              j = std::clamp(static_cast<int>(std::floor(y)), 0, std::max(0, grid_.ny - 2));
    const double u = std::clamp(x - i, 0.0, 1.0), v = grid_.ny > 1 ? std::clamp(y - j, 0.0, 1.0) : 0;
    const auto line = [&](int k) {
      return (1 - v) * values[grid_.index(k, j)] + (v > 0 ? v * values[grid_.index(k, j + 1)] : 0);
    };
    return (1 - u) * line(i) + (u > 0 ? u * line(i + 1) : 0);
  }

 private:
  static constexpr std::array<std::pair<int, int>, 8> kSides{
      {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};
  bool presses(int i, int j) const {
    return i >= 0 && j >= 0 && i < grid_.nx && j < grid_.ny && pressure_[grid_.index(i, j)] > 0;
  }
  const PatchGrid& grid_;
  const Plane& pressure_;
};

}  // namespace

bool Subsurface::covers(const Vec3& at) const {
  const PatchGrid& g = grid_;
  return at.x >= g.x(1) && at.x <= g.x(g.nx - 2) && (g.line || (at.y >= g.y(1) && at.y <= g.y(g.ny - 2)));
}

Sym3 Subsurface::stress_at(const StatePlane& plane, const Vec3& at, bool below_interface) const {
  const StatePlane& s = plane.side(below_interface);
  const Around near(grid_, at);
  const auto of = [&](const Plane& v) { return near.of(grid_, v); };
  return stress_of({of(s.e_xx), of(s.e_yy), of(s.e_xy), of(s.s_xz), of(s.s_yz), of(s.s_zz)},
                   material_at(at.y, s.depth, below_interface));
}

std::unique_ptr<Subsurface> Subsurface::widened(int more_x, int more_y) const {
  PatchGrid g{grid_.nx + 2 * more_x,        grid_.ny + 2 * more_y,        grid_.dx,  grid_.dy,
              grid_.x0 - more_x * grid_.dx, grid_.y0 - more_y * grid_.dy, grid_.line};
  const auto padded = [&](const Plane& v) {
    Plane wide(g.size(), 0.0);
    for (int i = 0; i < grid_.nx; ++i)
      std::copy_n(v.begin() + static_cast<std::ptrdiff_t>(grid_.index(i, 0)), grid_.ny,
                  wide.begin() + static_cast<std::ptrdiff_t>(g.index(i + more_x, more_y)));
    return wide;
  };
  auto wide = std::make_unique<Subsurface>(body_, g, padded(loads_.p), padded(loads_.q_x), padded(loads_.q_y), period_);
  wide->reach_x_ = reach_x_ + more_x;
  wide->reach_y_ = reach_y_ + more_y;
  wide->follow(*this);
  return wide;
}

/// The part of the grid that carries pressure, with a rim of so many cells where the grid has them.
PatchGrid Subsurface::loaded(int rim) const {
  int first_i = grid_.nx, last_i = -1, first_j = grid_.ny, last_j = -1;
  for (int i = 0; i < grid_.nx; ++i)
    for (int j = 0; j < grid_.ny; ++j) {
      if (!(loads_.p[grid_.index(i, j)] > 0)) continue;
      first_i = std::min(first_i, i);
      last_i = i;
      first_j = std::min(first_j, j);
      last_j = std::max(last_j, j);
    }
  if (last_i < 0) return grid_;
  first_i = std::max(0, first_i - rim);
  first_j = std::max(0, first_j - rim);
  PatchGrid out = grid_;
  out.nx = std::min(grid_.nx - 1, last_i + rim) - first_i + 1;
  out.ny = std::min(grid_.ny - 1, last_j + rim) - first_j + 1;
  out.x0 = grid_.x(first_i);
  out.y0 = grid_.y(first_j);
  return out;
}

std::unique_ptr<Subsurface> Subsurface::refined(int times) const {
  constexpr int kRim = 4;  // cells: farther away from the patch steps do not show
  const PatchGrid inner = loaded(kRim);
  PatchGrid g = inner;
  g.nx *= times;
  g.dx /= times;
  g.x0 -= 0.5 * (inner.dx - g.dx);
  if (!g.line) {
    g.ny *= times;
    g.dy /= times;
    g.y0 -= 0.5 * (inner.dy - g.dy);
  }
  const AroundPatch patch(grid_, loads_.p);
  Plane square(grid_.size(), 0.0);
  std::array<Plane, 2> ratio{square, square};
  for (std::size_t k = 0; k < square.size(); ++k) {
    if (!(loads_.p[k] > 0)) continue;
    square[k] = loads_.p[k] * loads_.p[k];
    ratio[0][k] = loads_.q_x[k] / loads_.p[k];
    ratio[1][k] = loads_.q_y[k] / loads_.p[k];
  }
  patch.fill(square, [](double beside, double behind) { return std::min(0.0, 2 * beside - behind); });
  const Plane along = patch.curvature(square, 1, 0), across = patch.curvature(square, 0, 1);
  const auto bend = [](double place) { return 0.5 * (place - std::floor(place)) * (1 - place + std::floor(place)); };
  for (Plane& r : ratio) patch.fill(r, [](double beside, double) { return beside; });
  Plane p(g.size()), q_x(g.size()), q_y(g.size());
  double sum = 0;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const double x = (g.x_of(k) - grid_.x0) / grid_.dx, y = grid_.line ? 0 : (g.y_of(k) - grid_.y0) / grid_.dy;
    const double curved = bend(x) * patch.at(along, x, y) + bend(y) * patch.at(across, x, y);
    p[k] = std::sqrt(std::max(0.0, patch.at(square, x, y) - curved));
    q_x[k] = p[k] * patch.at(ratio[0], x, y);
    q_y[k] = p[k] * patch.at(ratio[1], x, y);
    sum += p[k];
  }
  const double cells = static_cast<double>(g.size() / inner.size()),
               scale = sum > 0 ? cells * std::accumulate(loads_.p.begin(), loads_.p.end(), 0.0) / sum : 1;
  for (Plane* plane : {&p, &q_x, &q_y})
    for (double& v : *plane) v *= scale;
  auto fine = std::make_unique<Subsurface>(body_, g, std::move(p), std::move(q_x), std::move(q_y), period_);
  fine->follow(*this);
  return fine;
}

std::unique_ptr<Subsurface> Subsurface::coarsened() const {
  constexpr int kCells = 3;
  const double middle_x = grid_.x0 + 0.5 * (grid_.nx - 1) * grid_.dx,
               middle_y = grid_.y0 + 0.5 * (grid_.ny - 1) * grid_.dy;
  PatchGrid g = grid_.line ? line_grid(grid_.nx / 2, kCells * grid_.dx, grid_.dy)
                           : centred_grid(grid_.nx / 2, grid_.ny / 2, kCells * grid_.dx, kCells * grid_.dy);
  const double cells = grid_.line ? kCells : kCells * kCells;
  g.x0 += middle_x;
  g.y0 += middle_y;
  const auto means = [&](const Plane& v) {
    Plane out(g.size(), 0.0);
    for (std::size_t k = 0; k < v.size(); ++k) {
      const auto x = static_cast<int>(std::lround((grid_.x_of(k) - g.x0) / g.dx)),
                 y = static_cast<int>(std::lround((grid_.y_of(k) - g.y0) / g.dy));
      out[g.index(x, y)] += v[k] / cells;
    }
    return out;
  };
  auto coarse = std::make_unique<Subsurface>(body_, g, means(loads_.p), means(loads_.q_x), means(loads_.q_y),
                                             std::max(2.5, period_ / kCells));
  coarse->follow(*this);
  return coarse;
}

// Points outside the grid: the same tractions on a grid widened with empty cells. Points are taken by depth, since a
// plane costs a convolution and a point on it next to nothing.
std::vector<InteriorPoint> Subsurface::at(const std::vector<Vec3>& points, bool below_interface) const {
  constexpr double kMostCells = 4e6;
  double reach = kFarthest * length_of(grid_);
  const auto points_at_reach = [&] {
    PatchGrid wide = grid_;
    wide.nx += static_cast<int>(2 * reach / grid_.dx);
    if (!grid_.line) wide.ny += static_cast<int>(2 * reach / grid_.dy);
    return LayerCorrection::points_of(body_, wide, period_);
  };
  while (layered_ && points_at_reach() > kMostPoints && reach > 0.1 * length_of(grid_)) reach *= 0.9;
  int more_x = 0, more_y = 0;
  for (const Vec3& p : points) {
    if (!(p.z >= 0)) throw std::out_of_range("Subsurface::at: a point above the surface");
    if (covers(p)) continue;
    const double x = std::max(grid_.x0 - p.x, p.x - grid_.x(grid_.nx - 1)) / grid_.dx,
                 y = grid_.line ? 0.0 : std::max(grid_.y0 - p.y, p.y - grid_.y(grid_.ny - 1)) / grid_.dy;
    if (!(std::max(x * grid_.dx, y * grid_.dy) <= reach)) refuse_far(grid_, p, reach);
    more_x = std::max(more_x, static_cast<int>(std::ceil(x)) + 2);
    if (!grid_.line) more_y = std::max(more_y, static_cast<int>(std::ceil(y)) + 2);
    if (!((grid_.nx + 2.0 * more_x) * (grid_.ny + 2.0 * more_y) < kMostCells))
      throw std::out_of_range("Subsurface::at: a point too far away for cells of this size");
  }
  if (more_x > 0 || more_y > 0) return widened(more_x, more_y)->at(points, below_interface);

  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return points[a].z < points[b].z; });
  std::vector<InteriorPoint> out(points.size());
  StatePlane s;
  DisplacementPlane u;
  for (std::size_t k : order) {
    const Vec3& p = points[k];
    if (s.s_zz.empty() || s.depth != p.z) {
      s = plane(p.z);
      u = displacement(p.z, below_interface);
    }
    const Around near(grid_, p);
    const auto of = [&](const Plane& v) { return near.of(grid_, v); };
    out[k].displacement = {of(u.u_x), of(u.u_y), of(u.u_z)};
    out[k].stress = stress_at(s, p, below_interface);
  }
  return out;
}

}  // namespace railstrata
