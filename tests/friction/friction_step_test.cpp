#include "friction/friction_step.hpp"

#include <gtest/gtest.h>

namespace railstrata {
namespace {

constexpr double kFriction = 0.4, kPressure = 1e9, kStep = 2e-7;  // Pa, s
constexpr double kCompliance = 2e-8;                              // (m/s)/Pa, of steel elements of a millimetre

struct Returned {
  double q1, q2;
  FrictionReturn law;
  double size() const { return std::hypot(q1, q2); }
};
Returned returned(const FrictionLaws& laws, double q1, double q2, double plastic = 0, double compliance = kCompliance) {
  const FrictionReturn law = return_to_law(laws, {kPressure, compliance, kStep, plastic}, q1, q2);
  return {q1, q2, law};
}

FrictionLaws film(double hardening) { return {kFriction, {10e-6, 1e8, 100e6, hardening}}; }

}  // namespace

TEST(FrictionStep, OfCoulombIsTheReturnToTheDisc) {
  for (double share : {0.5, 1.0, 1.7}) {
    double q1 = 0.6 * share * kFriction * kPressure, q2 = -0.8 * share * kFriction * kPressure;
    const Returned r = returned({kFriction, {}}, q1, q2);
    const bool slips = return_to_coulomb_disc(kFriction, kPressure, q1, q2);
    EXPECT_EQ(r.q1, q1);
    EXPECT_EQ(r.q2, q2);
    EXPECT_EQ(r.law.slips, slips);
  }
}

// |q| = tau_c0 + k u_pl with u_pl the path that the excess of the traction leaves, until friction takes over.
TEST(FrictionStep, OfAFilmThatHardensAddsToItsPathUntilTheSurfacesSlide) {
  const double hardening = 1e14;  // Pa/m
  const FrictionLaws laws = film(hardening);
  double plastic = 0;
  for (int step = 0; step < 5; ++step) {
    const double stick = 105e6 + hardening * plastic;
    const Returned r = returned(laws, 0, stick, plastic);
    ASSERT_TRUE(r.law.slips);
    EXPECT_GT(r.law.plastic, plastic);
    EXPECT_NEAR(r.size(), 100e6 + hardening * r.law.plastic, 1.0);
    EXPECT_NEAR(r.law.plastic - plastic, kCompliance * kStep * (stick - r.size()), 1e-18);
    plastic = r.law.plastic;
  }
  const Returned sliding = returned(laws, 1e15, 0, plastic);
  EXPECT_NEAR(sliding.size(), kFriction * kPressure, 1.0);
  EXPECT_NEAR(sliding.law.plastic, (kFriction * kPressure - 100e6) / hardening, 1e-15);
}

TEST(FrictionStep, OfAFilmBelowItsYieldShearSticks) {
  const Returned r = returned(film(0), 60e6, 79e6, 3e-6);
  EXPECT_FALSE(r.law.slips);
  EXPECT_EQ(r.q1, 60e6);
  EXPECT_EQ(r.law.plastic, 3e-6);
  EXPECT_NEAR(returned(film(0), 600e6, 800e6).size(), 100e6, 1e-3);
}

// A film stronger than friction never yields.
TEST(FrictionStep, OfAStrongFilmIsFrictions) {
  FrictionLaws laws = film(0);
  laws.film.yield_shear = 1e9;
  const Returned r = returned(laws, 3e9, 4e9);
  EXPECT_NEAR(r.size(), kFriction * kPressure, 1e-3);
  EXPECT_EQ(r.law.plastic, 0);
}

// On the ellipse, with the excess along its normal (q1, q2/share²); inside it sticks, and without pressure nothing is
// carried.
TEST(FrictionStep, OfAnEllipseSlipsAlongItsNormal) {
  FrictionLaws laws{kFriction, {}};
  for (double share : {0.2, 0.7, 1.6})
    for (double turn = 0.1; turn < 6.3; turn += 0.3)
      for (double far : {1 + 1e-12, 1.001, 3.0, 1e6}) {
        laws.lateral_share = share;
        const double limit = kFriction * kPressure, trial1 = far * limit * std::cos(turn),
                     trial2 = far * share * limit * std::sin(turn);
        const Returned r = returned(laws, trial1, trial2);
        EXPECT_TRUE(r.law.slips);
        EXPECT_NEAR(std::hypot(r.q1, r.q2 / share), limit, 1e-12 * limit);
        const double slip1 = trial1 - r.q1, slip2 = trial2 - r.q2, normal2 = r.q2 / (share * share);
        EXPECT_NEAR(slip1 * normal2 - slip2 * r.q1, 0, 1e-9 * far * limit * limit / (share * share)) << share << far;
        EXPECT_GE(slip1 * r.q1 + slip2 * normal2, 0);
        EXPECT_FALSE(returned(laws, 0.99 / far * trial1, 0.99 / far * trial2).law.slips);
      }
  double q1 = 1, q2 = 2;
  EXPECT_TRUE(return_to_law(laws, {0, kCompliance, kStep, 0}, q1, q2).slips);
  EXPECT_EQ(std::hypot(q1, q2), 0);
}

}  // namespace railstrata
