#include "halfspace/hertz.hpp"
#include "tests/halfspace/classical_rolling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace railstrata {
namespace {

const HalfSpaceMaterial kSteel{210e9, 0.3};

TEST(Hertz, SphereMeetsJohnsonEq422To424) {
  const double Es = contact_modulus(kSteel, kSteel), R = 0.4, F = 5e4;
  const HertzContact c = hertz_contact(0.5 / R, 0.5 / R, Es, F);
  const double a = std::cbrt(3 * F * R / (4 * Es));
  EXPECT_NEAR(c.a / a, 1, 1e-13);
  EXPECT_NEAR(c.b / a, 1, 1e-13);
  EXPECT_NEAR(c.approach / (a * a / R), 1, 1e-12);
  EXPECT_NEAR(c.p0 / std::cbrt(6 * F * Es * Es / (std::pow(std::numbers::pi, 3) * R * R)), 1, 1e-12);
}

// half_space.json: `circ` and `ell05`, 84954.6 N, E 210 GPa, nu 0.3.
TEST(Hertz, EllipsesOfTheContactReferenceCases) {
  const double Es = contact_modulus(kSteel, kSteel), F = 84954.6;
  const HertzContact circ = hertz_contact(1000.0 / 840, 1000.0 / 840, Es, F);
  EXPECT_NEAR(circ.a, 6.143980785309781e-3, 1e-15);
  EXPECT_NEAR(circ.p0, 1074.5548486194252e6, 1e-4);
  EXPECT_NEAR(circ.approach, 0.08987738069108522e-3, 1e-16);
  const HertzContact ell = hertz_contact(1.920466493737, 0.675565652454, Es, F);
  EXPECT_NEAR(ell.a, 4.344450e-3, 1e-9);
  EXPECT_NEAR(ell.b, 8.688901e-3, 1e-9);
}

// The gap closes inside: displacement of an ellipsoidal pressure at the centre and at the ends of the axes, by
// quadrature of p/r in polar coordinates.
TEST(Hertz, ApproachMinusGapEqualsDisplacementByQuadrature) {
  const double Es = 1.3e11;
  for (double ratio : {1.0, 1.7, 8.0, 120.0}) {
    const HertzContact c = hertz_contact(ratio, 1.0, Es, 1e4);
    ASSERT_LT(c.a, c.b * (1 + 1e-9));
    double at_centre = 0;
    const int n = 4000;
    for (int i = 0; i < n; ++i) {  // ∫ p dr along a ray of length rho = p0 rho pi/4
      const double t = 2 * std::numbers::pi * (i + 0.5) / n;
      at_centre +=
          c.p0 * std::numbers::pi / 4 / std::hypot(std::cos(t) / c.a, std::sin(t) / c.b) * 2 * std::numbers::pi / n;
    }
    EXPECT_NEAR(at_centre / (std::numbers::pi * Es) / c.approach, 1, 1e-10) << ratio;
  }
}

TEST(Hertz, GapIsTheInverseOfContactFromRatio001To100) {
  const double Es = 1.1e11, F = 7e4;
  for (double ratio : {0.01, 0.1, 0.5, 0.999, 1.0, 1.001, 3.0, 10.0, 100.0}) {
    const HertzGap g = hertz_gap(5e-3 * ratio, 5e-3, Es, F);
    const HertzContact c = hertz_contact(g.A, g.B, Es, F);
    EXPECT_NEAR(c.a / (5e-3 * ratio), 1, 1e-10) << ratio;
    EXPECT_NEAR(c.b / 5e-3, 1, 1e-10) << ratio;
  }
}

TEST(Hertz, RefusesConcaveGap) { EXPECT_THROW(hertz_contact(-1, 1, 1e11, 1), std::invalid_argument); }

TEST(ClassicalRolling, CattaneoTractionSumsToTheForce) {
  const HertzContact c = hertz_contact(1.2, 1.2, contact_modulus(kSteel, kSteel), 8e4);
  const double f = 0.4, force = 0.6 * f * c.load;
  const CattaneoShift s = cattaneo_shift(c, f, force, kSteel, kSteel);
  double sum = 0;
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double r = c.a * (i + 0.5) / n;
    sum += 2 * std::numbers::pi * r * c.a / n * cattaneo_traction(c, f, s.stick_radius, r);
  }
  EXPECT_NEAR(sum / force, 1, 1e-5);
}

// carter2d.csv, computed with CONTACT: its column of theory.
TEST(ClassicalRolling, CarterCreepageOfTheReferenceTable) {
  const double a = 5e-3, p0 = 576.9231e6, f = 0.5;
  const double relative_curvature = 2.0;  // p0 = a E*/(2 R), E* = E/(2 (1 - nu²))
  EXPECT_NEAR(p0 / (a * contact_modulus(kSteel, kSteel) * relative_curvature / 2), 1, 1e-6);
  EXPECT_NEAR(carter_rolling(a, p0, relative_curvature, f, 0.4).creepage, -0.0011270167, 1e-9);
  const CarterRolling c = carter_rolling(a, p0, relative_curvature, f, 0.64);
  EXPECT_NEAR(c.stick_half_width, 3e-3, 1e-12);
  double sum = 0;
  for (int i = 0; i < 20000; ++i) sum += c.traction(a * (2 * (i + 0.5) / 20000 - 1)) * a / 10000;
  EXPECT_NEAR(sum / (-0.64 * f * p0 * a * std::numbers::pi / 2), 1, 1e-5);
}

}  // namespace
}  // namespace railstrata
