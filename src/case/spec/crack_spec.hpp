#pragma once
// A crack in the rail.
#include <numbers>
#include <optional>

#include "crack/crack_line.hpp"

namespace railstrata {

struct CrackSpec {
  double depth = 0;                            ///< m, of its end below the surface; 0: none goes down
  double top = 0;                              ///< m, of its start; 0: it breaks the surface
  double angle = 25 * std::numbers::pi / 180;  ///< rad, from the surface
  std::optional<double> azimuth;               ///< rad, of its way down, from that of rolling to the field side; none:
                                               ///< that in which it grows fastest
  double lateral = 0;                          ///< m, from where the pressure is largest to the field side
  std::optional<double> place;                 ///< m, y of the rail, of one that is there from the beginning of a life
  double face_friction = 0.2;
  CrackFluid fluid = CrackFluid::none;
  double aspect = 1;  ///< half the length at the surface over the length downwards
  GrowthLaw law = GrowthLaw::shear;
  double threshold = 4e6;                      ///< Pa √m
  double detectable = 2e-3, allowable = 5e-3;  ///< m, depths that an inspection finds and that end the rail
  double length = 0;                           ///< m, of one along an interface; 0: it goes down
  int layer = 1;                               ///< of the rail, from the surface, whose lower interface that is
  bool level() const { return length > 0; }
  bool there() const { return depth > 0 || level(); }
};

}  // namespace railstrata
