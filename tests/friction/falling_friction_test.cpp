#include "friction/falling_friction.hpp"

#include <gtest/gtest.h>

namespace railstrata {
namespace {

constexpr double kShare = 0.4, kHalf = 0.8;
const FallingFriction kLaws[] = {{FrictionForm::falling_exponential, kShare, kHalf},
                                 {FrictionForm::falling_rational, kShare, kHalf}};

TEST(FallingFriction, FallsFromRestToItsLimitAndHasDoneHalfAtTheHalfValueVelocity) {
  for (const FallingFriction& law : kLaws) {
    EXPECT_EQ(friction_share(law, 0).value, 1);
    EXPECT_DOUBLE_EQ(friction_share(law, kHalf).value, 0.5 * (1 + kShare));
    EXPECT_NEAR(friction_share(law, 1e9 * kHalf).value, kShare, 1e-8);
  }
  EXPECT_DOUBLE_EQ(friction_share(kLaws[0], 3 * kHalf).value, kShare + (1 - kShare) / 8);
  EXPECT_DOUBLE_EQ(friction_share(kLaws[1], 3 * kHalf).value, kShare + (1 - kShare) / 4);
}

// Polach's form f_0 ((1 - A) e^(-B v) + A) is the exponential one with B = ln 2/v_half.
TEST(FallingFriction, ExponentialFormIsPolachs) {
  const double A = 0.4, B = 0.6;
  const FallingFriction law{FrictionForm::falling_exponential, A, std::numbers::ln2 / B};
  for (double v : {0.0, 0.3, 2.0, 10.0})
    EXPECT_NEAR(friction_share(law, v).value, (1 - A) * std::exp(-B * v) + A, 1e-15);
}

TEST(FallingFriction, DerivativeIsTheSlopeAndNeverRises) {
  for (const FallingFriction& law : kLaws)
    for (double v : {0.0, 0.1, 0.8, 5.0}) {
      const double h = 1e-5, slope = (friction_share(law, v + 2 * h).value - friction_share(law, v).value) / (2 * h);
      EXPECT_NEAR(friction_share(law, v + h).by_slip_velocity / slope, 1, 1e-8);
      EXPECT_LT(slope, 0);
    }
}

TEST(FallingFriction, CoulombsIsTheSameForEverySlip) {
  for (const FallingFriction& law : {FallingFriction{}, FallingFriction{FrictionForm::falling_rational, 1, 0.5}}) {
    EXPECT_FALSE(law.falls());
    for (double v : {0.0, 1.0, 100.0}) {
      EXPECT_EQ(friction_share(law, v).value, 1);
      EXPECT_EQ(friction_share(law, v).by_slip_velocity, 0);
    }
  }
}

}  // namespace
}  // namespace railstrata
