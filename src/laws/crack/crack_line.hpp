#pragma once
// A straight crack in a vertical plane, and the words for what it is asked.
#include <cmath>

namespace railstrata {

enum class CrackKind { mouth, inside };

/// What fills the crack.
enum class CrackFluid {
  none,
  mouth,   ///< a fluid at the pressure of the patch over the mouth
  trapped  ///< a fluid whose volume stays while the patch lies over the mouth
};

/// crack/crack_growth.hpp
enum class GrowthLaw { shear, paris };

struct CrackLine {
  CrackKind kind = CrackKind::mouth;
  double angle = 0;   ///< rad, from the surface
  double length = 0;  ///< m
  double depth = 0;   ///< m, of its start; 0: the mouth
  double x(double r) const { return r * std::cos(angle); }
  double z(double r) const { return depth + r * std::sin(angle); }
  bool level() const { return angle == 0; }  ///< crack/level_crack.hpp
};

/// Mode I opens; mode II moves the left side, seen along the crack from its start with x to the right and z down, i.e.
/// the side of the normal (-sin angle, cos angle), towards the end.
struct StressIntensity {
  double I = 0, II = 0;  ///< Pa sqrt(m)
};

}  // namespace railstrata
