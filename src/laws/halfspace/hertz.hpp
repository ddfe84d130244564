#pragma once
// Hertz's frictionless contact of two elastic half-spaces, any ellipse. [Johnson1985 ch. 4]
//
// The undeformed gap is h(x, y) = A x² + B y² (A, B > 0, 1/m); for crossed principal radii A = (1/R1x + 1/R2x)/2, B =
// (1/R1y + 1/R2y)/2. The pressure is p0 sqrt(1 - x²/a² - y²/b²) on the ellipse with semi-axes a along x and b along y.
namespace railstrata {

/// Linear elastic, isotropic half-space. Young's modulus [Pa], Poisson's ratio in [0, 0.5].
struct HalfSpaceMaterial {
  double young = 210e9, poisson = 0.3;
  double shear() const { return young / (2 * (1 + poisson)); }
  friend bool operator==(const HalfSpaceMaterial&, const HalfSpaceMaterial&) = default;
};

/// 1/E* = (1 - nu1²)/E1 + (1 - nu2²)/E2, Pa. [Johnson1985 eq. 4.20]
double contact_modulus(const HalfSpaceMaterial& wheel, const HalfSpaceMaterial& rail);

struct HertzContact {
  double a = 0, b = 0;  ///< m, semi-axes along x and y
  double p0 = 0;        ///< Pa, largest pressure
  double approach = 0;  ///< m, by which distant points of the bodies come together
  double load = 0;      ///< N
  double pressure(double x, double y) const;
};

/// Contact under a load [N]. contact_modulus in Pa. Throws std::invalid_argument unless A, B, contact_modulus > 0 and
/// load >= 0. Exact up to round-off for any ratio A/B (complete elliptic integrals; the ratio a/b by Newton's method on
/// [Johnson1985 eq. 4.26–4.28]).
HertzContact hertz_contact(double A, double B, double contact_modulus, double load);

/// The inverse: the curvatures A, B for which the load gives the semi-axes a, b.
struct HertzGap {
  double A = 0, B = 0;
};
HertzGap hertz_gap(double a, double b, double contact_modulus, double load);

}  // namespace railstrata
