#pragma once
// Fast theories of rolling contact on a Hertz ellipse: creepages in, forces out, in microseconds. Baselines for the
// boundary element solution.
//
// Creepage (xi, eta, phi): rigid slip of the wheel over the rail / V: (xi - phi y, eta + phi x); forces act on the
// rail, along the creepage. a is the semi-axis in the rolling direction.
#include "halfspace/hertz.hpp"

namespace railstrata {

struct Creepage {
  double x = 0, y = 0;  ///< xi, eta
  double spin = 0;      ///< phi, 1/m
};
struct CreepForce {
  double x = 0, y = 0;  ///< N
  double moment = 0;    ///< N m; 0 where the theory has none
};

/// C11, C22, C23 of Kalker's linear theory for equal bodies. [Kalker1990 table E.3] a/b in [0.1, 10] (clamped), nu in
/// [0, 1/2].
struct CreepCoefficients {
  double c11 = 0, c22 = 0, c23 = 0;
};
CreepCoefficients kalker_coefficients(double a_over_b, double poisson);
/// The same with the parabola over Poisson's ratio of 1/C, as CONTACT has it: for narrow ellipses 1/C is linear in it.
CreepCoefficients kalker_coefficients_by_inverse(double a_over_b, double poisson);

/// Input of the theories: 2/G = 1/G1 + 1/G2 and nu/G the mean of the bodies' nu/G. [Kalker1990 eq. 1.44]
struct RollingEllipse {
  HertzContact contact;
  double friction = 0, shear = 0;
  CreepCoefficients coefficient;
};
RollingEllipse rolling_ellipse(const HertzContact& contact, double friction, const HalfSpaceMaterial& wheel,
                               const HalfSpaceMaterial& rail);

/// F_x = G c² C11 xi, F_y = G c² (C22 eta + c C23 phi), c² = a b; valid for small creepage. [Kalker1990]
CreepForce linear_theory(const RollingEllipse& ellipse, const Creepage& creepage);

/// The cubic law of Vermeulen and Johnson on the resultant of the linear theory (which adds spin).
/// [VermeulenJohnson1964, ShenHedrickElkins1983]
CreepForce vermeulen_johnson(const RollingEllipse& ellipse, const Creepage& creepage);

/// Polach's formula with its spin term. [Polach2000]
CreepForce polach(const RollingEllipse& ellipse, const Creepage& creepage);

/// Kalker's simplified theory: u = L q with the three flexibilities of the linear theory, parabolic bound. [Kalker1982]
CreepForce fastsim(const RollingEllipse& ellipse, const Creepage& creepage, int strips = 50, int slices = 50);

}  // namespace railstrata
