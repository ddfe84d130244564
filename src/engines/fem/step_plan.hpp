#pragma once
// Which step a rolling takes and what makes it possible.
#include <array>
#include <string>
#include <vector>

#include "body/mass_scaling.hpp"
#include "fem/rolling_system.hpp"

namespace railstrata {

/// A block of a body to which mass scaling adds.
struct ScaledBlock {
  std::string name;            ///< "rail cap"
  double mass = 0, added = 0;  ///< kg, of the whole block and by mass scaling
};

/// Limits of the step [s]: 2/omega_max of the assembled bodies by Lanczos, the bound from single elements and where
/// that is smallest.
struct StepLimits {
  double lanczos = 0;   ///< with the added mass
  double unscaled = 0;  ///< of the real masses
  double element = 0;
  double chosen = 0;  ///< the step taken: run.step_safety times lanczos
  double added_mass = 0,
         scaled_mass = 0;  ///< kg, by selective mass scaling and of the nodes it acts on; 0: real masses
  std::vector<ScaledBlock> scaled_blocks;
  std::string where;
};

/// Inertia is added across thin rows (body/mass_scaling.hpp) of a body whose step grows by more than the factor
/// kWorthwhile. The wanted step of thin rows is run.mass_scaling_step times the element size over the matrix's pressure
/// wave speed; 0: real masses.
struct StepPlan {
  static constexpr double kWorthwhile = 1.2;
  explicit StepPlan(const RollingSystem& system);

  StepLimits limits;
  std::array<MassScaling, 2> scaling;  ///< by BodyId; empty: real masses
};

}  // namespace railstrata
