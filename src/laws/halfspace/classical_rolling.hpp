#pragma once
// Closed forms of frictional contact that the boundary element solution must meet.
//
// Signs as everywhere: tractions q act on the rail, creepage is the rigid slip of the wheel over the rail divided by
// the speed, so that a driving wheel has creepage < 0 and q_x < 0. Forces below are given on the rail.
#include "halfspace/hertz.hpp"

namespace railstrata {

/// Cattaneo–Mindlin: a circular Hertz contact shifted sideways without rolling; exact for nu = 0, otherwise up to the
/// small traction across the shift. [Johnson1985 sec. 7.2d, eqs. 7.41–7.43]
struct CattaneoShift {
  double stick_radius;  ///< m
  double shift;         ///< m, of distant points of the wheel against the rail
};
CattaneoShift cattaneo_shift(const HertzContact& circle, double friction, double force, const HalfSpaceMaterial& wheel,
                             const HalfSpaceMaterial& rail);
/// Traction at radius r [Pa], along the force.
double cattaneo_traction(const HertzContact& circle, double friction, double stick_radius, double r);

/// Carter: a cylinder in steady rolling, equal materials (plane strain). Half-width a, p = p0 sqrt(1 - x²/a²), leading
/// edge x = a. [Johnson1985 sec. 8.3]
struct CarterRolling {
  double half_width, p0, friction;
  double stick_half_width;          ///< m, the stick zone touches the leading edge: a - 2 c < x < a
  double creepage;                  ///< -f (a/R)(1 - c/a), with 1/R = the relative curvature 2A
  double traction(double x) const;  ///< Pa, on the rail
};
/// force_ratio = |F_x|/(f F_z) in [0, 1]; the wheel drives. relative_curvature = 2A [1/m].
CarterRolling carter_rolling(double half_width, double p0, double relative_curvature, double friction,
                             double force_ratio);

/// Vermeulen–Johnson, pure longitudinal or lateral creepage on an ellipse. [VermeulenJohnson1964]
/// tau = c² G C |xi| / (f F_z) with c² = a b and C the linear creep coefficient (C11 or C22).
double vermeulen_johnson_force_ratio(double tau);            ///< F/(f F_z) = 1 - (1 - tau/3)³, 1 for tau >= 3
double vermeulen_johnson_tau(double force_ratio);            ///< its inverse
double vermeulen_johnson_slip_fraction(double force_ratio);  ///< slip area / patch area = 1 - (1 - F/(f F_z))^(2/3)

}  // namespace railstrata
