#include "geometry/point_scatter.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace railstrata {
namespace {

constexpr double kDense = 0.5e-3;           // m
constexpr double kSmallestRounding = 1e-6;  // m: a finer digit is below what profiles are measured to
constexpr double kStraySigmas = 7, kNeighbourSigmas = 2, kNearSigmas = 5;
constexpr double kSmallestStray = 2e-6;  // m
constexpr std::size_t kLongestRun = 3, kBeside = 4, kNear = 2;

std::vector<double> chords(const std::vector<Vec2>& points) {
  std::vector<double> t = {0.0};
  for (std::size_t i = 1; i < points.size(); ++i) t.push_back(t.back() + norm(points[i] - points[i - 1]));
  return t;
}

/// Distances of every point from the polynomial through `reach` neighbours on either side, over what independent errors
/// of unit deviation give.
std::vector<double> distances_from_neighbours(const std::vector<Vec2>& points, std::size_t reach) {
  const std::vector<double> t = chords(points);
  std::vector<double> distance;
  for (std::size_t i = reach; i + reach < t.size(); ++i) {
    Vec2 guess;
    double variance = 1;
    for (std::size_t j = i - reach; j <= i + reach; ++j) {
      if (j == i) continue;
      double weight = 1;
      for (std::size_t k = i - reach; k <= i + reach; ++k)
        if (k != j && k != i) weight *= (t[i] - t[k]) / (t[j] - t[k]);
      guess = guess + weight * points[j];
      variance += weight * weight;
    }
    const Vec2 along = points[i + 1] - points[i - 1];
    distance.push_back(std::abs(cross(along, points[i] - guess)) / (norm(along) * std::sqrt(variance)));
  }
  return distance;
}

double quantile(std::vector<double> values, std::size_t place) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(place), values.end());
  return values[place];
}

double noise_of(const std::vector<Vec2>& points, bool dense, double spacing) {
  const std::vector<double> five = distances_from_neighbours(points, 2);
  if (dense) return quantile(five, five.size() / 2) / 0.6745;  // median of |N(0,1)|
  constexpr double kLowerQuartile = 0.3186;                    // of |N(0,1)|
  const double of_five = quantile(five, five.size() / 4) / kLowerQuartile;
  if (points.size() < 9 || spacing > kFarApart) return 0;  // shape and scatter cannot be told apart
  const std::vector<double> seven = distances_from_neighbours(points, 3);
  return std::min(of_five, quantile(seven, seven.size() / 4) / kLowerQuartile);
}

/// Distances of points [begin, end) from the cubic that fits `beside` of them at either end, along the normal of the
/// chord.
std::vector<double> off_cubic(const std::vector<Vec2>& points, std::size_t begin, std::size_t end, std::size_t beside) {
  const Vec2 along = points[end - 1] - points[begin];
  const double length = norm(along);
  const auto rows = static_cast<Eigen::Index>(2 * beside);
  Eigen::MatrixX4d a(rows, 4);
  Eigen::VectorXd height(rows);
  const auto place = [&](std::size_t i) {
    const Vec2 p = points[i] - points[begin];
    return Vec2{2 * dot(along, p) / (length * length) - 1, cross(along, p) / length};
  };
  for (std::size_t k = 0; k < 2 * beside; ++k) {
    const Vec2 p = place(k < beside ? begin + k : end - 2 * beside + k);
    a.row(static_cast<Eigen::Index>(k)) << 1, p.y, p.y * p.y, p.y * p.y * p.y;
    height(static_cast<Eigen::Index>(k)) = p.z;
  }
  const Eigen::Vector4d c = a.colPivHouseholderQr().solve(height);
  std::vector<double> out;
  for (std::size_t i = begin; i < end; ++i) {
    const Vec2 p = place(i);
    out.push_back(std::abs(p.z - (c[0] + p.y * (c[1] + p.y * (c[2] + p.y * c[3])))));
  }
  return out;
}

/// Whether the run of points from `first` lies off the curve of its neighbours, and at once; their distances.
std::vector<double> stray_run(const std::vector<Vec2>& points, std::size_t first, std::size_t count, double noise) {
  const auto of_run = [&](const std::vector<double>& off, std::size_t beside) {
    const auto begin = off.begin() + static_cast<std::ptrdiff_t>(beside);
    return std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(count));
  };
  std::vector<double> off = off_cubic(points, first - kBeside, first + count + kBeside, kBeside);
  const std::vector<double> run = of_run(off, kBeside);
  if (*std::min_element(run.begin(), run.end()) < std::max(kStraySigmas * noise, kSmallestStray)) return {};
  for (std::size_t k = 0; k < count; ++k) off[kBeside + k] = 0;
  const double squares = std::inner_product(off.begin(), off.end(), off.begin(), 0.0);
  if (squares > 2 * kBeside * std::pow(kNeighbourSigmas * noise, 2)) return {};
  const std::vector<double> near = of_run(off_cubic(points, first - kNear, first + count + kNear, kNear), kNear);
  return *std::min_element(near.begin(), near.end()) < kNearSigmas * noise ? std::vector<double>{} : run;
}

}  // namespace

double last_digit(const std::vector<double>& numbers) {
  constexpr int kMostDecimals = 9;
  constexpr std::size_t kUsed = 6;
  double scale = 1;
  for (int decimals = 0; decimals <= kMostDecimals; ++decimals, scale *= 10) {
    std::vector<int> digits;
    const bool whole = std::all_of(numbers.begin(), numbers.end(), [&](double v) {
      const double at = std::round(std::abs(v) * scale);
      digits.push_back(static_cast<int>(std::fmod(at, 10)));
      return std::abs(std::abs(v) * scale - at) < 1e-6 * std::max(1.0, 1e-6 * at);
    });
    if (!whole) continue;
    std::sort(digits.begin(), digits.end());
    const auto used = static_cast<std::size_t>(std::unique(digits.begin(), digits.end()) - digits.begin());
    return used >= kUsed ? 1 / scale : 0;
  }
  return 0;
}

PointScatter scatter_of(const std::vector<Vec2>& points, double rounding) {
  PointScatter out;
  std::vector<double> apart = chords(points);
  const double mean = apart.back() / static_cast<double>(points.size() - 1);
  for (std::size_t i = apart.size(); i-- > 1;) apart[i] -= apart[i - 1];
  apart.erase(apart.begin());
  out.spacing = quantile(apart, apart.size() / 2);
  out.rounding = rounding < kSmallestRounding * (1 - 1e-6) ? 0 : rounding;
  out.dense = mean < kDense;
  out.noise = std::max(noise_of(points, out.dense, out.spacing), out.rounding / std::sqrt(12.0));
  return out;
}

std::vector<StrayPoint> stray_points(const std::vector<Vec2>& points, const PointScatter& scatter) {
  std::vector<StrayPoint> out;
  for (std::size_t i = kBeside; i + kBeside < points.size(); ++i)
    for (std::size_t count = 1; count <= kLongestRun && i + count + kBeside <= points.size(); ++count) {
      const std::vector<double> run = stray_run(points, i, count, scatter.noise);
      if (run.empty()) continue;
      for (std::size_t k = 0; k < count; ++k) out.push_back({i + k, run[k]});
      i += count;
      break;
    }
  return out;
}

}  // namespace railstrata
