#pragma once
// Which step a rolling takes and what makes it possible.
#include <array>
#include <string>
#include <vector>

#include "body/local_steps.hpp"
#include "body/mass_scaling.hpp"
#include "fem/rolling_system.hpp"

namespace railstrata {

/// A block of a body to which mass scaling adds.
struct ScaledBlock {
  std::string name;            ///< "rail cap"
  double mass = 0, added = 0;  ///< kg, of the whole block and by mass scaling
};

/// Limits of the step [s]: 2/omega_max of the assembled bodies by Lanczos, the bound from single elements and where
/// that is smallest, the contact (penalty only).
struct StepLimits {
  double lanczos = 0;   ///< with the added mass, or of the nodes that local steps leave coarse
  double unscaled = 0;  ///< of the real masses with one step for all
  double element = 0, contact = 0;
  double chosen = 0;  ///< the step taken: run.step_safety times the least
  double added_mass = 0,
         scaled_mass = 0;    ///< kg, by selective mass scaling and of the nodes it acts on; 0: real masses
  int stages = 1;            ///< of local steps
  long fine_elements = 0;    ///< evaluated in every stage
  std::string scaled_where;  ///< blocks with added mass: "rail cap, rail gauge shell"
  std::vector<ScaledBlock> scaled_blocks;
  std::string where;
};

/// How one body's nodes take the plan's step.
struct BodySteps {
  MassScaling scaling;       ///< empty: real masses
  LocalSteps local;          ///< empty: one step for all
  SurfaceResponse response;  ///< of local steps: how the stages answer a change of the tractions; empty if they do not
                             ///< reach the surface
};

/// run.time_step_method: `uniform` takes the step of the real masses, `mass_scaling` adds inertia across thin rows
/// (body/mass_scaling.hpp), `auto` does so for a body whose step grows by more than the factor kWorthwhile, `local`
/// keeps the real masses and takes inner steps where elements are fast (body/local_steps.hpp). The wanted step of thin
/// rows is run.mass_scaling_step times the element size over the matrix's pressure wave speed.
struct StepPlan {
  static constexpr double kWorthwhile = 1.2;
  explicit StepPlan(const RollingSystem& system);

  StepLimits limits;
  std::array<BodySteps, 2> bodies;  ///< by BodyId

 private:
  struct Part;
  void scale_masses(const std::vector<Part>& parts, const CaseSpec& spec);
  void refine_steps(const std::vector<Part>& parts, const CaseSpec& spec);
  void settle_stages(const std::vector<Part>& parts);
};

}  // namespace railstrata
