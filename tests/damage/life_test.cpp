#include "damage/life.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace railstrata {
namespace {

constexpr double kDeep = 1;  // m, more than any depth here

DamagedPlace uniform(double rate, double skin) {
  return {.depth = {0, skin}, .kinds = {{.wheels = 1, .rate = {rate, rate}}}, .top = 0, .bottom = kDeep};
}

// used = 1.25 at k = 5: 1e6 / 3.05; below the limit 0.8 gives 1e6 * 3.05 by the same slope, 1e6 * 1.25^9 by 2k - 1.
TEST(Life, CyclesOfASigmaNLine) {
  const SigmaN line{5, 1e6};
  EXPECT_NEAR(cycles_to_failure(1.25, line, BelowLimit::endures), 1e6 / 3.0517578125, 1);
  EXPECT_NEAR(cycles_to_failure(0.8, line, BelowLimit::as_above), 1e6 * 3.0517578125, 1);
  EXPECT_NEAR(cycles_to_failure(0.8, line, BelowLimit::flatter), 1e6 * std::pow(1.25, 9), 1);
  EXPECT_TRUE(std::isinf(cycles_to_failure(0.8, line, BelowLimit::endures)));
  EXPECT_TRUE(std::isinf(cycles_to_failure(-0.1, line, BelowLimit::as_above)));
}

// 3 wheels of 1/300 and 2 of 1/50 a unit: 0.01 + 0.04, so 20 units.
TEST(Life, TwoKindsOfWheelsAddUp) {
  const DamagedPlace place{
      .depth = {0, 1e-3},
      .kinds = {{.wheels = 3, .rate = {1.0 / 300, 0}}, {.wheels = 2, .rate = {1.0 / 50, 1.0 / 50}}},
      .top = 0,
      .bottom = kDeep};
  const Failure surface = first_failure(place, {}, 0, 0.5e-3), below = first_failure(place, {}, 0.5e-3, kDeep);
  EXPECT_NEAR(surface.traffic, 20, 1e-9);
  EXPECT_EQ(surface.depth, 0);
  EXPECT_NEAR(below.traffic, 25, 1e-9);
  EXPECT_EQ(below.depth, 1e-3);
}

// A skin of rate r: slower than its removal 1/r, and never once wear goes through it in less.
TEST(Life, WearAgainstAUniformSkin) {
  const double rate = 0.01, skin = 1e-3;
  const DamagedPlace place = uniform(rate, skin);
  EXPECT_NEAR(first_failure(place, {.wear = 0.5 * rate * skin}, 0, kDeep).traffic, 100, 1);
  EXPECT_NEAR(first_failure(place, {.wear = 0.98 * rate * skin}, 0, kDeep).traffic, 100, 2);
  EXPECT_TRUE(std::isinf(first_failure(place, {.wear = 1.02 * rate * skin}, 0, kDeep).traffic));
}

// A point below the skin comes into it at (z0 - skin)/w and fails 1/rate later, while it is still in it.
TEST(Life, PointsOfAUniformSkinFailAsTheyComeUp) {
  const double rate = 0.01, skin = 1e-3, wear = 0.5 * rate * skin, end = 800;
  const std::map<double, double> when = failures_until(uniform(rate, skin), {.wear = wear}, end);
  EXPECT_GT(when.size(), 100U);
  for (const auto& [depth, failed] : when) {
    EXPECT_GE(depth, wear * failed - 1e-9) << "it is still there";
    if (depth > wear * (end - 1 / rate)) continue;
    EXPECT_NEAR(failed, std::max(0.0, depth - skin) / wear + 1 / rate, 5) << depth;
  }
}

// rate exp(-z/l): D at the surface after t is rate l/w (1 - exp(-w t/l)), so t = -l/w ln(1 - w/(rate l)).
TEST(Life, WearAgainstDamageThatFallsWithDepth) {
  const double rate = 0.01, l = 1e-3;
  DamagedPlace place{.depth = {}, .kinds = {{.rate = {}}}, .top = 0, .bottom = kDeep};
  for (int j = 0; j <= 200; ++j) {
    place.depth.push_back(0.05 * j * l);
    place.kinds[0].rate.push_back(rate * std::exp(-0.05 * j));
  }
  for (const double share : {0.01, 0.3, 0.7, 0.9}) {
    const double expected = -std::log(1 - share) / (share * rate);
    EXPECT_NEAR(first_failure(place, {.wear = share * rate * l}, 0, kDeep).traffic / expected, 1, 0.02) << share;
  }
  EXPECT_TRUE(std::isinf(first_failure(place, {.wear = 1.02 * rate * l}, 0, kDeep).traffic));
  EXPECT_LT(first_failure(place, {.wear = 0.3 * rate * l}, 0, kDeep).depth, 0.05e-3);
}

TEST(Life, WearFasterThanTheMagicRateLeavesTheLayerNothing) {
  DamagedPlace place = uniform(0.01, 2e-3);
  place.bottom = 0.5e-3;  // worn through after 50 units, before any point has seen 100
  EXPECT_TRUE(std::isinf(first_failure(place, {.wear = 1e-5}, 0, kDeep).traffic));
  EXPECT_NEAR(first_failure(place, {.wear = 4e-6}, 0, kDeep).traffic, 100, 1);
}

// 0.3 mm after every 10 units over a skin of 0.25 mm: no point stays in it longer than 10 units.
TEST(Life, GrindingTakesTheSkinAway) {
  const DamagedPlace place = uniform(0.05, 0.25e-3);
  const Removal grinding{.wear = 0, .depth = 0.3e-3, .every = 10};
  EXPECT_NEAR(first_failure(place, {}, 0, kDeep).traffic, 20, 1e-9);
  EXPECT_TRUE(std::isinf(first_failure(place, grinding, 0, kDeep).traffic));
  EXPECT_NEAR(first_failure(place, {.wear = 0, .depth = 0.3e-3, .every = 25}, 0, kDeep).traffic, 20, 0.2);
}

TEST(Life, RemovalByWearAndGrinding) {
  const Removal r{.wear = 1e-5, .depth = 1e-4, .every = 10};
  EXPECT_NEAR(r.after(25), 4.5e-4, 1e-15);
  EXPECT_NEAR(r.until(4.5e-4), 25, 1e-9);
  EXPECT_NEAR(r.until(3.5e-4), 20, 1e-9);  // 3e-4 worn and ground before the second grinding, 4e-4 after it
  EXPECT_TRUE(std::isinf(Removal{}.until(1e-3)));
}

}  // namespace
}  // namespace railstrata
