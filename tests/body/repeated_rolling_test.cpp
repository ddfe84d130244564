// Repeated rolling of a half-plane by a Hertz pressure without friction, against an independent plane finite element
// computation (static, mean dilatation, moving load; residual stresses averaged over the middle half-widths) with the
// loads of [Bhargava1985]: p0/k = 3.5 on cells of 0.05 and 4.35 on cells of 0.1 half-widths.
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace railstrata
