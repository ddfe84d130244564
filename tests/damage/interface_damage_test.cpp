#include "damage/interface_damage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "tests/damage/hertz_stress.hpp"

namespace railstrata {
namespace {

/// A line contact with rows twice at every depth.
StressHistory doubled(const std::vector<double>& depths, double friction = 0) {
  std::vector<double> rows{0};
  for (double d : depths) rows.insert(rows.end(), {d, d});
  return testing::history_of(testing::LineLoad{.friction = friction}, testing::rolling_samples(0.02), {0}, rows);
}

// Without friction the range of orthogonal shear is largest, p0/2, at 0.5 a.
TEST(InterfaceDamage, ShearRangeOfALineContactIsHalfThePressureAtHalfAHalfLength) {
  const auto all = interface_damage(doubled({0.3, 0.5, 0.7}), {});
  ASSERT_EQ(all.size(), 3u);
  EXPECT_NEAR(all[1].shear_range, 0.5, 0.5 * 2e-3);
  EXPECT_LT(all[0].shear_range, all[1].shear_range);
  EXPECT_LT(all[2].shear_range, all[1].shear_range);
  EXPECT_EQ(all[1].row_above, 3);
  EXPECT_DOUBLE_EQ(all[1].depth, 0.5);
  EXPECT_LT(all[1].tension, 1e-12) << "no tension under a wheel";
}

TEST(InterfaceDamage, TakesBothSidesAndTheIndexAtOneTime) {
  StressHistory h{.x = {0, 1}, .y = {0, 1}, .depth = {0, 1e-3, 1e-3, 2e-3}, .zone = {1, 1, 0, 0}, .stress = {}};
  h.stress.resize(16);
  // column 0: tension at one time, shear at another; column 1: shear across and along
  h.cycle(1, 0)[0] = {.xx = 900e6, .yy = -40e6, .zz = 30e6};
  h.cycle(2, 0)[0] = {.xx = 200e6, .yy = -10e6, .zz = 30e6};
  h.cycle(1, 0)[1] = h.cycle(2, 0)[1] = {.zz = -500e6, .xz = 60e6};
  h.cycle(1, 1)[0] = {.yz = 40e6, .xz = -30e6};
  h.cycle(2, 1)[0] = {.yz = 40e6, .xz = -34e6};
  const std::vector<BondStrength> bond{{100e6, 120e6}};
  const auto one = interface_damage(h, {}, bond);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_DOUBLE_EQ(one[0].tension, 30e6);
  EXPECT_DOUBLE_EQ(one[0].shear, 60e6);
  EXPECT_NEAR(one[0].delamination, 0.25, 1e-12) << "(60/120)² at the second time; compression does not count";
  EXPECT_DOUBLE_EQ(one[0].shear_range, 60e6) << "in column 0, at the other times nothing";
  EXPECT_DOUBLE_EQ(one[0].xx_range[0], 900e6);
  EXPECT_DOUBLE_EQ(one[0].xx_range[1], 200e6);
  EXPECT_EQ(interface_damage(h, {})[0].delamination, 0) << "no strength, no index";
}

TEST(InterfaceDamage, ResidualStressCountsInTensionAndInNoRange) {
  const StressHistory h = doubled({0.5});
  const std::vector<Sym3> residual{{}, {.xx = 0.4, .zz = 3}, {.xx = -0.1, .zz = 3}};
  const auto with = interface_damage(h, residual), without = interface_damage(h, {});
  EXPECT_NEAR(with[0].tension, 3, 0.02) << "far from the load";
  EXPECT_NEAR(with[0].xx_range[0], without[0].xx_range[0], 1e-12);
  EXPECT_NEAR(with[0].xx_range[1], without[0].xx_range[1], 1e-12);
  EXPECT_EQ(with[0].shear_range, without[0].shear_range);
}

TEST(InterfaceDamage, StrengthsThatDoNotFitAreRefused) {
  const StressHistory h = doubled({0.3, 0.5});
  EXPECT_THROW(interface_damage(h, {}, std::vector<BondStrength>{{1, 1}}), std::invalid_argument);
  EXPECT_THROW(interface_damage(h, {}, std::vector<BondStrength>{{1, 1}, {0, 1}}), std::invalid_argument);
}

}  // namespace
}  // namespace railstrata
