#pragma once
// Time and memory of a run, estimated without running it.

#include "fem/step_plan.hpp"

namespace railstrata {

struct RunEstimate {
  StepLimits limits;
  long steps = 0;  ///< over the path, of one that ends when windows repeat over two of them; 0 for a static case
  double seconds =
      0;  ///< of explicit rolling: measured force evaluations on this machine, these threads; the preload comes on top
  double memory_bytes = 0;  ///< at the peak: of this process with both bodies ready, and what a run takes beyond them
};

RunEstimate estimate_run(const Model& model);

}  // namespace railstrata
