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
  EXPECT_NEAR(all[1].point[0].shear_x.range(), 0.5, 0.5 * 2e-3);
  EXPECT_NEAR(all[1].point[0].shear_x.low, -0.25, 0.25 * 2e-3);
  EXPECT_LT(all[0].point[0].shear_x.range(), all[1].point[0].shear_x.range());
  EXPECT_LT(all[2].point[0].shear_x.range(), all[1].point[0].shear_x.range());
  EXPECT_EQ(all[1].row_above, 3);
  EXPECT_DOUBLE_EQ(all[1].depth, 0.5);
  EXPECT_EQ(all[1].point[0].traction_jump, 0);
  EXPECT_LT(all[1].point[0].tension, 1e-12) << "no tension under a wheel";
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
  const InterfacePoint& p = one[0].point[0];
  EXPECT_DOUBLE_EQ(p.tension, 30e6);
  EXPECT_DOUBLE_EQ(p.shear, 60e6);
  EXPECT_NEAR(p.delamination, 0.25, 1e-12) << "(60/120)² at the second time; compression does not count";
  EXPECT_DOUBLE_EQ(p.xx[0].high, 900e6);
  EXPECT_DOUBLE_EQ(p.xx[1].high, 200e6);
  EXPECT_DOUBLE_EQ(p.yy[0].low, -40e6);
  EXPECT_EQ(one[0].most_shear, 0);
  EXPECT_EQ(one[0].most_tension, 0);
  EXPECT_NEAR(one[0].point[1].shear, std::hypot(40e6, 32e6), 1);
  EXPECT_NEAR(one[0].point[1].traction_jump, 4e6, 1);
  EXPECT_EQ(interface_damage(h, {})[0].point[0].delamination, 0) << "no strength, no index";
}

TEST(InterfaceDamage, ResidualStressStandsOnItsOwnSide) {
  const StressHistory h = doubled({0.5});
  const std::vector<Sym3> residual{{}, {.xx = 0.4, .yy = 0.3}, {.xx = -0.1}};
  const auto with = interface_damage(h, residual), without = interface_damage(h, {});
  EXPECT_NEAR(with[0].point[0].xx[0].high - without[0].point[0].xx[0].high, 0.4, 1e-12);
  EXPECT_NEAR(with[0].point[0].xx[1].low - without[0].point[0].xx[1].low, -0.1, 1e-12);
  EXPECT_EQ(with[0].point[0].shear_x.range(), without[0].point[0].shear_x.range());
}

TEST(InterfaceDamage, StrengthsThatDoNotFitAreRefused) {
  const StressHistory h = doubled({0.3, 0.5});
  EXPECT_THROW(interface_damage(h, {}, std::vector<BondStrength>{{1, 1}}), std::invalid_argument);
  EXPECT_THROW(interface_damage(h, {}, std::vector<BondStrength>{{1, 1}, {0, 1}}), std::invalid_argument);
}

}  // namespace
}  // namespace railstrata
