#pragma once
// Values that an engine returns after a step (fem/step_engine.hpp).
#include "fem/axle_law.hpp"
#include "fem/contact_law.hpp"

namespace railstrata {

/// Values after a step.
struct StepRecord {
  double time = 0;
  long step = 0;  ///< number of steps taken
  AxleMotion axle;
  ContactForces forces;
  double largest_pressure = 0;  ///< Pa
  EnergyBalance balance;        ///< its stored energies: of the last step that they were asked for with
  bool reached_edge = false;
  int fault = 0;  ///< of the engine: 0, or what it cannot go on with
};

}  // namespace railstrata
