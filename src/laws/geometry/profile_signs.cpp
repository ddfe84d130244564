#include "geometry/profile_signs.hpp"

#include <algorithm>
#include <cmath>

namespace railstrata {
namespace {

constexpr double kMiddle = 5e-3;  // m, to either side of the axis
constexpr double kFlattest = 0.02, kSteepest = 1 / 15.0;
constexpr double kFaceDepth = 14e-3;  // m, where a gauge is measured [EN13848]
constexpr double kSteepBack = 5;      // |dz/dy|
constexpr double kStep = 0.1e-3;      // m

/// y where the curve, walked from the axis, falls to a height; none if it does not.
std::optional<double> face_at(const Profile& rail, double height, double step) {
  for (double s = step; s > rail.s_min() && s < rail.s_max(); s += step)
    if (const Vec2 p = rail.at(s).position; p.z <= height) return p.y;
  return std::nullopt;
}

}  // namespace

std::optional<double> head_inclination(const Profile& rail) {
  if (rail.y_min() > -kMiddle || rail.y_max() < kMiddle) return std::nullopt;
  return (rail.height(kMiddle) - rail.height(-kMiddle)) / (2 * kMiddle);
}

bool looks_laid(double slope) { return std::abs(slope) >= kFlattest && std::abs(slope) <= kSteepest; }

std::optional<double> head_middle(const Profile& rail) {
  double top = rail.height(0);
  for (double y = rail.y_min(); y < rail.y_max(); y += kStep) top = std::max(top, rail.height(y));
  const std::optional<double> gauge = face_at(rail, top - kFaceDepth, -kStep),
                              field = face_at(rail, top - kFaceDepth, kStep);
  if (!gauge || !field) return std::nullopt;
  return 0.5 * (*gauge + *field);
}

std::optional<double> flange_back(const Profile& wheel) {
  const ProfilePoint first = wheel.at(wheel.s_min());
  if (std::abs(first.tangent.z) < kSteepBack * std::abs(first.tangent.y)) return std::nullopt;
  return -first.position.y;
}

std::vector<ProfileEdge> edges_of(const Profile& p) {
  constexpr double kWithin = 0.3e-3, kBeside = 2e-3, kLeastTurn = 5e-3, kTimes = 4;  // m, m, rad
  std::vector<ProfileEdge> out;
  if (!p.listed()) return out;
  const double least = std::max(kLeastTurn, 6 * p.listed()->scatter.noise / (2 * kWithin));
  const auto turn = [&](double from, double to) {
    const Vec2 a = p.at(from).tangent, b = p.at(to).tangent;
    return std::abs(std::atan2(cross(a, b), dot(a, b)));
  };
  const double reach = kWithin + kBeside;
  for (double s = p.s_min() + reach; s <= p.s_max() - reach; s += kStep) {
    const double here = turn(s - kWithin, s + kWithin),
                 beside = std::max(turn(s - reach, s - kWithin), turn(s + kWithin, s + reach)) * 2 * kWithin / kBeside;
    if (here < least || here < kTimes * beside) continue;
    if (out.empty() || s - out.back().s > reach)
      out.push_back({s, here});
    else if (here > out.back().turn)
      out.back() = {s, here};
  }
  return out;
}

}  // namespace railstrata
