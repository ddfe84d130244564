#pragma once
// A point of the rail's section after a pass: what residual.csv says of it, by either method.
#include <array>

#include "steady/pass_class.hpp"

namespace railstrata {

/// Axes of the rigid contact point: x along the rail, y in the contact plane, z into the rail.
struct PassPoint {
  double y = 0, depth = 0;  ///< m
  int zone = 0;             ///< 0 the rail, then its layers from the surface down
  PassStrain strain;        ///< of the pass
  PassClass kind = PassClass::transient;
  std::array<double, 6> stress{};   ///< Pa, residual, xx, yy, zz, xy, yz, xz
  std::array<double, 6> plastic{};  ///< Ep, tensor shears
  double accumulated = 0;           ///< p over all passes
  int row = -1, column = -1;        ///< of the fine zone's elements; none deeper and of the stationary method
};

}  // namespace railstrata
