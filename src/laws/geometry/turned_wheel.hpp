#pragma once
// A wheel of revolution that is turned by roll and yaw, seen along the rail.
//
// The profile is turned by the roll phi about x through the middle of the tape circle's tread (its own origin), field
// side up, and with its axle by the yaw psi about the vertical through that point. Points are given from there, in the
// model's axes. A point of the circle through the profile's place s, at the angle theta from the lowest point, is
//   (r sin theta, y, R - r cos theta),   r = R - z(s)
// before it is turned.
#include <optional>

#include "core/vec.hpp"
#include "geometry/placement.hpp"
#include "geometry/profile.hpp"

namespace railstrata {

struct TurnedPoint {
  Vec3 position;
  Vec2 along;        ///< derivative of (y, z) by the profile's arc length, at the same x or on the same outline
  double depth = 0;  ///< r cos theta
};

class TurnedWheel {
 public:
  TurnedWheel(const Profile& wheel, const TrackGeometry& track);

  /// The place of the circle where the surface's normal has no part along the rail: of the lower outline, whose lowest
  /// places touch an extruded rail first.
  TurnedPoint outline(double s) const;
  bool has(double s) const { return s >= begin_ && s <= end_; }
  /// Its arc length at y. Clamped to the running surface.
  double s_at_y(double y) const;
  double y_begin() const { return outline(begin_).position.y; }
  double y_end() const { return outline(end_).position.y; }

  /// Where the circle crosses the plane x = const, below the axle.
  TurnedPoint cut(double s, double x) const;

  /// Distance from the axle of a point of the section plane y, z of the tape circle.
  double from_axle(Vec2 point) const { return radius_ - (roll_.c * point.z - roll_.s * point.y); }
  /// A place of the section curve at theta = 0.
  Vec2 section(Vec2 profile_point) const { return roll(roll_, profile_point); }

 private:
  Vec3 turned(Vec3 p) const;
  const Profile& wheel_;
  double radius_;
  Rotation<double> roll_, yaw_;
  double slope_;
  Rotation<double> lean_;  // by atan(tan(psi) sin(phi))
  double begin_, end_;     // arc lengths of the running surface
};

/// Heights of the outline at places that come one after the other.
class OutlineWalk {
 public:
  explicit OutlineWalk(const TurnedWheel& wheel) : wheel_(wheel) {}
  /// At y, to some 1e-13 m. Clamped as TurnedWheel::s_at_y.
  double height(double y);
  /// Of the place whose height was asked for last.
  double x() const { return last_.position.x; }

 private:
  const TurnedWheel& wheel_;
  std::optional<double> s_;  // of the last place
  TurnedPoint last_;
};

/// Direction in which the wheel's surface moves where it touches: lateral over longitudinal component in the plane of
/// the contact, that of a surface that cannot move into the rail. tan(psi)/cos(delta) without a roll.
double lateral_motion(const RigidContact& contact);

}  // namespace railstrata
