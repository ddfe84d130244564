#pragma once
// Time and memory of a run, estimated without running it.

#include "fem/step_plan.hpp"

namespace railstrata {

struct RunEstimate {
  StepLimits limits;
  long steps = 0;  ///< over the path, of one that ends when windows repeat over two of them; 0 for a static case
  double seconds =
      0;  ///< wall time on this machine with these threads: preload and rolling, by a trial of its steps; static: 0
  double memory_bytes = 0;  ///< at the peak: of this process with both bodies ready, and what a run takes beyond them
};

RunEstimate estimate_run(const Model& model);

}  // namespace railstrata
