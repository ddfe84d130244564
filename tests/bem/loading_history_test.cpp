// Contact that remembers: shifts there and back, transient rolling of dissimilar and layered bodies.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "bem/rolling_contact.hpp"
#include "half_space_pair.hpp"
#include "halfspace/layered.hpp"
#include "tests/halfspace/classical_rolling.hpp"

namespace railstrata {
namespace {

double largest_difference(const TangentialSolution& a, const TangentialSolution& b) {
  double d = 0;
  for (std::size_t i = 0; i < a.q_x.size(); ++i) d = std::max(d, std::hypot(a.q_x[i] - b.q_x[i], a.q_y[i] - b.q_y[i]));
  return d;
}
double largest_difference(const Plane& a, const Plane& b) {
  double d = 0;
  for (std::size_t i = 0; i < a.size(); ++i) d = std::max(d, std::abs(a[i] - b[i]));
  return d;
}

/// A steel wheel on a rail of any build, 60 kN on a patch of about 6 mm x 4 mm.
struct WheelOn {
  static constexpr double kLoad = 6e4, kFriction = 0.4;
  PatchGrid grid = grid_around(6.8e-3, 4.8e-3, 0.6e-3, 0.6e-3);
  InfluenceOperator influence;
  HertzGap gap;
  explicit WheelOn(const LayeredHalfSpace& rail)
      : influence(combined_compliance(homogeneous_compliance(kSteel), layered_compliance(rail)), grid.nx, grid.ny,
                  grid.dx, grid.dy),
        gap(hertz_gap(6e-3, 4e-3, contact_modulus(kSteel, rail.substrate), kLoad)) {}
  RollingContact contact() const {
    RollingContact c;
    c.gap = quadratic_gap(grid, gap.A, gap.B);
    c.target.load = kLoad;
    c.friction = kFriction;
    return c;
  }
  /// A shift by the same forces (by none where creepages are given), then `steps` cells of rolling.
  RollingSolution roll(const RollingContact& rolling, int steps) const {
    RollingContact c = rolling;
    c.kind = RollingKind::shift;
    c.x.creepage = c.y.creepage = c.spin = 0;
    return roll_on(rolling, solve_rolling(influence, grid, c), steps);
  }
  RollingSolution roll_on(RollingContact c, RollingSolution s, int steps) const {
    for (int i = 0; i < steps; ++i) {
      roll_on_one_cell(influence, grid, s, c);
      s = solve_rolling(influence, grid, c, {}, &s);
    }
    return s;
  }
};
const LayeredHalfSpace kSoftRail{{}, {100e9, 0.15}}, kStiffLayer{{{1e-3, {840e9, 0.3}}}, kSteel},
    kSoftLayer{{{1e-3, {52.5e9, 0.3}}}, kSteel};

// Exact for nu = 0 like Cattaneo's solution: what is taken back slips with 2 f against the state before. [Johnson1985
// sec. 7.4]
TEST(Shift, ThereAndBackFollowsMindlinsAndDeresiewiczsLoop) {
  const HalfSpaceMaterial body{200e9, 0.0};
  const double P = 6e4, f = 0.3, top = 0.8 * f * P, d = 0.2e-3;
  const HertzGap gap = hertz_gap(5e-3, 5e-3, contact_modulus(body, body), P);
  const HertzContact hertz = hertz_contact(gap.A, gap.B, contact_modulus(body, body), P);
  const PatchGrid g = grid_around(5e-3, 5e-3, d, d);
  const InfluenceOperator op(pair_of(body, body), g.nx, g.ny, g.dx, g.dy);
  RollingContact c;
  c.gap = quadratic_gap(g, gap.A, gap.B);
  c.target.load = P;
  c.friction = f;
  c.kind = RollingKind::shift;
  c.y.force = top;
  RollingSolution s = solve_rolling(op, g, c);
  const TangentialSolution first = s.tangential;
  const CattaneoShift there = cattaneo_shift(hertz, f, top, body, body);
  double shift = s.tangential.creepage_y;
  EXPECT_NEAR(shift / there.shift, 1, 1e-3);
  const auto follow = [&](double force, double sign) {
    const CattaneoShift back = cattaneo_shift(hertz, f, 0.5 * (top - sign * force), body, body);
    shift_on(op, g, s, c);
    c.y.force = force;
    s = solve_rolling(op, g, c, {}, &s);
    shift += s.tangential.creepage_y;
    EXPECT_NEAR(shift, sign * (there.shift - 2 * back.shift), 1e-3 * there.shift) << force / top;
    double worst = 0;
    for (int i = 0; i < g.nx; ++i)
      for (int j = 0; j < g.ny; ++j) {
        const double r = std::hypot(g.x(i), g.y(j));
        if (r > hertz.a - 3 * d || std::abs(r - there.stick_radius) < 3 * d || std::abs(r - back.stick_radius) < 3 * d)
          continue;
        const double exact = sign * (cattaneo_traction(hertz, f, there.stick_radius, r) -
                                     2 * cattaneo_traction(hertz, f, back.stick_radius, r));
        worst = std::max(worst, std::abs(s.tangential.q_y[g.index(i, j)] - exact));
      }
    EXPECT_LT(worst, 2e-3 * f * hertz.p0) << force / top;
  };
  for (double part : {0.3, -0.2, -1.0}) follow(part * top, 1);
  for (double part : {0.5, 1.0}) follow(part * top, -1);
  EXPECT_LT(largest_difference(s.tangential, first), 1e-3 * f * hertz.p0) << "the loop closes";
}

class TransientRollingOfCoupledBodies : public testing::TestWithParam<const LayeredHalfSpace*> {};

TEST_P(TransientRollingOfCoupledBodies, ArrivesAtTheSteadyStateForForcesCreepagesAndBoth) {
  const WheelOn w(*GetParam());
  const double half = 0.5 * w.kFriction * w.kLoad;
  const std::function<void(RollingContact&)> drives[] = {
      [&](RollingContact& c) { c.x.force = -half; },
      [&](RollingContact& c) { c.y.force = half; },
      [&](RollingContact& c) {
        c.x.force = -0.3 * half;
        c.y.force = 0.6 * half;
        c.spin = 0.1;
      },
      [&](RollingContact& c) {
        c.x.creepage = -1e-3;
        c.y.force = 0.4 * half;
      },
      [&](RollingContact& c) {
        c.x.creepage = -1e-3;
        c.y.creepage = 5e-4;
        c.spin = 0.1;
      },
  };
  int which = 0;
  for (const auto& drive : drives) {
    RollingContact c = w.contact();
    drive(c);
    const RollingSolution steady = solve_rolling(w.influence, w.grid, c), near = w.roll(c, 32),
                          there = w.roll_on(c, near, 64);
    const double q = w.kFriction * peak(steady.normal.pressure);
    EXPECT_LT(largest_difference(there.tangential, steady.tangential),
              0.1 * largest_difference(near.tangential, steady.tangential))
        << which;
    EXPECT_LT(largest_difference(there.tangential, steady.tangential), 2e-3 * q) << which;
    EXPECT_LT(largest_difference(there.normal.pressure, steady.normal.pressure), 1e-4 * peak(steady.normal.pressure))
        << which;
    EXPECT_GT(largest_difference(near.normal.pressure, solve_normal(w.influence, w.grid, c.gap, c.target).pressure),
              1e-3 * peak(steady.normal.pressure))
        << "coupling is felt";
    if (c.x.force) {
      EXPECT_NEAR(there.tangential.force_x, *c.x.force, 1e-5 * half) << which;
      EXPECT_NEAR(there.tangential.creepage_x, steady.tangential.creepage_x, 1e-6) << which;
    }
    if (c.y.force) {
      EXPECT_NEAR(there.tangential.force_y, *c.y.force, 1e-5 * half) << which;
      EXPECT_NEAR(there.tangential.creepage_y, steady.tangential.creepage_y, 1e-6) << which;
    }
    ++which;
  }
}
INSTANTIATE_TEST_SUITE_P(Pair, TransientRollingOfCoupledBodies, testing::Values(&kSoftRail, &kStiffLayer, &kSoftLayer));

TEST(TransientRolling, OfCoupledBodiesMirrorsWithTheLateralForceAndTheSpin) {
  const WheelOn w(kSoftRail);
  RollingContact c = w.contact();
  c.x.force = -4e3;
  c.y.force = 5e3;
  c.spin = 0.1;
  const RollingSolution left = w.roll(c, 8);
  c.y.force = -5e3;
  c.spin = -0.1;
  const RollingSolution right = w.roll(c, 8);
  EXPECT_NEAR(left.tangential.creepage_y, -right.tangential.creepage_y, 1e-7);
  for (int i = 0; i < w.grid.nx; ++i)
    for (int j = 0; j < w.grid.ny; ++j) {
      const std::size_t k = w.grid.index(i, j), m = w.grid.index(i, w.grid.ny - 1 - j);
      EXPECT_NEAR(left.normal.pressure[k], right.normal.pressure[m], 1e-5 * peak(left.normal.pressure));
      EXPECT_NEAR(left.tangential.q_x[k], right.tangential.q_x[m], 1e-5 * peak(left.normal.pressure));
      EXPECT_NEAR(left.tangential.q_y[k], -right.tangential.q_y[m], 1e-5 * peak(left.normal.pressure));
    }
}

// The layered path with images and coupling, on a body that is all but homogeneous: nothing may be left of the layer.
TEST(TransientRolling, OnALayerOfTheRailsOwnSteelIsThatOnTheBareRail) {
  const WheelOn bare({{}, kSteel}), layered({{{1e-3, {kSteel.young * (1 + 1e-9), kSteel.poisson}}}, kSteel});
  ASSERT_FALSE(bare.influence.couples());
  ASSERT_TRUE(layered.influence.couples());
  RollingContact c = bare.contact();
  c.x.force = -6e3;
  c.y.force = 3e3;
  c.spin = 0.05;
  const RollingSolution a = bare.roll(c, 10), b = layered.roll(c, 10);
  EXPECT_LT(largest_difference(a.normal.pressure, b.normal.pressure), 1e-5 * peak(a.normal.pressure));
  EXPECT_LT(largest_difference(a.tangential, b.tangential), 1e-4 * peak(a.normal.pressure));
  EXPECT_NEAR(a.tangential.creepage_x, b.tangential.creepage_x, 1e-7);
}

TEST(TransientRolling, OnAThickLayerIsThatOnAHalfSpaceOfItsMaterial) {
  const HalfSpaceMaterial stiff{420e9, 0.2};
  const LayeredHalfSpace thick{{{20.0, stiff}}, kSteel};  // 3000 times the patch
  const WheelOn a({{}, stiff});
  const InfluenceOperator on_layer(combined_compliance(homogeneous_compliance(kSteel), layered_compliance(thick)),
                                   a.grid.nx, a.grid.ny, a.grid.dx, a.grid.dy);
  RollingContact c = a.contact();
  c.kind = RollingKind::shift;
  c.x.force = -8e3;
  RollingSolution on_half_space = solve_rolling(a.influence, a.grid, c), on_thick = solve_rolling(on_layer, a.grid, c);
  RollingContact d = c;
  for (int i = 0; i < 10; ++i) {
    roll_on_one_cell(a.influence, a.grid, on_half_space, c);
    roll_on_one_cell(on_layer, a.grid, on_thick, d);
    on_half_space = solve_rolling(a.influence, a.grid, c, {}, &on_half_space);
    on_thick = solve_rolling(on_layer, a.grid, d, {}, &on_thick);
  }
  EXPECT_LT(largest_difference(on_half_space.normal.pressure, on_thick.normal.pressure),
            1e-4 * peak(on_half_space.normal.pressure));
  EXPECT_LT(largest_difference(on_half_space.tangential, on_thick.tangential),
            1e-4 * peak(on_half_space.normal.pressure));
}

}  // namespace
}  // namespace railstrata
