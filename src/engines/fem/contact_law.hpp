#pragma once
// The nodes of the contact in a step, pointwise: compiled for the stepper and for the threads of a device.
#include <cmath>

#include "core/simd.hpp"
#include "fem/node_law.hpp"

namespace railstrata {

/// Forces of the last step, on the wheel [N]; slip and penetration of its contact.
struct ContactForces {
  double x = 0, y = 0, z = 0;
  double penetration = 0;  ///< m, largest at the start of the step among nodes that carry pressure
  int nodes = 0, sweeps = 0;
};

/// W, lost in a step.
struct ContactLosses {
  double friction = 0, normal = 0;
};

/// Velocities of a node of the contact, model frame: of the half step before, and of the one that would follow without
/// the contact's forces.
struct FreeMotion {
  Vec3 before, after;
};

/// s a + b. Where fused products are written out, the compiler has no choice of which product to fuse, and results have
/// the same bits whatever stands around them.
RAILSTRATA_POINTWISE Vec3 fused(double s, Vec3 a, Vec3 b) {
  return {std::fma(s, a.x, b.x), std::fma(s, a.y, b.y), std::fma(s, a.z, b.z)};
}

/// m: inverse mass, 0 of a node that is not free; f: internal forces; v, w: velocities in the frame; rate: of the
/// run-up damping.
RAILSTRATA_POINTWISE FreeMotion free_rail_node(double m, Vec3 f, Vec3 v, double gravity, double dt, double rate) {
  const Vec3 weight{0, 0, gravity}, a = m == 0 ? Vec3{} : fused(-m, f, -weight);
  const double kept = std::fma(-rate, dt, 1.0);
  return {v, fused(dt, a, kept * v)};
}

/// arm: from the axle to the undeformed node, in the frame.
RAILSTRATA_POINTWISE FreeMotion free_wheel_node(const ReferenceFrame& frame, const MeanMotion& mean, Vec3 arm, double m,
                                                Vec3 f, Vec3 w, double gravity, double dt, double rate) {
  FreeMotion out;
  out.before = frame.velocity() + frame.to_model(frame.step_back(w + frame.rigid_rate(arm)));
  const Vec3 weight{0, 0, gravity};
  Vec3 a = m == 0 ? Vec3{} : frame.to_model(-m * f) - weight;
  if (rate > 0) {
    const Vec3 along{mean.x + mean.spin * arm.z, 0, mean.z - mean.spin * arm.x};
    a = fused(-rate, frame.to_model(frame.step_back(w - along)), a);
  }
  out.after = fused(dt, a, out.before);
  return out;
}

/// Displacement of a node of the wheel in its own axes, from that in its frame.
RAILSTRATA_POINTWISE Vec3 own_displacement(const ReferenceFrame& frame, double radius, double cosine, double sine,
                                           Vec3 u) {
  const Vec3 travel = frame.own_travel();
  const double c = frame.turn.c, s = frame.turn.s, ax = -radius * sine, az = radius * cosine;
  const double px = ax + u.x, pz = az + u.z;
  return {travel.x + c * px + s * pz - ax, travel.y + u.y, c * pz - s * px - az};
}

/// The mean travel of a revolved body's free nodes along the rail and their mean spin, not the vertical motion, from
/// the sums of an update; mass, inertia: of those nodes.
RAILSTRATA_POINTWISE MeanMotion mean_motion(const ReferenceFrame& frame, const UpdateSums& sums, double mass,
                                            double inertia) {
  const double travel = (frame.turn.c * sums.momentum_x + frame.turn.s * sums.momentum_z) / mass;
  const Vec3 in_frame = rotate_back(frame.turn, {travel, 0, 0});
  return {in_frame.x, in_frame.z, sums.angular / inertia};
}

}  // namespace railstrata
