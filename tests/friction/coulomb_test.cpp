#include "friction/coulomb.hpp"

#include <gtest/gtest.h>

namespace railstrata {
namespace {

constexpr double kFriction = 0.3, kPressure = 1e9, kRadius = kFriction * kPressure;

struct Returned {
  double q1, q2;
  bool slips;
};
Returned returned(double q1, double q2, double p = kPressure, double friction = kFriction) {
  const bool slips = return_to_coulomb_disc(friction, p, q1, q2);
  return {q1, q2, slips};
}

}  // namespace

TEST(CoulombDisc, LeavesATractionInsideOrOnTheCircleAsItIs) {
  for (double share : {0.0, 0.3, 1.0}) {
    const Returned r = returned(0.6 * share * kRadius, -0.8 * share * kRadius);
    EXPECT_EQ(r.q1, 0.6 * share * kRadius);
    EXPECT_EQ(r.q2, -0.8 * share * kRadius);
    EXPECT_FALSE(r.slips);
  }
}

// The nearest point of a disc to a point outside lies on the line to the centre.
TEST(CoulombDisc, ShortensATractionOutsideToTheCircleInItsOwnDirection) {
  for (double angle = 0; angle < 6.3; angle += 0.37)
    for (double share : {1.0001, 1.5, 1e6}) {
      const double c = std::cos(angle), s = std::sin(angle);
      const Returned r = returned(share * kRadius * c, share * kRadius * s);
      EXPECT_NEAR(r.q1, kRadius * c, 1e-14 * kRadius) << angle;
      EXPECT_NEAR(r.q2, kRadius * s, 1e-14 * kRadius) << angle;
      EXPECT_TRUE(r.slips);
    }
}

// Returned twice is returned once: the circle belongs to the disc but for the last bit of the length.
TEST(CoulombDisc, ReturnIsAProjection) {
  const Returned once = returned(1.7 * kRadius, -0.4 * kRadius), twice = returned(once.q1, once.q2);
  EXPECT_NEAR(twice.q1, once.q1, 1e-15 * kRadius);
  EXPECT_NEAR(twice.q2, once.q2, 1e-15 * kRadius);
}

TEST(CoulombDisc, WithoutPressureOrFrictionCarriesNothing) {
  for (const auto& [p, friction] : {std::pair{0.0, kFriction}, std::pair{-1e6, kFriction}, std::pair{kPressure, 0.0}}) {
    const Returned r = returned(3e6, 4e6, p, friction), none = returned(0, 0, p, friction);
    EXPECT_EQ(r.q1, 0);
    EXPECT_EQ(r.q2, 0);
    EXPECT_TRUE(r.slips);
    EXPECT_FALSE(none.slips);
  }
}

}  // namespace railstrata
