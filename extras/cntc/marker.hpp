#pragma once
// A reference system in another one: its origin and its axes. Those of wheel-rail contact have x along the track, y to
// the field side and z down; a left wheel and rail are seen in a mirror (y turned), so that they are a right pair.
#include <array>
#include <cmath>

#include "core/vec.hpp"

namespace railstrata::cntc {

struct Marker {
  Vec3 at;  ///< m
  std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

  Vec3 turned(Vec3 v) const { return v.x * axes[0] + v.y * axes[1] + v.z * axes[2]; }
  Vec3 turned_back(Vec3 v) const { return {dot(axes[0], v), dot(axes[1], v), dot(axes[2], v)}; }
  Vec3 to_outer(Vec3 p) const { return at + turned(p); }
  Vec3 to_inner(Vec3 p) const { return turned_back(p - at); }
  /// From y to z, about x; of a system that is rolled, then yawed.
  double roll() const { return std::atan2(axes[1].z, axes[1].y); }
  double yaw() const { return std::atan2(-axes[1].x, axes[0].x); }
};

/// Rolled about x, then yawed about its own z [rad]: R = R_x(roll) R_z(yaw).
inline Marker marker(Vec3 at, double roll, double yaw = 0) {
  const double c = std::cos(roll), s = std::sin(roll), cy = std::cos(yaw), sy = std::sin(yaw);
  return {at, {Vec3{cy, c * sy, s * sy}, Vec3{-sy, c * cy, s * cy}, Vec3{0, -s, c}}};
}

/// A system `inner` of `outer` in the system that `outer` stands in.
inline Marker placed(const Marker& outer, const Marker& inner) {
  return {outer.to_outer(inner.at),
          {outer.turned(inner.axes[0]), outer.turned(inner.axes[1]), outer.turned(inner.axes[2])}};
}

/// `one` as seen from `from`, both in the same system.
inline Marker seen_from(const Marker& from, const Marker& one) {
  return {from.to_inner(one.at),
          {from.turned_back(one.axes[0]), from.turned_back(one.axes[1]), from.turned_back(one.axes[2])}};
}

}  // namespace railstrata::cntc
