#include "cntc/profile_smoothing.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace railstrata::cntc {
namespace {

using Values = std::vector<double>;

/// Turns of the polygon at its points, -pi to pi.
Values turns(const std::vector<Vec2>& p) {
  Values out(p.size(), 0.0);
  for (std::size_t k = 1; k + 1 < p.size(); ++k) {
    const Vec2 before = p[k] - p[k - 1], after = p[k + 1] - p[k];
    const double turn = std::atan2(after.z, after.y) - std::atan2(before.z, before.y);
    out[k] = std::remainder(turn, 2 * std::numbers::pi);
  }
  return out;
}

/// The first and the last point and kinks between them.
std::vector<std::size_t> ends_of_curves(const std::vector<Vec2>& p, const Smoothing& how) {
  const Values turn = turns(p);
  const auto quiet = [&](std::size_t k, int step) {
    for (std::size_t i = k + step; i > 0 && i + 1 < p.size() && norm(p[i] - p[k]) < how.width; i += step)
      if (std::abs(turn[i]) > how.beside) return false;
    return true;
  };
  std::vector<std::size_t> out{0};
  for (std::size_t k = 1; k + 1 < p.size(); ++k)
    if (std::abs(turn[k]) > how.kink && quiet(k, -1) && quiet(k, 1)) out.push_back(k);
  out.push_back(p.size() - 1);
  return out;
}

/// Solves a symmetric system of five diagonals: `a` the main one, `b` and `c` those above it.
Values solved(Values a, Values b, Values c, Values x) {
  const std::size_t n = x.size();
  for (std::size_t k = 0; k < n; ++k) {
    if (k + 1 < n) {
      const double share = b[k] / a[k];
      a[k + 1] -= share * b[k];
      if (k + 2 < n) b[k + 1] -= share * c[k];
      x[k + 1] -= share * x[k];
    }
    if (k + 2 < n) {
      const double share = c[k] / a[k];
      a[k + 2] -= share * c[k];
      x[k + 2] -= share * x[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    if (k + 1 < n) x[k] -= b[k] * x[k + 1];
    if (k + 2 < n) x[k] -= c[k] * x[k + 2];
    x[k] /= a[k];
  }
  return x;
}

/// Reinsch's algorithm: second derivatives g of (R + lambda Q' W^-1 Q) g = Q' y; values y - lambda W^-1 Q g.
Values smooth_values(const Values& s, const Values& y, const Values& weight, double lambda) {
  const std::size_t n = y.size(), inner = n - 2;
  std::vector<std::array<double, 3>> q(inner);
  Values a(inner), b(inner, 0.0), c(inner, 0.0), right(inner);
  for (std::size_t k = 0; k < inner; ++k) {
    const double h0 = s[k + 1] - s[k], h1 = s[k + 2] - s[k + 1];
    q[k] = {1 / h0, -1 / h0 - 1 / h1, 1 / h1};
    right[k] = q[k][0] * y[k] + q[k][1] * y[k + 1] + q[k][2] * y[k + 2];
    a[k] = (h0 + h1) / 3;
    for (std::size_t i = 0; i < 3; ++i) a[k] += lambda * q[k][i] * q[k][i] / weight[k + i];
  }
  for (std::size_t k = 0; k + 1 < inner; ++k) {
    b[k] = (s[k + 2] - s[k + 1]) / 6;
    b[k] += lambda * (q[k][1] * q[k + 1][0] / weight[k + 1] + q[k][2] * q[k + 1][1] / weight[k + 2]);
    if (k + 2 < inner) c[k] = lambda * q[k][2] * q[k + 2][0] / weight[k + 2];
  }
  const Values g = solved(std::move(a), std::move(b), std::move(c), std::move(right));
  Values out = y;
  for (std::size_t k = 0; k < inner; ++k)
    for (std::size_t i = 0; i < 3; ++i) out[k + i] -= lambda * q[k][i] * g[k] / weight[k + i];
  return out;
}

Values weights(const Values& s, const Smoothing& how) {
  constexpr double kAtEnds = 20;
  const std::size_t last = s.size() - 1;
  Values out(s.size(), 1.0);
  if (!how.weighted) return out;
  for (std::size_t k = 1; k < last; ++k) out[k] = 0.5 * (s[k + 1] - s[k - 1]);
  out[0] = kAtEnds * (s[1] - s[0]);
  out[last] = kAtEnds * (s[last] - s[last - 1]);
  return out;
}

}  // namespace

std::vector<Vec2> without_zigzags(const std::vector<Vec2>& points, double zigzag) {
  const Values turn = turns(points);
  std::vector<Vec2> out;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const bool is_one = k + 1 < points.size() && std::abs(turn[k]) > zigzag && std::abs(turn[k + 1]) > zigzag;
    out.push_back(is_one ? 0.5 * (points[k] + points[k + 1]) : points[k]);
    k += is_one ? 1 : 0;
  }
  return out;
}

std::vector<Vec2> smoothed(const std::vector<Vec2>& points, const Smoothing& how) {
  constexpr double kAtKinks = 100;
  if (!(how.amount > 0) || points.size() < 3) return points;
  const std::size_t n = points.size();
  Values s(n, 0.0), y(n), z(n);
  for (std::size_t k = 0; k < n; ++k) {
    if (k > 0) s[k] = s[k - 1] + norm(points[k] - points[k - 1]);
    y[k] = points[k].y;
    z[k] = points[k].z;
  }
  Values weight = weights(s, how);
  const double lambda = how.weighted ? std::pow(how.amount / (2 * std::numbers::pi), 4) : how.amount;
  const std::vector<std::size_t> ends = ends_of_curves(points, how);
  for (std::size_t k = 1; k + 1 < ends.size(); ++k) weight[ends[k]] *= kAtKinks;
  std::vector<Vec2> out = points;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const std::size_t from = ends[k], to = ends[k + 1] + 1;
    if (to - from < 3) continue;
    const auto part = [&](const Values& all) { return Values(all.begin() + from, all.begin() + to); };
    const Values new_y = smooth_values(part(s), part(y), part(weight), lambda);
    const Values new_z = smooth_values(part(s), part(z), part(weight), lambda);
    for (std::size_t i = from; i < to; ++i) out[i] = {new_y[i - from], new_z[i - from]};
  }
  return out;
}

}  // namespace railstrata::cntc
