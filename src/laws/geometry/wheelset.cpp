#include "geometry/wheelset.hpp"

#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"

namespace railstrata {
namespace {

Vec3 turned(const WheelsetMotion& m, Vec3 p) {
  const Vec2 rolled = roll(rotation_by(m.roll), Vec2{p.y, p.z});
  return yaw(rotation_by(m.yaw), Vec3{p.x, rolled.y, rolled.z});
}

/// As the rail sees the wheelset's place.
WheelsetMotion along_rail(WheelsetMotion m, const RailMotion& rail) {
  m.yaw -= rail.yaw;
  return m;
}

/// From the centre of the wheelset to the tread of the left wheel, R (0, e, -r0), m.
Vec3 arm_of_tread(const TrackGeometry& track, const WheelsetMotion& motion) {
  return turned(motion, {0, tape_circle_distance(track), -track.wheel_radius});
}

/// By how much a rail that is canted further moves its gauge face: its origin has to stay.
double moved_gauge_face(const Profile& wheel, const Profile& rail, const TrackGeometry& before,
                        const TrackGeometry& after) {
  if (before.cant == after.cant || wheel.primitive() || rail.primitive()) return 0;
  return gauge_face_y(rail, after) - gauge_face_y(rail, before);
}

}  // namespace

double tape_circle_distance(const TrackGeometry& track) { return 0.5 * track.back_to_back + track.flange_back_to_tape; }

WheelsetMotion mirrored(WheelsetMotion m) {
  for (double WheelsetMotion::*odd : {&WheelsetMotion::y, &WheelsetMotion::yaw, &WheelsetMotion::roll,
                                      &WheelsetMotion::y_rate, &WheelsetMotion::yaw_rate, &WheelsetMotion::roll_rate})
    m.*odd = -(m.*odd);
  return m;
}

RailMotion mirrored(RailMotion rail) {
  for (double RailMotion::*odd : {&RailMotion::y, &RailMotion::roll, &RailMotion::y_rate, &RailMotion::yaw})
    rail.*odd = -(rail.*odd);
  return rail;
}

WheelsetMotion reversed(WheelsetMotion m) {
  for (double WheelsetMotion::*odd :
       {&WheelsetMotion::yaw, &WheelsetMotion::speed, &WheelsetMotion::yaw_rate, &WheelsetMotion::pitch_rate})
    m.*odd = -(m.*odd);
  return m;
}

RailMotion reversed(RailMotion rail) {
  rail.yaw = -rail.yaw;
  return rail;
}

double reference_speed(double speed) {
  constexpr double kSlowest = 0.01;  // m/s
  return std::max(std::abs(speed), kSlowest);
}

TrackGeometry track_under(const Profile& wheel, const Profile& rail, const TrackGeometry& at_rest,
                          const WheelsetMotion& motion, const RailMotion& displaced) {
  TrackGeometry out = at_rest;
  out.yaw = std::tan(along_rail(motion, displaced).yaw);
  out.roll = std::tan(motion.roll);
  if (displaced.roll != 0) out.cant = std::tan(std::atan(at_rest.cant) + displaced.roll);
  const Vec3 tread = arm_of_tread(at_rest, motion);
  const Vec3 aside{tread.x, motion.y + tread.y - tape_circle_distance(at_rest) - displaced.y, 0};
  out.lateral_shift = yaw_back(rotation_by(displaced.yaw), aside).y - moved_gauge_face(wheel, rail, at_rest, out);
  return out;
}

double descent(const TrackGeometry& track, const RigidContact& touching, const WheelsetMotion& motion,
               const RailMotion& displaced) {
  return touching.wheel_offset_z + displaced.z - (track.wheel_radius + motion.z + arm_of_tread(track, motion).z);
}

double height_of_descent(double wanted, const TrackGeometry& track, const RigidContact& touching,
                         const WheelsetMotion& motion, const RailMotion& displaced) {
  return motion.z + descent(track, touching, motion, displaced) - wanted;
}

Vec3 arm_of(const TrackGeometry& track, const RigidContact& touching, const WheelsetMotion& motion,
            const RailMotion& displaced, double along, Vec2 point) {
  const Vec3 from_tread{along, point.y - touching.wheel_offset_y, point.z - touching.wheel_offset_z};
  return arm_of_tread(track, along_rail(motion, displaced)) + from_tread;
}

WheelSlip slip_at(const TrackGeometry& track, const RigidContact& touching, const WheelsetMotion& motion,
                  const RailMotion& displaced) {
  const WheelsetMotion m = along_rail(motion, displaced);
  const Vec3 arm = arm_of(track, touching, motion, displaced, touching.x, touching.point);
  const Vec3 turning = Vec3{0, 0, m.yaw_rate} + m.roll_rate * yaw(rotation_by(m.yaw), Vec3{1, 0, 0}) +
                       (m.speed / track.wheel_radius + m.pitch_rate) * turned(m, {0, 1, 0});
  const Vec3 moving{m.speed, m.y_rate - displaced.y_rate, m.z_rate - displaced.z_rate};
  const Vec3 slip = yaw_back(rotation_by(displaced.yaw), moving) + cross(turning, arm);
  const Vec3 tangent{0, std::cos(touching.angle), std::sin(touching.angle)}, normal{0, -tangent.z, tangent.y};
  const double across = dot(slip, tangent), c = std::max(reference_speed(m.speed), std::hypot(slip.x, across));
  return {slip.x / c, across / c, dot(turning, normal) / c, c};
}

}  // namespace railstrata
