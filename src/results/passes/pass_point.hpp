#pragma once
// A point of the rail's section after a pass, and what one sees while the wheel goes over, by either method.
#include <array>
#include <string>
#include <vector>

#include "steady/pass_class.hpp"
#include "steady/steady_pass.hpp"

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

/// A point and what it sees at the stations, in the order in which the load reaches them.
struct PassLoop {
  std::string name;                  ///< "governing", "surface", "above the border", "below the border"
  double y = 0, depth = 0;           ///< m, as of PassPoint
  std::vector<double> x;             ///< m, of the stations from the load
  std::vector<StationState> states;  ///< as many, in the axes of PassPoint
};

}  // namespace railstrata
