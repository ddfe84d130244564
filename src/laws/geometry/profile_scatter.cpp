#include "geometry/profile_scatter.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/counted_random.hpp"

namespace railstrata {
namespace {

constexpr double kSmoothedAway = 0.08e-6;  // m: knots 4 mm apart leave 0.05 1/m of it in the curvature

/// Numbers between 0 and 1 (splitmix64), the same on every machine.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : state_(seed) {}
  double even() {
    const std::uint64_t bits = mixed(state_);
    state_ += 0x9e3779b97f4a7c15u;
    return static_cast<double>(bits >> 11) * 0x1p-53;
  }
  double normal() { return std::sqrt(-2 * std::log(1 - even())) * std::cos(2 * std::numbers::pi * even()); }

 private:
  std::uint64_t state_;
};

/// The place of the curve nearest to a point, near the arc length s.
double nearest_on(const Profile& p, Vec2 point, double s) {
  for (int i = 0; i < 3; ++i) {
    const ProfilePoint at = p.at(std::clamp(s, p.s_min(), p.s_max()));
    s += dot(point - at.position, at.tangent);
  }
  return std::clamp(s, p.s_min(), p.s_max());
}

std::vector<Vec2> moved_points(const Profile& p, int k) {
  const PointScatter& scatter = p.listed()->scatter;
  const double rounding = scatter.rounding,
               deviation = std::sqrt(std::max(0.0, scatter.noise * scatter.noise - rounding * rounding / 12));
  Chance chance(static_cast<std::uint64_t>(2 * k + (p.kind() == ProfileKind::wheel ? 1 : 0)));
  const double origin = rounding * chance.even();
  std::vector<Vec2> out;
  double s = p.s_min();
  for (const Vec2& point : p.listed()->points) {
    if (!out.empty()) s += norm(point - p.listed()->points[out.size() - 1]);
    s = nearest_on(p, point, s);
    const ProfilePoint at = p.at(s);
    Vec2 moved = point + (dot(at.position - point, at.outward) + deviation * chance.normal()) * at.outward;
    if (rounding > 0) moved.z = rounding * std::round((moved.z + origin) / rounding) - origin;
    out.push_back(moved);
  }
  return out;
}

std::vector<Vec2> every_other(const std::vector<Vec2>& points, std::size_t first) {
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (i % 2 == first || i == 0 || i + 1 == points.size()) out.push_back(points[i]);
  return out;
}

}  // namespace

bool far_apart(const Profile& p) { return p.listed() && p.listed()->scatter.spacing > kFarApart; }

bool leaves_open(const Profile& p) { return p.listed() && (p.listed()->scatter.noise > kSmoothedAway || far_apart(p)); }

Profile other_fit(const Profile& p, int k) {
  if (!leaves_open(p)) return p;
  const auto& [points, scatter] = *p.listed();
  const auto fit = [&p](const std::vector<Vec2>& to, double rounding, double knots_moved = 0) {
    return Profile::from_points(p.kind(), p.name(), to, rounding, knots_moved);
  };
  if (far_apart(p)) return fit(every_other(points, static_cast<std::size_t>(k % 2)), scatter.rounding);
  // rounding of heights every so often is no chance: it moves whole stretches, and what it does depends on the knots
  if (k < kMovedFits) return fit(moved_points(p, k), scatter.rounding, (k + 0.5) / kMovedFits);
  if (k == kMovedFits) return fit(points, 2 * std::sqrt(12.0) * scatter.noise);
  return fit(every_other(points, 1), scatter.rounding);
}

}  // namespace railstrata
