#pragma once
// Which step a rolling takes and what makes it possible.
#include <string>

#include "fem/mass_scaling.hpp"

namespace railstrata {

/// What limits the step [s]: 2/omega_max of the assembled bodies by Lanczos, the bound from single elements and where that is smallest, the contact (penalty only).
struct StepLimits {
  double lanczos = 0;    ///< with the added mass
  double unscaled = 0;   ///< without
  double element = 0, contact = 0;
  double chosen = 0;     ///< the step taken: run.step_safety times the least
  double added_mass = 0, scaled_mass = 0;  ///< kg, by selective mass scaling and of the nodes it acts on; 0: real masses
  std::string scaled_where;                ///< blocks with added mass: "rail cap, rail gauge shell"
  std::string where;
};

/// run.time_step_method: `uniform` takes the step of the real masses, `mass_scaling` adds inertia across thin rows (fem/mass_scaling.hpp), `auto` does so for a body
/// whose step grows by more than the factor kWorthwhile. The wanted step of thin rows is run.mass_scaling_step times the element size over the matrix's pressure wave speed.
struct StepPlan {
  static constexpr double kWorthwhile = 1.2;
  explicit StepPlan(const RollingSystem& system);

  StepLimits limits;
  MassScaling rail, wheel;  ///< empty: real masses
};

}  // namespace railstrata
