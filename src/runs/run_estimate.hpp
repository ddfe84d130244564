#pragma once
// What a run of a case will cost, found without running it.
#include <string>

#include "fem/step_plan.hpp"

namespace railstrata {

struct RunEstimate {
  StepLimits limits;
  double evaluations =
      1;           ///< of the elements' forces a step, on average over the elements: more than one with local steps
  long steps = 0;  ///< over the path; 0 for a static case
  double seconds =
      0;  ///< of explicit rolling: measured force evaluations on this machine, these threads; the preload comes on top
  double memory_bytes = 0;  ///< in use with both bodies ready for computing
};

RunEstimate estimate_run(const Model& model);

}  // namespace railstrata
