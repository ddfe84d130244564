#pragma once
// State that the kernels of a step share: the axle's motion and all that is computed from it. There is one on the
// device; a thread of one kernel writes it, between the others.
#include "device/memory.hpp"
#include "fem/axle_law.hpp"
#include "fem/contact_law.hpp"

namespace railstrata::device {

/// Faults that stop a device's steps.
enum class Fault : int {
  none = 0,
  patch_too_large,  ///< a row touches more wheel nodes than there is room for
  off_the_band,     ///< a row touches wheel nodes far from below the axle
  rows_meet,        ///< rows of one group share a wheel node
  window_too_large
};

/// Sums over the contact in a step.
struct ContactSums {
  ContactForces forces;
  ContactLosses losses;
  double largest_pressure = 0;  ///< Pa
  double largest_change = 0;    ///< m/s, of a sweep
};

struct StepState {
  // taken over from step to step
  double time = 0;
  long step = 0;
  AxleMotion axle;
  EnergyBalance balance;
  MeanMotion mean;  ///< of the wheel
  int reached_edge = 0;
  int fault = 0;
  // made before a step
  double rate = 0, torque = 0;       ///< 1/s, run-up damping; N m
  NodeStep rail, wheel;              ///< of the nodes' updates, with the frames
  AxlePose in_frame;                 ///< of the axle, the wheel's frame
  Rotation<double> turn;             ///< by in_frame.psi
  AxlePose pose;                     ///< of the axle, model frame
  AxlePose on_wheel;                 ///< the same in the wheel's axes
  Rotation<double> turned;           ///< by on_wheel.psi
  int band_first = 0;                ///< station of the wheel where the band begins
  int window_first = 0, window = 0;  ///< stations of the rail that the last search looked at
  ContactSums contact;

  template <SweepKind kind>
  RAILSTRATA_POINTWISE const NodeStep& nodes() const {
    if constexpr (kind == SweepKind::revolve)
      return wheel;
    else
      return rail;
  }
  /// Rotation of a body's offsets against its frame.
  template <SweepKind kind>
  RAILSTRATA_POINTWISE Rotation<double> turn_of_body() const {
    if constexpr (kind == SweepKind::revolve)
      return turn;
    else
      return {};
  }
};

}  // namespace railstrata::device
