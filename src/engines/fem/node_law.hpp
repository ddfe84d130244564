#pragma once
// The central-difference update of one node, pointwise: compiled for the loops over lines (fem/node_update.hpp) and for
// the threads of a device. fem/stepper.hpp has the scheme.
#include "core/simd.hpp"
#include "core/sweep_kind.hpp"
#include "fem/reference_frame.hpp"

namespace railstrata {

/// Sums over an update.
struct UpdateSums {
  double kinetic = 0, damping = 0;                     ///< J, W
  double momentum_x = 0, momentum_z = 0, angular = 0;  ///< of the velocities in the frame; revolved bodies only
  RAILSTRATA_POINTWISE UpdateSums& operator+=(const UpdateSums& o) {
    kinetic += o.kinetic;
    damping += o.damping;
    momentum_x += o.momentum_x;
    momentum_z += o.momentum_z;
    angular += o.angular;
    return *this;
  }
};

/// Mean motion of a revolved body's free nodes relative to its frame, in its components; the run-up damping spares it.
struct MeanMotion {
  double x = 0, z = 0, spin = 0;
};

/// Values that all nodes of a body share in a step.
struct NodeStep {
  ReferenceFrame frame;
  MeanMotion mean;
  double dt = 0, rate = 0;  ///< s; 1/s, run-up damping
  double gx = 0, gz = 0;    ///< m/s², gravity in the frame
};

/// Kinematics of a body in its frame.
RAILSTRATA_POINTWISE NodeStep node_step(const ReferenceFrame& frame, const MeanMotion& mean, double dt, double rate,
                                        double gravity) {
  return {frame, mean, dt, rate, frame.turn.s * gravity, -frame.turn.c * gravity};
}

namespace node_law {

// Rigid travel and turn of the frame at a node, as velocities in the components of this step's frame.
struct RigidVelocity {
  double before_x = 0, before_z = 0, after_x = 0, after_z = 0, y = 0;
};
RAILSTRATA_POINTWISE RigidVelocity rigid_velocity(const ReferenceFrame& frame, double radius, double cosine,
                                                  double sine) {
  const double cd = frame.step.c, sd = frame.step.s;
  const double armx = -radius * sine, armz = radius * cosine;
  const double slope_x = frame.slope_cos * armx + frame.slope_sin * armz;
  const double slope_z = frame.slope_cos * armz - frame.slope_sin * armx;
  const Vec3 own = frame.own_velocity();
  const double travel_x = frame.turn.c * own.x, travel_z = frame.turn.s * own.x;
  return {cd * slope_x - sd * slope_z + travel_x, sd * slope_x + cd * slope_z + travel_z, slope_x + travel_x,
          slope_z + travel_z, own.y};
}

// Deceleration of a node by the run-up damping, components of this step's frame.
template <bool turning>
RAILSTRATA_POINTWISE Vec3 run_up_damping(double rate, const MeanMotion& mean, Rotation<double> step, double radius,
                                         double cosine, double sine, double wx, double wy, double wz) {
  double rx = rate * wx, ry = rate * wy, rz = rate * wz;
  if constexpr (turning) {
    rx -= rate * (mean.x + mean.spin * radius * cosine);
    rz -= rate * (mean.z + mean.spin * radius * sine);
    const double r = rx;
    rx = step.c * r - step.s * rz;
    rz = step.s * r + step.c * rz;
  }
  return {rx, ry, rz};
}

}  // namespace node_law

/// One step of one node: displacement u and velocity v move on, f holds what opposes the motion (internal forces).
/// m: inverse mass; cosine, sine: of the station's angle, and the node's radius, of a body that turns; measured: with
/// run-up damping and sums.
template <SweepKind kind, bool measured>
RAILSTRATA_POINTWISE void advance_node(const NodeStep& s, double m, double radius, double cosine, double sine,
                                       double fx, double fy, double fz, double& ux, double& uy, double& uz, double& vx,
                                       double& vy, double& vz, UpdateSums& sums) {
  constexpr bool turning = kind == SweepKind::revolve;
  const double dt = s.dt, cd = s.frame.step.c, sd = s.frame.step.s;
  const double wx = vx, wy = vy, wz = vz;
  double ax = s.gx - m * fx, ay = -m * fy, az = s.gz - m * fz;
  double bx = wx, bz = wz;    // before, in the frame of this step
  [[maybe_unused]] Vec3 d{};  // run-up damping
  if constexpr (turning) {
    const double push = s.frame.centrifugal * radius;
    ax -= push * sine;
    az += push * cosine;
    bx = cd * wx - sd * wz;
    bz = sd * wx + cd * wz;
  }
  if constexpr (measured) {
    d = node_law::run_up_damping<turning>(s.rate, s.mean, s.frame.step, radius, cosine, sine, wx, wy, wz);
    ax -= d.x;
    ay -= d.y;
    az -= d.z;
  }
  const double qx = bx + dt * ax, qy = wy + dt * ay, qz = bz + dt * az;
  vx = qx;
  vy = qy;
  vz = qz;
  const double dx = ux + dt * qx, dz = uz + dt * qz;
  uy += dt * qy;
  ux = turning ? cd * dx - sd * dz : dx;
  uz = turning ? sd * dx + cd * dz : dz;
  if constexpr (measured) {
    const double mass = 1 / m;
    double before_x = bx, before_y = wy, before_z = bz, after_x = qx, after_y = qy, after_z = qz;
    if constexpr (turning) {
      const node_law::RigidVelocity rigid = node_law::rigid_velocity(s.frame, radius, cosine, sine);
      before_x += rigid.before_x;
      before_y += rigid.y;
      before_z += rigid.before_z;
      after_x += rigid.after_x;
      after_y += rigid.y;
      after_z += rigid.after_z;
      sums.momentum_x += mass * qx;
      sums.momentum_z += mass * qz;
      sums.angular += mass * radius * (cosine * qx + sine * qz);
    }
    sums.kinetic += 0.5 * mass * (before_x * after_x + before_y * after_y + before_z * after_z);
    sums.damping += 0.5 * mass * (d.x * (before_x + after_x) + d.y * (before_y + after_y) + d.z * (before_z + after_z));
  }
}

}  // namespace railstrata
