#include "geometry/smoothing_spline.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "geometry/point_scatter.hpp"

namespace railstrata {
namespace {

constexpr double kClosestKnots = 0.5e-3, kWidestKnots = 4e-3;  // m
constexpr double kCurvatureNoise = 0.05;                       // 1/m
constexpr double kSmallestTolerance = 1e-9;                    // m
constexpr double kScatteredNoise = 0.08e-6;                    // m: from here on the knots above are too close
constexpr double kLeftCurvature = 0.3;                         // 1/m, of knots that scatter widens further
constexpr double kWidestOfAll = 10e-3;                         // m
constexpr double kEndWeight = 1e-3;

std::vector<double> chord_lengths(const std::vector<Vec2>& points) {
  std::vector<double> t = {0.0};
  for (std::size_t i = 1; i < points.size(); ++i) t.push_back(t.back() + norm(points[i] - points[i - 1]));
  return t;
}

/// Cubic B-splines on a knot vector whose end knots are repeated.
class Basis {
 public:
  explicit Basis(const std::vector<double>& knots) : knots_(knots.size() + 6) {
    std::fill_n(knots_.begin(), 3, knots.front());
    std::copy(knots.begin(), knots.end(), knots_.begin() + 3);
    std::fill_n(knots_.end() - 3, 3, knots.back());
  }
  int size() const { return static_cast<int>(knots_.size()) - 4; }
  int intervals() const { return size() - 3; }
  /// Interval [knot_i, knot_{i+1}] of t; basis functions i … i+3 live on it.
  int interval(double t) const {
    const auto after = std::upper_bound(knots_.begin() + 4, knots_.end() - 4, t);
    return static_cast<int>(after - knots_.begin()) - 4;
  }
  /// Values of the four basis functions on the interval, or their `derivative`-th derivatives [deBoor1978].
  std::array<double, 4> values(int interval, double t, int derivative = 0) const {
    const double* k = knots_.data() + interval + 3;  // k[0] <= t <= k[1]
    std::array<double, 4> b = {0, 0, 0, 1};
    for (int degree = 1; degree <= 3; ++degree) {
      const bool differentiate = degree > 3 - derivative;
      for (int j = 3 - degree; j <= 3; ++j) {
        const int i = j - 3;  // B_i starts at k[i]
        const double width0 = k[i + degree] - k[i], width1 = k[i + degree + 1] - k[i + 1];
        const double left = width0 > 0 && j > 3 - degree ? b[j] / width0 : 0.0,
                     right = width1 > 0 && j < 3 ? b[j + 1] / width1 : 0.0;
        b[j] = differentiate ? degree * (left - right) : (t - k[i]) * left + (k[i + degree + 1] - t) * right;
      }
    }
    return b;
  }
  double knot(int i) const { return knots_[static_cast<std::size_t>(i) + 3]; }

 private:
  std::vector<double> knots_;
};

using Coefficients = Eigen::Matrix<double, Eigen::Dynamic, 2>;
using Rows = std::vector<Eigen::Triplet<double>>;

void add_row(Rows& rows, int row, int first, const std::array<double, 4>& values, double scale) {
  for (int j = 0; j < 4; ++j) rows.emplace_back(row, first + j, scale * values[j]);
}

/// A weak preference for one cubic over the first two and the last two intervals; it decides only what the points leave
/// open.
void add_end_rows(Rows& rows, const Basis& basis, int row) {
  for (const int knot : {1, basis.intervals() - 1}) {
    const double h = basis.knot(knot + 1) - basis.knot(knot - 1), scale = kEndWeight * h * h * h / 48;
    const double before = 0.5 * (basis.knot(knot - 1) + basis.knot(knot)),
                 after = 0.5 * (basis.knot(knot) + basis.knot(knot + 1));
    add_row(rows, row, knot, basis.values(knot, after, 3), scale);
    add_row(rows, row, knot - 1, basis.values(knot - 1, before, 3), -scale);
    ++row;
  }
}

Coefficients least_squares(const Basis& basis, const std::vector<double>& t, const std::vector<Vec2>& points) {
  assert(t.size() == points.size());
  const int n = static_cast<int>(t.size());
  Rows rows;
  Coefficients wanted = Coefficients::Zero(n + 2, 2);
  for (int i = 0; i < n; ++i) {
    const int k = basis.interval(t[i]);
    add_row(rows, i, k, basis.values(k, t[i]), 1.0);
    wanted(i, 0) = points[i].y;
    wanted(i, 1) = points[i].z;
  }
  add_end_rows(rows, basis, n);
  Eigen::SparseMatrix<double> a(n + 2, basis.size());
  a.setFromTriplets(rows.begin(), rows.end());
  const Eigen::SparseMatrix<double> normal = a.transpose() * a;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(normal);
  Coefficients c = solver.solve(a.transpose() * wanted);
  c += solver.solve(a.transpose() * (wanted - a * c));  // one refinement: normal equations square the condition number
  return c;
}

Vec2 combine(const Coefficients& c, int first, const std::array<double, 4>& values) {
  Vec2 sum;
  for (int j = 0; j < 4; ++j) sum = sum + values[j] * Vec2{c(first + j, 0), c(first + j, 1)};
  return sum;
}

std::vector<double> knots_of(const std::vector<double>& t, const std::vector<char>& chosen) {
  assert(t.size() == chosen.size());
  std::vector<double> knots;
  for (std::size_t i = 0; i < t.size(); ++i)
    if (chosen[i]) knots.push_back(t[i]);
  return knots;
}

std::vector<char> spaced_knots(const std::vector<double>& t, double spacing, double moved) {
  std::vector<char> chosen(t.size(), 0);
  chosen.front() = chosen.back() = 1;
  double last = t.front() - moved * spacing;
  for (std::size_t i = 1; i + 1 < t.size(); ++i)
    if (t[i] - last >= spacing * (1 - 1e-3) && t.back() - t[i] >= 0.5 * spacing) {
      chosen[i] = 1;
      last = t[i];
    }
  return chosen;
}

/// Whether an interval misses a point by more than the tolerance. Of scattered points whether neighbours lie on one
/// side of the curve by more than chance does it: products of neighbouring distances, none counted as more than three
/// scatters, with a sum above four of its deviations.
bool misses_points(const double* off, std::size_t count, double tolerance, double noise) {
  if (noise < kScatteredNoise)
    return std::any_of(off, off + count, [&](double miss) { return std::abs(miss) > tolerance; });
  const auto in_scatters = [&](std::size_t i) { return std::clamp(off[i] / noise, -3.0, 3.0); };
  double products = 0;
  for (std::size_t i = 1; i < count; ++i) products += in_scatters(i - 1) * in_scatters(i);
  return products > 4 * std::sqrt(static_cast<double>(count));
}

/// Makes knots of the middle points of intervals that miss points. Returns whether it found any.
bool refine(std::vector<char>& chosen, const std::vector<double>& off, double tolerance, double noise) {
  assert(chosen.size() == off.size());
  bool changed = false;
  std::size_t begin = 0;
  for (std::size_t end = 1; end < chosen.size(); ++end) {
    if (!chosen[end]) continue;
    if (end - begin > 1 && misses_points(&off[begin], end - begin + 1, tolerance, noise)) {
      chosen[(begin + end) / 2] = 1;
      changed = true;
    }
    begin = end;
  }
  return changed;
}

/// Parameters moved to the arc length of the fitted curve (Simpson's rule between neighbouring points).
std::vector<double> arc_lengths(const Basis& basis, const Coefficients& c, const std::vector<double>& t) {
  const auto speed = [&](double at) {
    const int k = basis.interval(at);
    return norm(combine(c, k, basis.values(k, at, 1)));
  };
  std::vector<double> s = {0.0};
  for (std::size_t i = 1; i < t.size(); ++i) {
    const double h = t[i] - t[i - 1];
    s.push_back(s.back() + h / 6 * (speed(t[i - 1]) + 4 * speed(t[i - 1] + 0.5 * h) + speed(t[i])));
  }
  return s;
}

SmoothingSpline at_knots(const Basis& basis, const Coefficients& c) {
  SmoothingSpline out;
  for (int i = 0; i <= basis.intervals(); ++i) {
    const int k = std::min(i, basis.intervals() - 1);
    out.s.push_back(basis.knot(i));
    out.p.push_back(combine(c, k, basis.values(k, basis.knot(i))));
    out.d2.push_back(combine(c, k, basis.values(k, basis.knot(i), 2)));
  }
  return out;
}

/// Second derivatives of a least-squares spline scatter by noise sqrt(500 spacing / knots^5).
double widest_knots(const PointScatter& s) {
  return std::clamp(std::pow(s.noise * std::sqrt(500 * s.spacing) / kLeftCurvature, 0.4), kWidestKnots, kWidestOfAll);
}

}  // namespace

SmoothingSpline fit_smoothing_spline(const std::vector<Vec2>& points, double rounding, double knots_moved) {
  std::vector<double> t = chord_lengths(points);
  const PointScatter scatter = scatter_of(points, rounding);
  const double tolerance = std::max(4 * scatter.noise, kSmallestTolerance),
               wanted = std::sqrt(10 * scatter.noise / kCurvatureNoise);
  const bool interpolate = !scatter.dense && wanted <= scatter.spacing;
  const double spacing =
      interpolate ? 0.0 : std::min(std::clamp(wanted, kClosestKnots, widest_knots(scatter)), t.back() / 5);
  std::vector<char> chosen = spaced_knots(t, spacing, knots_moved);
  for (int round = 0;; ++round) {
    const Basis basis(knots_of(t, chosen));
    const Coefficients c = least_squares(basis, t, points);
    std::vector<double> error, off;  // the latter with the sign of the side
    for (std::size_t i = 0; i < t.size(); ++i) {
      const int k = basis.interval(t[i]);
      const Vec2 miss = combine(c, k, basis.values(k, t[i])) - points[i];
      error.push_back(norm(miss));
      off.push_back(std::copysign(error.back(), cross(combine(c, k, basis.values(k, t[i], 1)), miss)));
    }
    const bool refined = refine(chosen, off, tolerance, scatter.noise);
    if (!refined && round >= 2) {
      SmoothingSpline out = at_knots(basis, c);
      out.miss = std::move(error);
      out.tolerance = tolerance;
      return out;
    }
    t = arc_lengths(basis, c, t);
  }
}

}  // namespace railstrata
