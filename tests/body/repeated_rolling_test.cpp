// Repeated rolling of a half-plane by a Hertz pressure without friction, against an independent plane finite element
// computation (static, mean dilatation, moving load; residual stresses averaged over the middle half-widths) with the
// loads of [Bhargava1985]: p0/k = 3.5 on cells of 0.05 and 4.35 on cells of 0.1 half-widths.
#include <gtest/gtest.h>

#include "material/steels.hpp"
#include "tests/body/moving_pressure.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

struct Extremes {
  RolledHalfPlane::Row xx, yy;
  double vanishing = 0;  ///< largest |zz|, |xz|
};
Extremes extremes(RolledHalfPlane& h) {
  Extremes out{};
  for (const RolledHalfPlane::Row& row : h.residual()) {
    if (row.xx < out.xx.xx) out.xx = row;
    if (row.yy < out.yy.yy) out.yy = row;
    out.vanishing = std::max({out.vanishing, std::abs(row.zz), std::abs(row.xz)});
  }
  return out;
}

void expect_extremes(const Extremes& e, double xx, double xx_depth, double yy, double yy_depth) {
  EXPECT_NEAR(e.xx.xx / xx, 1, 0.08);
  EXPECT_NEAR(e.yy.yy / yy, 1, 0.08);
  EXPECT_NEAR(e.xx.depth, xx_depth, 0.1);
  EXPECT_NEAR(e.yy.depth, yy_depth, 0.1);
}

TEST(LongRepeatedRolling, At35TimesTheShearYieldStressSettlesInTheSecondPass) {
  MovingPressure p;
  p.p0_over_k = 3.5;
  RolledHalfPlane h(p);
  h.pass();
  expect_extremes(extremes(h), -0.304, 0.76, -0.281, 0.66);
  const double first = h.accumulated(), shift = h.surface_shift();
  EXPECT_NEAR(shift, 0.1178, 0.15 * 0.1178);
  h.pass();
  const Extremes second = extremes(h);
  expect_extremes(second, -0.304, 0.76, -0.281, 0.66);
  EXPECT_LT(second.vanishing, 0.02);
  EXPECT_LT(h.accumulated() - first, 0.05 * first);
}

// Below the limit of 4 with hardening that only moves the yield surface: the second pass finds nothing to do. Cubes of
// a third of the half-width, as a wheel's patch often has; with a plastic strain at each of the eight Gauss points they
// flowed on, by 7 % of the first pass.
TEST(RepeatedRolling, OnCoarseCubesItSettlesInTheSecondPassToo) {
  MovingPressure p;
  p.p0_over_k = 3.6;
  p.kinematic_over_k = 666.7;
  p.cell = 0.3;
  p.flatness = 1;
  RolledHalfPlane h(p);
  h.pass();
  const double first = h.accumulated();
  h.pass();
  EXPECT_GT(first, 0.1);
  EXPECT_LT(h.accumulated() - first, 0.01 * first);
}

// The cyclic law of R350HT just above shakedown and far above it, under the pressures of its rail, on cubes of a third
// of the half-width as rails have them. The stationary method, which shares only the law, flows in pass 2 by this much,
// over the depth (cells of 0.05 half-widths, eight steps of the law from cell to cell, and the tension of a body that
// is held 100 half-widths away). With a plastic strain at each of the eight Gauss points it is 7.6, 1.6 and 1.0 times
// as much.
TEST(LongRepeatedRolling, OnCoarseCubesASteelFlowsAsTheStationaryMethodSays) {
  struct Load {
    double pressure, friction, flow;
  };
  for (const Load& load : {Load{860e6, 0, 5.25e-6}, Load{920e6, 0, 7.72e-5}, Load{1000e6, 0.15, 4.05e-4}}) {
    MovingPressure p;
    p.law = hardening_set("R350HT").hardening.law;
    p.law->mu = kSteel.mu;
    p.p0_over_k = load.pressure / p.shear_yield();
    p.friction = load.friction;
    p.cell = 0.33;
    p.flatness = 1;
    p.track = 6;
    RolledHalfPlane h(p);
    h.pass();
    const double first = h.accumulated();
    h.pass();
    const double flow = (h.accumulated() - first) * p.shear_yield() / kSteel.mu;
    EXPECT_NEAR(flow, load.flow, 0.25 * load.flow) << load.pressure;
  }
}

TEST(LongRepeatedRolling, At435TimesTheShearYieldStressRatchetsAgainstTheTravel) {
  MovingPressure p;
  p.p0_over_k = 4.35;
  RolledHalfPlane h(p);
  h.pass();
  expect_extremes(extremes(h), -1.003, 0.38, -1.187, 0.38);
  const double first = h.accumulated(), shift = h.surface_shift();
  EXPECT_NEAR(shift, 0.718, 0.15 * 0.718);
  h.pass();
  expect_extremes(extremes(h), -0.952, 0.47, -1.147, 0.47);
  EXPECT_GT(h.accumulated() - first, 0.1 * first);
  EXPECT_NEAR(h.surface_shift() - shift, -0.156, 0.25 * 0.156);
}

// The reference's stresses, -1.240 and -1.321, are those of cells of 0.2 half-widths: the stationary method, which
// shares only the law with these elements, has -1.266 and -1.313 with such cells, but -1.36, -1.42, -1.44 and -1.40,
// -1.43, -1.46 with halves, quarters and eighths of them. What elements must come to is therefore -1.45 and -1.47, with
// the reference's own tolerance. What is left of the flow falls from pass to pass. In pass 4 the reference has -0.024;
// the stationary method with the law in 16 steps from cell to cell and the tension of a body that is held 100
// half-widths away -0.048 with these cells (-0.041, -0.036, -0.034 with halves, quarters, eighths); these elements
// -0.044 with cells of half the size, and on a track twice as long -0.135 and -0.049 in passes 3 and 4 (stationary
// -0.141, -0.048). Those with a plastic strain at each of their eight Gauss points had -0.033, and -0.041 with cells of
// half the size.
TEST(LongRepeatedRolling, WithLinearKinematicHardeningItAlternatesForEverAndStopsToFlow) {
  MovingPressure p;
  p.p0_over_k = 5;
  p.kinematic_over_k = 666.7;  // 0.2667 G: there 66.67 with G/k = 250, here it is 2500
  p.cell = 0.2;
  p.track = 8;
  RolledHalfPlane h(p);
  double shift[5] = {}, accumulated[5] = {};
  for (int pass = 1; pass <= 4; ++pass) {
    h.pass();
    shift[pass] = h.surface_shift();
    accumulated[pass] = h.accumulated();
  }
  const Extremes left = extremes(h);
  expect_extremes(left, -1.45, 0.28, -1.47, 0.27);
  const double third = accumulated[3] - accumulated[2], fourth = accumulated[4] - accumulated[3];
  EXPECT_NEAR(fourth, third, 0.03 * third);
  EXPECT_GT(fourth, 0.5 * accumulated[1]);
  EXPECT_NEAR(shift[2] - shift[1], -0.421, 0.25 * 0.421);
  EXPECT_NEAR(shift[4] - shift[3], -0.048, 0.25 * 0.048);
}

// Below the limit of 3.202: what flows falls from pass to pass. (The computation that it is held against says by how
// much of the point that flows most; here it is summed over the depth, so that only the class is compared.)
TEST(LongRepeatedRolling, At30TimesTheShearYieldStressWithFrictionSettlesFromPassToPass) {
  MovingPressure p;
  p.p0_over_k = 3;
  p.friction = 0.2;
  p.cell = 0.2;
  p.track = 6;
  RolledHalfPlane h(p);
  double flowed[4] = {};
  for (int pass = 1; pass <= 3; ++pass) {
    h.pass();
    flowed[pass] = h.accumulated();
  }
  const double first = flowed[1], second = flowed[2] - flowed[1], third = flowed[3] - flowed[2];
  EXPECT_GT(first, 0);
  EXPECT_LT(second, 0.5 * first);
  EXPECT_LT(third, 0.5 * second);
  const Extremes e = extremes(h);
  EXPECT_NEAR(e.xx.xx, -0.070, 0.02);
  EXPECT_NEAR(e.yy.yy, -0.089, 0.02);
  EXPECT_LT(e.vanishing, 0.02);
}

}  // namespace
}  // namespace railstrata
