#pragma once
// Uniform travel and turn, which a body's displacements are followed in (fem/stepper.hpp). The turn is about the
// lateral axis of the body's own axes; those stand at the yaw to the model's and travel with the frame. A frame without
// speed, spin and yaw is the model frame: every function then returns its argument to the last bit.
#include "core/rotation.hpp"

namespace railstrata {

/// Velocity of a point at `arm` from an axle, of its spin about it.
constexpr Vec3 spun(double spin, Vec3 arm) { return {spin * arm.z, 0, -spin * arm.x}; }

struct ReferenceFrame {
  double speed = 0;           ///< m/s, along the rail
  double lateral_speed = 0;   ///< m/s
  double spin = 0;            ///< rad/s, positive rolling forward
  double x = 0, y = 0;        ///< m travelled
  double psi = 0;             ///< rad turned
  Rotation<double> yaw_turn;  ///< from the body's axes to the model's
  Rotation<double> turn;
  Rotation<double> step;   ///< of one time step
  double centrifugal = 0;  ///< 1/s², 2 (1 - cos omega dt)/dt^2
  double slope_cos = 0;    ///< 1/s, (cos omega dt - 1)/dt
  double slope_sin = 0;    ///< 1/s, sin omega dt/dt

  void set_step(double dt) {
    const SmallRotation<double> small = small_rotation_by(spin * dt);
    step = small.rotation();
    centrifugal = small.chord_squared() / (dt * dt);
    slope_cos = small.cosine_less_one() / dt;
    slope_sin = small.s / dt;
  }
  RAILSTRATA_POINTWISE void move_to(double time) {
    x = speed * time;
    y = lateral_speed * time;
    psi = spin * time;
    turn = turn_of(psi);
  }
  constexpr Vec3 to_model(Vec3 v) const { return yaw(yaw_turn, rotate(turn, v)); }
  constexpr Vec3 to_frame(Vec3 v) const { return rotate_back(turn, yaw_back(yaw_turn, v)); }
  /// Velocity and travel, model frame.
  constexpr Vec3 velocity() const { return {speed, lateral_speed, 0}; }
  constexpr Vec3 travel() const { return {x, y, 0}; }
  /// The same in the body's own axes.
  constexpr Vec3 own_velocity() const { return yaw_back(yaw_turn, velocity()); }
  constexpr Vec3 own_travel() const { return yaw_back(yaw_turn, travel()); }
  /// D^T v, D the rotation of one step.
  constexpr Vec3 step_back(Vec3 v) const { return rotate_back(step, v); }
  /// (D - 1) X / dt
  constexpr Vec3 rigid_rate(Vec3 arm) const {
    return {slope_cos * arm.x + slope_sin * arm.z, 0, slope_cos * arm.z - slope_sin * arm.x};
  }
};

}  // namespace railstrata
