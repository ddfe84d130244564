#pragma once
// Results that were computed soundly and yet say that the case leaves what its model can mean.
#include <vector>

#include "case/case_spec.hpp"
#include "post/summary.hpp"

namespace railstrata {

/// patch_wider_than_layer (of either body), patch_near_border_of_fine_zone (finite elements: nearer than an element on
/// each side), von_mises_above_common_rail_yield.
/// Limits and words: check_limits.hpp.
std::vector<Warning> implausible(const Summary& summary, const CaseSpec& spec);

}  // namespace railstrata
