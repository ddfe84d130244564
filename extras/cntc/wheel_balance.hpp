#pragma once
// Module 1: the wheel's height, its pitch rate and the way of a rail that gives way, from given forces.
#include <functional>

#include "cntc/module_one.hpp"

namespace railstrata::cntc {

/// What wheel and rail do at a height: `press` notes the patches and gives the vertical force on the rail, `touch` is
/// the height where they touch.
struct AtHeight {
  std::function<double(double z)> press;
  std::function<double()> touch;
};

/// N = 0 and 1 with F = 0, 1 (FX_WS in place of the pitch rate) and 3 (the rail's springs carry the wheel). Throws
/// Refused where no height or rate has the forces.
void balance(ModuleOne& one, const Problem& base, const AtHeight& wheel);

}  // namespace railstrata::cntc
