#pragma once
// Time and memory of a run, estimated without running it.

#include <vector>

#include "device/device_need.hpp"
#include "fem/rank_need.hpp"
#include "fem/step_plan.hpp"

namespace railstrata {

struct RunEstimate {
  StepLimits limits;
  long steps = 0;  ///< over the path; 0 for a static case
  double seconds =
      0;  ///< of explicit rolling: measured force evaluations on this machine, these threads; the preload comes on top
  double memory_bytes = 0;  ///< at the peak: of this process with both bodies ready, and what a run takes beyond them
  /// Estimate for several processes with as many threads each, on machines like this one in a network like that of
  /// RankNetwork.
  struct OnRanks {
    RankNeed need;
    double seconds = 0, memory_bytes = 0;  ///< memory: of each rank, which has both bodies whole
  };
  device::DeviceNeed card;     ///< of a card; nothing of a static case
  std::vector<OnRanks> ranks;  ///< 2 and 4, as far as the mesh can be cut; none of a static case
};

/// elsewhere: also for a card and for several processes.
RunEstimate estimate_run(const Model& model, bool elsewhere = false);

}  // namespace railstrata
