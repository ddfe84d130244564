#pragma once
// The state of a rolling wheel and rail.
#include <vector>

#include "body/body_state.hpp"
#include "contact/enforcement.hpp"
#include "fem/axle_law.hpp"
#include "fem/energy.hpp"
#include "fem/node_law.hpp"

namespace railstrata {

using BodyStates = std::array<BodyState, 2>;  ///< by BodyId

/// The only thing that changes. Displacements and velocities of the bodies are relative to their frames: the model's
/// for the rail.
struct RollingState {
  double time = 0;
  long step = 0;
  BodyStates bodies;  ///< by BodyId
  AxleMotion axle;
  std::vector<MassGroup> groups, sleepers;  ///< sprung mass; half sleepers of a rail on a track
  SurfaceTractions tractions{0, 0};
};

/// What the start of a rolling fixes for all of it.
struct RollingStart {
  double axle_z = 0;       ///< m, height of the axle
  double side_force = 0;   ///< N, on the axle, that holds it in the static equilibrium
  double torque_ramp = 0;  ///< s, in which the torque rises
};

/// All that a step takes over from the one before, at a restart point. A stepper restored from it computes the same
/// bits as the one that gave it.
struct RestartState {
  RollingState state;
  EnergyBalance balance;
  MeanMotion mean;  ///< of the wheel
  std::vector<MortarContact::Facet> facets;
  RollingStart start;
  double dt = 0;  ///< s
  bool reached_edge = false;
};

}  // namespace railstrata
