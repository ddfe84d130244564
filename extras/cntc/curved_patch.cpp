#include "cntc/curved_patch.hpp"

#include <algorithm>
#include <cmath>

namespace railstrata::cntc {
namespace {

struct CurvePoint {
  double y = 0, z = 0;  ///< m, in the track
  Vec3 normal;          ///< up from the rail, half the sum of both surfaces': short where they turn away
};

/// The nearest point of a profile that ends before.
Outline::Point point_at(const Outline& profile, double arc) {
  return profile.along(std::clamp(arc, profile.profile().s_min(), profile.profile().s_max()));
}

CurvePoint rail_point(const RigidPair& pair, double arc) {
  const Outline::Point p = point_at(*pair.rail, arc);
  const Vec3 at = pair.rail_at.to_outer({0, p.y, p.z});
  const double size = std::hypot(1, p.slope);
  return {at.y, at.z, pair.rail_at.turned({0, p.slope / size, -1 / size})};
}

/// The wheel's profile at the reference's place along the track.
CurvePoint wheel_point(const RigidPair& pair, double arc, const Vec3& reference) {
  const Outline::Point p = point_at(*pair.wheel, arc);
  const double radius = pair.wheel_radius + p.z;
  double x = pair.wheel_at.to_inner(reference).x;
  Vec3 at;
  for (int k = 0; k < 3; ++k) {
    at = pair.wheel_at.to_outer({x, p.y, std::sqrt(radius * radius - x * x) - pair.wheel_radius});
    x += reference.x - at.x;
  }
  const double size = std::hypot(1, p.slope);
  return {at.y, at.z, pair.wheel_at.turned({0, -p.slope / size, 1 / size})};
}

CurvePoint middle(const CurvePoint& rail, const CurvePoint& wheel) {
  return {0.5 * (rail.y + wheel.y), 0.5 * (rail.z + wheel.z), 0.5 * (rail.normal - wheel.normal)};
}

}  // namespace

void bend(PatchPlane& plane, const Overlap& overlap, const RigidPair& pair) {
  constexpr double kMore = 0.2, kFacing = 0.9;
  constexpr int kBeside = 3, kAdded = 2;
  const double ds = plane.ds, origin = plane.origin_s;
  const double low = std::min(plane.reach[0], 0.0), high = std::max(plane.reach[1], 0.0);
  const long first = std::lround((origin + (1 + kMore) * low) / ds) - kBeside;
  const long last = std::lround((origin + (1 + kMore) * high) / ds) + kBeside;
  const double wheel_arc = pair.wheel->arc(pair.wheel_at.to_inner(plane.reference.at).y);
  const long reference = std::lround(origin / ds);
  long from = reference - 1, to = reference + 1;
  std::vector<CurvePoint> curve;
  for (long k = first; k <= last; ++k) {
    const double way = static_cast<double>(k) * ds - origin;
    curve.push_back(
        middle(rail_point(pair, plane.rail_arc + way), wheel_point(pair, wheel_arc + way, plane.reference.at)));
    const CurvePoint& c = curve.back();
    if (!(c.y >= overlap.extent.y[0] && c.y <= overlap.extent.y[1] && norm(c.normal) > kFacing)) continue;
    from = std::min(from, k);
    to = std::max(to, k);
  }
  from = std::max(first, from - kAdded);
  to = std::min(last, to + kAdded);
  plane.s = static_cast<double>(from) * ds - origin;
  plane.my = static_cast<int>(to - from + 1);
  for (long k = from; k <= to; ++k) {
    const CurvePoint& c = curve[static_cast<std::size_t>(k - first)];
    const Vec3 in_plane = plane.reference.to_inner({plane.reference.at.x, c.y, c.z});
    plane.rows.push_back({in_plane.y, in_plane.z, std::atan2(c.normal.y, -c.normal.z) - plane.angle});
  }
}

void widen(PatchPlane& plane, const More& by) {
  plane.x -= by.before * plane.dx;
  plane.s -= by.below * plane.ds;
  plane.mx += by.before + by.behind;
  plane.my += by.below + by.above;
  if (plane.rows.size() < 2) return;
  const auto beyond = [](const CurvedRow& last, const CurvedRow& inner, int steps) {
    return CurvedRow{last.s + steps * (last.s - inner.s), last.n + steps * (last.n - inner.n), last.turn};
  };
  const std::vector<CurvedRow> old = plane.rows;
  plane.rows.clear();
  for (int k = by.below; k > 0; --k) plane.rows.push_back(beyond(old[0], old[1], k));
  plane.rows.insert(plane.rows.end(), old.begin(), old.end());
  for (int k = 1; k <= by.above; ++k) plane.rows.push_back(beyond(old.back(), old[old.size() - 2], k));
}

}  // namespace railstrata::cntc
