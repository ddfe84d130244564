#pragma once
// Stresses below a Hertz contact without grids, as truth for whatever is made of stress histories.
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "core/parallel.hpp"
#include "damage/stress_history.hpp"

namespace railstrata::testing {

/// p = p0 sqrt(1 - x^2/a^2 - y^2/b^2) with traction mu p along +x on the body, p0 = 1; z into the body.
struct HertzLoad {
  double a = 1, b = 1, friction = 0, poisson = 0.3;

  /// Superposition of plane waves of all directions: each is a line load of elliptic shape in its own direction.
  /// Midpoint rule; errors below 1e-4 at depths from 0.001 a. At smaller depths the stress at 0.001 a.
  Sym3 at(double x, double y, double depth) const {
    const double z = std::max(depth, 1e-3 * a), d = z / a;
    const int slender = static_cast<int>(std::ceil(std::max(a, b) / std::min(a, b)));
    const int n = slender * (d >= 0.12 ? 96 : d >= 0.04 ? 160 : d >= 0.015 ? 384 : d >= 0.006 ? 768 : 2560);
    Sym3 sum;
    for (int i = 0; i < n; ++i) {
      const double angle = std::numbers::pi * (i + 0.5) / n, nx = std::cos(angle), ny = std::sin(angle);
      sum = sum + wave(nx, ny, x * nx + y * ny, z);
    }
    return (a * b / n) * sum;
  }

 private:
  Sym3 wave(double nx, double ny, double xi, double z) const {
    using Complex = std::complex<double>;
    const double c = std::sqrt(a * a * nx * nx + b * b * ny * ny), nu = poisson;
    const double re = z / c, im = xi / c;  // s = re - i im
    // acot s = ln((s + i)/(s - i))/2i, by parts
    const double modulus = 0.5 * std::log((re * re + (1 - im) * (1 - im)) / (re * re + (1 + im) * (1 + im)));
    const Complex acot(0.5 * (std::atan2(1 - im, re) + std::atan2(1 + im, re)), -0.5 * modulus), s(re, -im);
    const Complex f0 = (1. - s * acot) / (c * c), f1 = z * (acot - s / (1. + s * s)) / (c * c * c);
    const double m = friction;
    const double nn = -(f0 - f1).real() - m * nx * (2. * f0 - f1).imag(), zz = -(f0 + f1).real() - m * nx * f1.imag(),
                 nz = -f1.imag() - m * nx * (f0 - f1).real(), mm = -2 * nu * (f0.real() + m * nx * f0.imag()),
                 mz = m * ny * f0.real(), nm = m * ny * f0.imag();
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
  for_each(h.rows() * h.columns(), [&](std::ptrdiff_t p) {
    const int row = static_cast<int>(p) / h.columns(), column = static_cast<int>(p) % h.columns();
    for (int i = 0; i < h.samples(); ++i) h.cycle(row, column)[i] = load.at(h.x[i], h.y[column], h.depth[row]);
  });
  return h;
}

inline std::vector<double> steps(double from, double to, double step) {
  std::vector<double> v;
  const int n = static_cast<int>(std::lround((to - from) / step));
  for (int i = 0; i <= n; ++i) v.push_back(from + (to - from) * i / n);
  return v;
}

}  // namespace railstrata::testing
