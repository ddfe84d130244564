#include "damage/metal_damage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace railstrata {
namespace {

/// 1e-6 a wheel from the surface to 1 mm, where it ends.
DepthRate flat() { return {{0.1e-3, 1e-3}, {1e-6, 1e-6}, true}; }

TEST(MetalDamage, WithoutWearFailsAfterOneOverTheRate) {
  double damage = 0;
  EXPECT_FALSE(gather(flat(), {.traffic = 4e5, .before = 0, .after = 0}, 0.5e-3, damage));
  EXPECT_NEAR(damage, 0.4, 1e-12);
  const std::optional<DamageReached> reached =
      gather(flat(), {.traffic = 1e6, .before = 0, .after = 0}, 0.5e-3, damage);
  ASSERT_TRUE(reached);
  EXPECT_NEAR(reached->share, 0.6, 1e-12);
  EXPECT_NEAR(reached->depth, 0.5e-3, 1e-15);
  EXPECT_FALSE(gather(flat(), {.traffic = 1e6, .before = 0, .after = 0}, 0.5e-3, damage)) << "it failed before";
}

TEST(MetalDamage, WearBringsAPointThroughTheTable) {
  // rate r (1 - z/h) and wear w a wheel: a point that comes from below h has r h/(2 w) when it reaches the surface
  constexpr double r = 1e-6, h = 1e-3, w = 1e-9;
  const DepthRate rate({0, h}, {r, 0}, true);
  double damage = 0;
  for (int step = 0; step < 40; ++step) {
    const double before = step * 0.05e-3;
    gather(rate, {.traffic = 0.05e-3 / w, .before = before, .after = before + 0.05e-3}, 1.5e-3, damage);
  }
  EXPECT_NEAR(damage / (r * h / (2 * w)), 1, 1e-9);
}

TEST(MetalDamage, CutsOfAStepGiveTheSame) {
  const DepthRate rate({0.1e-3, 0.3e-3, 0.8e-3}, {3e-6, 5e-6, 1e-6}, true);
  double whole = 0, cut = 0;
  gather(rate, {.traffic = 1e5, .before = 0, .after = 0.4e-3}, 0.6e-3, whole);
  for (int k = 0; k < 7; ++k)
    gather(rate, {.traffic = 1e5 / 7, .before = 0.4e-3 * k / 7, .after = 0.4e-3 * (k + 1) / 7}, 0.6e-3, cut);
  EXPECT_NEAR(cut / whole, 1, 1e-12);
}

TEST(MetalDamage, WhatIsGroundOffGathersNoMore) {
  double damage = 0;
  EXPECT_FALSE(gather(flat(), {.traffic = 0, .before = 0, .after = 0.2e-3}, 0.1e-3, damage)) << "grinding";
  EXPECT_FALSE(gather(flat(), {.traffic = 1e9, .before = 0.2e-3, .after = 0.2e-3}, 0.1e-3, damage));
  EXPECT_EQ(damage, 0);
  // worn off within the step: half of its traffic
  const std::optional<DamageReached> reached =
      gather(flat(), {.traffic = 4e6, .before = 0.2e-3, .after = 0.6e-3}, 0.4e-3, damage);
  ASSERT_TRUE(reached);
  EXPECT_NEAR(damage, 2, 1e-12);
  EXPECT_NEAR(reached->share, 0.25, 1e-12);
  EXPECT_NEAR(reached->depth, 0.1e-3, 1e-15);
}

TEST(MetalDamage, ALayerEndsWhereItsPointsEnd) {
  const DepthRate layer({0.5e-3, 1.5e-3}, {1e-6, 2e-6}, false), rail({0.5e-3, 1.5e-3}, {1e-6, 2e-6}, true);
  EXPECT_EQ(layer.at(1.9e-3), 2e-6);
  EXPECT_EQ(rail.at(1.9e-3), 0);
  EXPECT_NEAR(layer.until(2e-3) - layer.until(1.5e-3), 0.5e-3 * 2e-6, 1e-18);
}

}  // namespace
}  // namespace railstrata
