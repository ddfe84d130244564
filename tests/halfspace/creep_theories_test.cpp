#include "halfspace/creep_theories.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace railstrata {
namespace {

const HalfSpaceMaterial kSteel{210e9, 0.3};

RollingEllipse ellipse(double a, double b, double friction = 0.4) {
  const HertzGap gap = hertz_gap(a, b, contact_modulus(kSteel, kSteel), 7e4);
  return rolling_ellipse(hertz_contact(gap.A, gap.B, contact_modulus(kSteel, kSteel), 7e4), friction, kSteel, kSteel);
}

TEST(KalkerCoefficients, AtTheNodesAreTheTable) {
  EXPECT_DOUBLE_EQ(kalker_coefficients(1, 0.25).c11, 4.12);
  EXPECT_DOUBLE_EQ(kalker_coefficients(0.1, 0).c22, 2.51);
  EXPECT_NEAR(kalker_coefficients(10, 0.5).c23, 18, 1e-12);
  EXPECT_NEAR(kalker_coefficients(1 / 0.7, 0.25).c23, 1.95, 1e-12);
}

TEST(KalkerCoefficients, BetweenTheNodesStayBetweenThem) {
  for (double r = 0.11; r < 10; r *= 1.07) {
    const CreepCoefficients c = kalker_coefficients(r, 0.3), d = kalker_coefficients(r * 1.05, 0.3);
    EXPECT_GT(d.c11, c.c11) << r;
    EXPECT_GT(d.c23, c.c23) << r;
  }
}

TEST(FastTheories, AgreeWithTheLinearTheoryForSmallCreepage) {
  for (double ratio : {0.3, 1.0, 3.0}) {
    const RollingEllipse e = ellipse(5e-3 * ratio, 5e-3, 1e3);
    for (const Creepage c : {Creepage{1e-6, 0, 0}, Creepage{0, -1e-6, 0}, Creepage{0, 0, 1e-4}}) {
      const CreepForce linear = linear_theory(e, c), v = vermeulen_johnson(e, c), p = polach(e, c),
                       f = fastsim(e, c, 200, 200);
      const double size = std::hypot(linear.x, linear.y);
      for (const CreepForce& other : {v, p, f}) {
        EXPECT_NEAR(other.x / size, linear.x / size, 2e-3) << ratio;
        EXPECT_NEAR(other.y / size, linear.y / size, 2e-3) << ratio;
      }
    }
  }
}

TEST(FastTheories, SaturateAtTheFrictionBound) {
  const RollingEllipse e = ellipse(6e-3, 4e-3);
  const double bound = e.friction * e.contact.load;
  for (const CreepForce& f :
       {vermeulen_johnson(e, {-0.05, 0.02, 0}), polach(e, {-5, 2, 0}), fastsim(e, {-0.05, 0.02, 0})}) {
    EXPECT_NEAR(std::hypot(f.x, f.y) / bound, 1, 2e-3);
    EXPECT_LT(f.x, 0);
    EXPECT_GT(f.y, 0);
  }
}

TEST(FastTheories, FastsimIsConvergedAt50By50) {
  const RollingEllipse e = ellipse(6e-3, 4e-3);
  const Creepage c{-1e-3, 5e-4, 0.12};
  const CreepForce coarse = fastsim(e, c), fine = fastsim(e, c, 400, 400);
  EXPECT_NEAR(coarse.x / fine.x, 1, 5e-3);
  EXPECT_NEAR(coarse.y / fine.y, 1, 5e-3);
}

}  // namespace
}  // namespace railstrata
