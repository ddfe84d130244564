#pragma once
// The rigid axle of the wheel: what loads it and its step.
#include "body/body_state.hpp"
#include "fem/energy.hpp"
#include "fem/node_update.hpp"
#include "fem/rolling_system.hpp"
#include "fem/suspension.hpp"

namespace railstrata {

/// Model frame.
struct AxleMotion {
  double x = 0, y = 0, z = 0,
         psi = 0;  ///< displacement from the start of the rolling's reference (rigid contact position), spin angle
  double vx = 0, vy = 0, vz = 0, spin = 0;  ///< half-step velocities
  AxlePose pose() const { return {x, y, z, psi}; }
};

/// Forces on the axle from the bore and about it from the ties' offsets, model frame.
struct AxleLoads {
  double fx = 0, fy = 0, fz = 0;  ///< N
  double moment = 0;              ///< N m, positive rolling forward
};

/// Smooth rise from 0 to 1 over [0, 1] with zero slope at both ends.
inline double smooth_rise(double t) { return t <= 0 ? 0 : t >= 1 ? 1 : t * t * (3 - 2 * t); }

/// Drive torque at `time` [s], N m.
inline double drive_torque(const RollingSystem& system, double time) {
  const double ramp = system.options.torque_ramp;
  return ramp > 0 ? system.torque * smooth_rise(time / ramp) : system.torque;
}

/// Forces that drive the axle.
struct AxleDrive {
  double torque = 0;   ///< N m
  double lateral = 0;  ///< N, to the field side; of an axle that is free sideways
};

/// Internal forces of the bore's nodes, in the wheel's frame, turned by `drift` within it; tie_moment: what the ties'
/// offsets hand to the rotation.
AxleLoads bore_loads(const Axle& axle, const Field& f_wheel, Rotation<double> drift, double tie_moment,
                     const ReferenceFrame& frame);

/// One central-difference step; rest_z: height of the axle in static equilibrium [m]. Where the creepage is given,
/// speed and spin stay as they are; where the axle is not free sideways, its lateral speed does. Adds the work of
/// torque and guides and the losses to the book and returns the kinetic energy of axle and sprung mass, v(n-1/2)
/// v(n+1/2)/2 [J].
double advance_axle(const RollingSystem& system, const AxleLoads& loads, const AxleDrive& drive, double rest_z,
                    const StepScope& scope, AxleMotion& axle, std::vector<MassGroup>& groups, EnergyBalance& book);

/// J, of the suspension's springs with their static force.
double spring_energy(const RollingSystem& system, const AxleMotion& axle, double rest_z,
                     const std::vector<MassGroup>& groups);

}  // namespace railstrata
