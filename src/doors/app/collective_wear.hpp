#pragma once
// `collective --steps`: the collective's wear taken off the rail's profile, step by step.
#include <string>

#include "app/commands.hpp"

namespace railstrata {

struct WearOptions {
  int steps = 0;                      ///< --steps; 0: no limit
  double passages = 0;                ///< --passages; 0: no limit
  std::string max_wear = "0.005 mm";  ///< --max-wear: a length
  bool resume = false;                ///< --resume
};
ExitCode collective_wear(const WearOptions& wanted, const CommandOptions& options);

}  // namespace railstrata
