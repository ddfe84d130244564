#pragma once
// Lateral position and traction of the wheels of a series of passes: [passes] of a case.
//
// Pass n takes value n of each list, which begins again after its last one, and an offset of a normal distribution cut
// at three deviations. The offset is a function of the seed and n alone: the same however the passes are cut by
// --resume.
#include <vector>

#include "spec/case_fwd.hpp"

namespace railstrata {

/// Position and traction of one pass.
struct PassPlan {
  double lateral = 0;        ///< m, to the field side
  std::size_t traction = 0;  ///< place among traction_coefficients; 0 without them
};

/// pass: from 1.
PassPlan pass_plan(const PassesSpec& spec, int pass);

/// Passes after which the plan begins again: the least common multiple of the lists' lengths. Passes that scatter never
/// begin again: ten of them (and whole lists) count as one, so that their sums can be compared.
int passes_per_cycle(const PassesSpec& spec);

/// m, the farthest that any pass may run to a side.
double farthest_pass(const PassesSpec& spec);

/// The cases to solve: one for each of traction_coefficients, the case itself without them.
std::vector<CaseSpec> cases_of_tractions(const CaseSpec& spec);

}  // namespace railstrata
