#pragma once
// What a run will cost, before it is started.
#include "fem/rolling_system.hpp"

namespace railstrata {

struct RunEstimate {
  long elements = 0, nodes = 0;
  double stable_step = 0;          ///< s, 2/omega_max of the assembled bodies (Lanczos)
  double element_bound = 0;        ///< s, of the worst free element
  std::string limiting_element;    ///< body, block and place of that element
  long steps = 0;                  ///< to the end of the last window
  double memory_bytes = 0;
  double element_steps_per_s = 0;  ///< of a few internal force evaluations made now
  double seconds = 0;              ///< rolling only
};

/// Memory of a run per element [bytes], from the arrays it keeps.
inline constexpr double kBytesPerElement = 420;

RunEstimate estimate_run(const RollingSystem& system);

}  // namespace railstrata
