#include "friction/third_body.hpp"

#include <gtest/gtest.h>

namespace railstrata {
namespace {

constexpr double kMPa = 1e6, kPerMm = 1e9;  // Pa; Pa/m of MPa/mm
const ThirdBody kClay{20e-6, 106.25 * kMPa, 200 * kMPa, 435 * kPerMm}, kPlastic{20e-6, 176.63 * kMPa, 560 * kMPa, 0};

TEST(ThirdBody, IsAsFlexibleAsItsThicknessOverItsShearModulus) {
  EXPECT_DOUBLE_EQ(kClay.flexibility(), 20e-6 / 106.25e6);
  EXPECT_EQ(ThirdBody{}.flexibility(), 0);
  EXPECT_FALSE(ThirdBody{}.yields());
  EXPECT_FALSE((ThirdBody{20e-6, 1e8, 0, 0}).yields()) << "elastic";
}

// Below the friction bound the film takes the whole slip and hardens by it.
TEST(ThirdBody, HardensByItsPlasticShearWhileFrictionHolds) {
  const double friction = 630 * kMPa, slid = 0.05e-3, before = 0.1e-3;
  const FilmStep step = yield_or_slide(kClay, friction, before, slid);
  EXPECT_DOUBLE_EQ(step.bound, (200 + 435 * 0.15) * kMPa);
  EXPECT_DOUBLE_EQ(step.by_slip, 435 * kPerMm);
  EXPECT_DOUBLE_EQ(step.plastic, before + slid);
  EXPECT_EQ(yield_or_slide(kPlastic, friction, before, slid).bound, 560 * kMPa);
  EXPECT_EQ(yield_or_slide(kPlastic, friction, before, slid).plastic, before + slid);
}

// Friction's bound, reached on the way, leaves the film as it is then: the rest of the slip is friction's.
TEST(ThirdBody, SlidesWhereFrictionIsTheLowerBound) {
  const FilmStep reached = yield_or_slide(kClay, 221.75 * kMPa, 0, 1e-3);
  EXPECT_EQ(reached.bound, 221.75 * kMPa);
  EXPECT_EQ(reached.by_slip, 0);
  EXPECT_DOUBLE_EQ(reached.plastic, 0.05e-3);
  const FilmStep below = yield_or_slide(kClay, 150 * kMPa, 0.02e-3, 1e-3);
  EXPECT_EQ(below.bound, 150 * kMPa);
  EXPECT_EQ(below.plastic, 0.02e-3);
}

}  // namespace
}  // namespace railstrata
