#pragma once
// Closed forms of frictional contact that the boundary element solution must meet.
//
// Signs as everywhere: tractions q act on the rail, creepage is the rigid slip of the wheel over the rail divided by
// the speed, so that a driving wheel has creepage < 0 and q_x < 0. Forces below are given on the rail.
#include <algorithm>
#include <cmath>

#include "halfspace/hertz.hpp"

namespace railstrata {

/// Cattaneo–Mindlin: a circular Hertz contact shifted sideways without rolling; exact for nu = 0, otherwise up to the
/// small traction across the shift. [Johnson1985 sec. 7.2d, eqs. 7.41–7.43]
struct CattaneoShift {
  double stick_radius;  ///< m
  double shift;         ///< m, of distant points of the wheel against the rail
};
inline CattaneoShift cattaneo_shift(const HertzContact& circle, double friction, double force,
                                    const HalfSpaceMaterial& wheel, const HalfSpaceMaterial& rail) {
  const double left = std::clamp(1 - std::abs(force) / (friction * circle.load), 0.0, 1.0);
  const double compliance = (2 - wheel.poisson) / wheel.shear() + (2 - rail.poisson) / rail.shear();
  return {circle.a * std::cbrt(left),
          3 * friction * circle.load / (16 * circle.a) * compliance * (1 - std::cbrt(left * left))};
}

/// Traction at radius r [Pa], along the force.
inline double cattaneo_traction(const HertzContact& circle, double friction, double stick_radius, double r) {
  const double full = friction * circle.pressure(r, 0);
  if (r >= stick_radius) return full;
  const double s = r / stick_radius;
  return full - friction * circle.p0 * stick_radius / circle.a * std::sqrt(1 - s * s);
}

/// Carter: a cylinder in steady rolling, equal materials (plane strain). Half-width a, p = p0 sqrt(1 - x²/a²), leading
/// edge x = a. [Johnson1985 sec. 8.3]
struct CarterRolling {
  double half_width, p0, friction;
  double stick_half_width;          ///< m, the stick zone touches the leading edge: a - 2 c < x < a
  double creepage;                  ///< -f (a/R)(1 - c/a), with 1/R = the relative curvature 2A
  double traction(double x) const;  ///< Pa, on the rail
};
/// force_ratio = |F_x|/(f F_z) in [0, 1]; the wheel drives. relative_curvature = 2A [1/m].
inline CarterRolling carter_rolling(double half_width, double p0, double relative_curvature, double friction,
                                    double force_ratio) {
  const double c = half_width * std::sqrt(std::clamp(1 - force_ratio, 0.0, 1.0));
  return {half_width, p0, friction, c, -friction * relative_curvature * (half_width - c)};
}

inline double CarterRolling::traction(double x) const {
  const auto semicircle = [](double s) { return s * s < 1 ? std::sqrt(1 - s * s) : 0.0; };
  const double full = friction * p0 * semicircle(x / half_width);
  const double centre = half_width - stick_half_width;
  const double relief =
      stick_half_width > 0 ? friction * p0 * stick_half_width / half_width * semicircle((x - centre) / stick_half_width)
                           : 0.0;
  return -(full - relief);
}

}  // namespace railstrata
