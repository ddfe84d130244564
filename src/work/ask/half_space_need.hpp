#pragma once
// Time and memory of a half-space solution, estimated before it starts.
#include "model/model.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata {

struct HalfSpaceNeed {
  double cells = 0;         ///< of the first potential contact area; it grows if the patch reaches its edge
  double memory_bytes = 0;  ///< at the peak
  double seconds = 0;       ///< of one thread, within a factor of three: iterations differ from case to case
};

/// cell: size of the cells [m].
HalfSpaceNeed half_space_need(const CaseSpec& spec, const Placement& placement, double cell);

/// Throws EnvironmentError that names both and what to change if the solution does not fit into the memory at hand.
void require_memory(const HalfSpaceNeed& need, double cell);

/// "0.94 million cells, about 1.2 GB of memory and 2 min": for the user before a long solution.
std::string need_text(const HalfSpaceNeed& need);

}  // namespace railstrata
