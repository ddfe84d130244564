#pragma once
// A rigid wheelset on its track: where its wheels stand over their rails and how they slip there.
//
// Track axes: x along the track, y to the left, z up, from the middle of the track at the height of the rails' origins.
// All functions are for the left wheel, whose model frame (placement.hpp) has these axes. The right wheel is the left
// one of the motion seen in a mirror: `mirrored`.
//
// The centre C of the axle stands at (0, y, r0 + z). The wheelset is turned by the roll about x, then by the yaw about
// the vertical (turned_wheel.hpp), R; the left wheel's tread stands at C + R (0, e, -r0), e half the distance of the
// tape circles. Its material at the arm a from C moves over the rail with [Wickens2003; Kalker1990]
//   w = (V, y', z') - rail' + Omega x a,   Omega = psi' e_z + phi' R_psi e_x + (V/r0 + omega) R e_y
//   xi = w_x/V,   eta = (w_y cos(delta) + w_z sin(delta))/V,   spin = (Omega_z cos(delta) - Omega_y sin(delta))/V
// a ends at the contact of the wheel that just touches: rolling radii are those of undeformed wheels, as everywhere
// here. Of a wheelset that rolls along a straight track, without rates, eta and spin are yaw_creepage and wheel_spin.
#include "core/vec.hpp"
#include "geometry/placement.hpp"

namespace railstrata {

struct WheelsetMotion {
  double y = 0, z = 0;       ///< m, of the centre from the middle of the track and from r0 above the rails' origins
  double yaw = 0, roll = 0;  ///< rad, about z and x
  double speed = 0;          ///< V, m/s
  double y_rate = 0, z_rate = 0, yaw_rate = 0, roll_rate = 0;  ///< m/s, rad/s
  double pitch_rate = 0;                                       ///< omega, rad/s: of the axle beyond V/r0
};

/// Displacement of one rail from its place at rest.
struct RailMotion {
  double y = 0, z = 0, roll = 0;  ///< m, rad about x through the origin of its profile
  double y_rate = 0, z_rate = 0;  ///< m/s
};

WheelsetMotion mirrored(WheelsetMotion motion);
RailMotion mirrored(RailMotion rail);

/// e, m.
double tape_circle_distance(const TrackGeometry& track);

/// What place_wheel needs for the left wheel of the motion; `at_rest`: of the track, with lateral_shift 0.
TrackGeometry track_under(const Profile& wheel, const Profile& rail, const TrackGeometry& at_rest,
                          const WheelsetMotion& motion, const RailMotion& displaced);

/// By how much the wheel stands below the height at which it touches, m; < 0: it is lifted.
double descent(const TrackGeometry& track, const RigidContact& touching, const WheelsetMotion& motion,
               const RailMotion& displaced);
/// z of the motion that stands lower than its contact by `wanted`.
double height_of_descent(double wanted, const TrackGeometry& track, const RigidContact& touching,
                         const WheelsetMotion& motion, const RailMotion& displaced);

/// From the centre of the wheelset to a point of the touching wheel, m; along: x from the middle of the tape circle.
Vec3 arm_of(const TrackGeometry& track, const RigidContact& touching, const WheelsetMotion& motion, double along,
            Vec2 point);

struct WheelSlip {
  double creepage_x = 0, creepage_y = 0;  ///< xi, eta
  double spin = 0;                        ///< 1/m
};
WheelSlip slip_at(const TrackGeometry& track, const RigidContact& touching, const WheelsetMotion& motion,
                  const RailMotion& displaced);

}  // namespace railstrata
