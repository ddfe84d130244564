#pragma once
// Results that were computed soundly and yet say that the case leaves what its model can mean.
#include <vector>

#include "case/case_spec.hpp"
#include "post/summary.hpp"

namespace railstrata {

/// Von Mises stress above which a linear elastic rail is no longer to be believed, Pa: a round figure of the order of
/// the 0.2 % proof stress of common as-rolled rail steels (grade R260). Heat-treated grades stand more, so it is a
/// warning, not a check.
inline constexpr double kCommonRailYield = 500e6;

/// patch_wider_than_layer (of either body), patch_near_border_of_fine_zone (finite elements: nearer than an element on
/// each side), von_mises_above_common_rail_yield.
std::vector<Warning> implausible(const Summary& summary, const CaseSpec& spec);

}  // namespace railstrata
