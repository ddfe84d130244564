#pragma once
// cntc_calculate and subs_calculate: CONTACT's answer for a contact problem.
#include "cntc/problem.hpp"

namespace railstrata::cntc {

/// 0, or the number of elements in contact at the border, or a negative code.
int calculate(int ire, int icp) noexcept;
int calculate_blocks(int ire, int icp) noexcept;

}  // namespace railstrata::cntc
