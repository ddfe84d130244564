#include "cntc/within_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cntc/codes.hpp"
#include "record/unit.hpp"

namespace railstrata::cntc {
namespace {

constexpr double kApart = 0.25e-3;  // m, between the points of a profile

/// Points of a whole profile, also of what turns over, in its own system.
std::vector<Vec2> whole(const Outline& profile) {
  const double begin = profile.profile().s_min(), end = profile.profile().s_max();
  const int count = std::max(2, static_cast<int>(std::ceil((end - begin) / kApart)) + 1);
  std::vector<Vec2> out;
  for (int k = 0; k < count; ++k) {
    const Outline::Point p = profile.along(std::clamp(begin + (end - begin) * k / (count - 1), begin, end));
    out.push_back({p.y, p.z});
  }
  return out;
}

double distance_to(const std::vector<Vec2>& line, Vec2 p) {
  double least = 1;
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    const Vec2 side = line[k + 1] - line[k], from = p - line[k];
    const double share = std::clamp(dot(from, side) / std::max(dot(side, side), 1e-24), 0.0, 1.0);
    least = std::min(least, norm(from - share * side));
  }
  return least;
}

/// Under the rail's surface, whose ends go straight down.
bool is_inside(const std::vector<Vec2>& rail, Vec2 p) {
  bool out = false;
  for (std::size_t k = 0; k + 1 < rail.size(); ++k) {
    const Vec2 a = rail[k], b = rail[k + 1];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    if (a.z + (p.y - a.y) / (b.y - a.y) * (b.z - a.z) < p.z) out = !out;
  }
  return out;
}

}  // namespace

void require_found(const RigidPair& pair, const std::vector<Overlap>& found) {
  constexpr double kDeep = 5e-6, kBeside = 1e-3;  // m
  constexpr int kAlong = 8;                       // places before and behind the axle
  constexpr double kFarthest = 0.2;               // of the wheel's radius
  for (const Overlap& o : found)
    if (o.at_end)
      throw Refused(kSearch, fmt::format("the contact at y = {:.1f} mm reaches the end of a profile", kToMilli * o.y));
  std::vector<Vec2> rail = whole(*pair.rail);
  for (Vec2& p : rail) {
    const Vec3 q = pair.rail_at.to_outer({0, p.y, p.z});
    p = {q.y, q.z};
  }
  const double top = std::min_element(rail.begin(), rail.end(), [](Vec2 a, Vec2 b) { return a.z < b.z; })->z;
  const auto is_found = [&](double y) {
    return std::any_of(found.begin(), found.end(),
                       [&](const Overlap& o) { return y > o.extent.y[0] - kBeside && y < o.extent.y[1] + kBeside; });
  };
  for (const Vec2& p : whole(*pair.wheel))
    for (int k = -kAlong; k <= kAlong; ++k) {
      const double radius = pair.wheel_radius + p.z, x = kFarthest * radius * k / kAlong;
      const Vec3 q = pair.wheel_at.to_outer({x, p.y, std::sqrt(radius * radius - x * x) - pair.wheel_radius});
      const Vec2 at{q.y, q.z};
      if (at.z < top + kDeep || is_found(at.y) || !is_inside(rail, at) || distance_to(rail, at) < kDeep) continue;
      throw Refused(kSearch, fmt::format("the wheel is also inside the rail at y = {:.1f} mm, where a profile is too "
                                         "steep for the search: contacts on the side of a rail are not offered",
                                         kToMilli * at.y));
    }
}

}  // namespace railstrata::cntc
