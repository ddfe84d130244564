#pragma once
// Stresses below a Hertz contact without grids, as truth for whatever is made of stress histories.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/parallel.hpp"
#include "damage/stress_history.hpp"

namespace railstrata::testing {

/// p = p0 sqrt(1 - x^2/a^2 - y^2/b^2) with traction mu p along +x on the body, p0 = 1; z into the body.
struct HertzLoad {
  double a = 1, b = 1, friction = 0, poisson = 0.3;

  /// At points (x, y, depth) of one depth. Superposition of plane waves of all directions: each is a line load of
  /// elliptic shape in its own direction. Midpoint rule; errors below 1e-4 at depths from 0.001 a; at smaller ones the
  /// stress at 0.001 a.
  std::vector<Sym3> stresses(const std::vector<Vec3>& points) const {
    const double z = std::max(points.at(0).z, 1e-3 * a), d = z / a;
    const int slender = static_cast<int>(std::ceil(std::max(a, b) / std::min(a, b)));
    const int n = slender * (d >= 0.12 ? 96 : d >= 0.04 ? 160 : d >= 0.015 ? 384 : d >= 0.006 ? 768 : 2560);
    std::vector<Vec3> directions;  // cosine, sine, half-length of the line load
    for (int i = 0; i < n; ++i) {
      const double angle = std::numbers::pi * (i + 0.5) / n, x = std::cos(angle), y = std::sin(angle);
      directions.push_back({x, y, std::sqrt(a * a * x * x + b * b * y * y)});
    }
    std::vector<Sym3> out(points.size());
    for_each(static_cast<std::ptrdiff_t>(points.size()), [&](std::ptrdiff_t i) {
      Sym3 sum;
      for (const Vec3& e : directions) sum = sum + wave(e.x, e.y, e.z, points[i].x * e.x + points[i].y * e.y, z);
      out[i] = (a * b / n) * sum;
    });
    return out;
  }
  Sym3 at(double x, double y, double depth) const { return stresses({{x, y, depth}})[0]; }

 private:
  Sym3 wave(double nx, double ny, double c, double xi, double z) const {
    const double r = z / c, t = xi / c;  // s = r - i t
    // acot s = ln((s + i)/(s - i))/2i
    const double acot_r = 0.5 * std::atan2(2 * r, r * r + t * t - 1),
                 acot_i = 0.25 * std::log((r * r + (1 + t) * (1 + t)) / (r * r + (1 - t) * (1 - t)));
    const double q_r = 1 + r * r - t * t, q_i = -2 * r * t, q = 1 / (q_r * q_r + q_i * q_i);  // 1 + s^2
    const double ratio_r = (r * q_r - t * q_i) * q, ratio_i = (-t * q_r - r * q_i) * q;       // s/(1 + s^2)
    const double c2 = 1 / (c * c), zc3 = z * c2 / c, m = friction, nu = poisson;
    const double f0_r = (1 - r * acot_r - t * acot_i) * c2, f0_i = (t * acot_r - r * acot_i) * c2;
    const double f1_r = zc3 * (acot_r - ratio_r), f1_i = zc3 * (acot_i - ratio_i);
    const double nn = -(f0_r - f1_r) - m * nx * (2 * f0_i - f1_i), zz = -(f0_r + f1_r) - m * nx * f1_i,
                 nz = -f1_i - m * nx * (f0_r - f1_r), mm = -2 * nu * (f0_r + m * nx * f0_i), mz = m * ny * f0_r,
                 nm = m * ny * f0_i;
    // n = (nx, ny), m = (-ny, nx)
    return {.xx = nn * nx * nx + mm * ny * ny - 2 * nm * nx * ny,
            .yy = nn * ny * ny + mm * nx * nx + 2 * nm * nx * ny,
            .zz = zz,
            .xy = (nn - mm) * nx * ny + nm * (nx * nx - ny * ny),
            .yz = nz * ny + mz * nx,
            .xz = nz * nx - mz * ny};
  }
};

/// The same for a line along y, plane strain, a = 1, in closed form [Johnson1985 eqs. 4.49, 7.2 to 7.7].
struct LineLoad {
  double friction = 0, poisson = 0.3;

  Sym3 at(double x, double, double z) const {
    const double q = 1 - x * x + z * z, r = std::sqrt(q * q + 4 * x * x * z * z);
    const double m = std::sqrt(0.5 * (r + q)), n = std::copysign(std::sqrt(std::max(0., 0.5 * (r - q))), x);
    const double mm = m * m, nn = n * n, sum = std::max(mm + nn, 1e-300);
    const double p_xx = -(m * (1 + (z * z + nn) / sum) - 2 * z), p_zz = -m * (1 - (z * z + nn) / sum),
                 p_xz = -n * (mm - z * z) / sum, q_xx = n * (2 - (z * z - mm) / sum) - 2 * x;
    const double xx = p_xx + friction * q_xx, zz = p_zz + friction * p_xz, xz = p_xz + friction * p_xx;
    return {.xx = xx, .yy = poisson * (xx + zz), .zz = zz, .xz = xz};
  }
  std::vector<Sym3> stresses(const std::vector<Vec3>& points) const {
    std::vector<Sym3> out;
    for (const Vec3& p : points) out.push_back(at(p.x, p.y, p.z));
    return out;
  }
};

/// Ascending samples in [-far, far]: `step` apart near the patch of half-length 1, growing outside, close at its ends.
inline std::vector<double> rolling_samples(double step, double far = 4) {
  std::vector<double> x;
  for (double e : {0., 0.0005, 0.001, 0.002, 0.004, 0.008, 0.012, 0.02, 0.03, 0.06})
    for (double s : {-1., 1.}) {
      x.push_back(1 + s * e);
      x.push_back(-1 - s * e);
    }
  const int n = static_cast<int>(std::ceil(1.3 / step));
  for (int i = -n; i <= n; ++i) x.push_back(1.3 * i / n);
  for (double outside = 1.3 + step, d = 1.3 * step; outside < far; outside += d, d *= 1.3) {
    x.push_back(outside);
    x.push_back(-outside);
  }
  std::sort(x.begin(), x.end());
  x.erase(std::unique(x.begin(), x.end()), x.end());
  return x;
}

template <class Load>
StressHistory history_of(const Load& load, std::vector<double> x, std::vector<double> y, std::vector<double> depth) {
  StressHistory h{.x = std::move(x), .y = std::move(y), .depth = std::move(depth), .zone = {}, .stress = {}};
  h.zone.assign(h.depth.size(), 0);
  h.stress.resize(h.x.size() * h.y.size() * h.depth.size());
  for (int row = 0; row < h.rows(); ++row) {
    std::vector<Vec3> points;
    for (const double lateral : h.y)
      for (const double along : h.x) points.push_back({along, lateral, h.depth[row]});
    const std::vector<Sym3> stresses = load.stresses(points);
    std::copy(stresses.begin(), stresses.end(), h.cycle(row, 0));
  }
  return h;
}

inline std::vector<double> steps(double from, double to, double step) {
  std::vector<double> v;
  const int n = static_cast<int>(std::lround((to - from) / step));
  for (int i = 0; i <= n; ++i) v.push_back(from + (to - from) * i / n);
  return v;
}

}  // namespace railstrata::testing
