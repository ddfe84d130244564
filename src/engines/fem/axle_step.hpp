#pragma once
// The rigid axle of the wheel: what loads it and its step.
#include "body/body_state.hpp"
#include "fem/axle_law.hpp"
#include "fem/reference_frame.hpp"
#include "fem/rolling_system.hpp"

namespace railstrata {

/// Drive torque at `time` [s], N m; ramp: s, in which it rises.
inline double drive_torque(const RollingSystem& system, double time, double ramp) {
  return ramp > 0 ? system.torque * smooth_rise(time / ramp) : system.torque;
}

/// Internal forces of a bore's nodes, in the frame of their body, turned by `drift` within it; tie_moment: what the
/// ties' offsets hand to the rotation.
AxleLoads bore_loads(const std::vector<BoreNode>& nodes, const Field& f, Rotation<double> drift, double tie_moment,
                     const ReferenceFrame& frame);

SuspensionLaw suspension_law(const VehicleSpec& vehicle);

/// rest_z: height of the axle in static equilibrium [m].
AxleLaw axle_law(const RollingSystem& system, double rest_z);

}  // namespace railstrata
