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
//   xi = w_x/c,   eta = (w_y cos(delta) + w_z sin(delta))/c,   spin = (Omega_z cos(delta) - Omega_y sin(delta))/c
//   c = max(|V|, |w|, 0.01 m/s)
// in the axes of the rail, which may be yawed against the track. V >= 0: of one that rolls back, see `reversed`. a ends
// at the contact of the wheel that just touches: rolling radii are those of undeformed wheels, as everywhere here. Of a
// wheelset that rolls along a straight track, without rates, eta and spin are yaw_creepage and wheel_spin.
#include "core/vec.hpp"
#include "geometry/placement.hpp"

namespace railstrata {

struct WheelsetMotion {
  double y = 0, z = 0;       ///< m, of the centre from the middle of the track and from r0 above the rails' origins
  double yaw = 0, roll = 0;  ///< rad, about z and x
  double speed = 0;          ///< V >= 0, m/s
  double y_rate = 0, z_rate = 0, yaw_rate = 0, roll_rate = 0;  ///< m/s, rad/s
  double pitch_rate = 0;                                       ///< omega, rad/s: of the wheel beyond V/r0
};

/// Displacement of one rail from its place at rest.
struct RailMotion {
  double y = 0, z = 0, roll = 0;  ///< m, rad about x through the origin of its profile
  double y_rate = 0, z_rate = 0;  ///< m/s
  double yaw = 0;                 ///< rad about z through the place of its tape circle
};

WheelsetMotion mirrored(WheelsetMotion motion);
RailMotion mirrored(RailMotion rail);
/// The same seen in a mirror across the track, x -> -x: who rolls back rolls on there.
WheelsetMotion reversed(WheelsetMotion motion);
RailMotion reversed(RailMotion rail);

/// c of a speed without slip, max(|V|, 0.01) [m/s]: creepages are slips over it, and rigid slip at a standstill acts as
/// that of a wheel that rolls so slowly. NaN of NaN.
double reference_speed(double speed);

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

/// From the centre of the wheelset to a point of the touching wheel, m, in the rail's axes; along: x from the middle of
/// the tape circle.
Vec3 arm_of(const TrackGeometry& track, const RigidContact& touching, const WheelsetMotion& motion,
            const RailMotion& displaced, double along, Vec2 point);

struct WheelSlip {
  double creepage_x = 0, creepage_y = 0;  ///< xi, eta
  double spin = 0;                        ///< 1/m
  double speed = 0;                       ///< c, m/s
};
WheelSlip slip_at(const TrackGeometry& track, const RigidContact& touching, const WheelsetMotion& motion,
                  const RailMotion& displaced);

}  // namespace railstrata
