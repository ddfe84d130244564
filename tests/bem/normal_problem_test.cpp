#include "bem/normal_problem.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/faults.hpp"
#include "half_space_pair.hpp"
#include "halfspace/layered.hpp"
#include "reference_table.hpp"

namespace railstrata {
namespace {

TEST(NormalProblem, OneCellTakesTheWholeLoadAndItsDisplacementIsTheApproach) {
  const PatchGrid grid{1, 1, 1e-3, 1e-3, 0, 0};
  const InfluenceOperator influence(pair_of(kSteel, kSteel), 1, 1, grid.dx, grid.dy);
  const NormalSolution s = solve_normal(influence, grid, {0.0}, {.load = 100.0, .approach = {}});
  EXPECT_NEAR(s.pressure[0], 100e6, 1);
  EXPECT_NEAR(s.approach, 100e6 * influence.of_one_cell(0).nn, 1e-9 * s.approach);
}

TEST(InfluenceOperator, EqualsDirectSummationForEveryComponent) {
  const SurfaceCompliance pair =
      combined_compliance(homogeneous_compliance({1, 0.1}), homogeneous_compliance({2, 0.45}));
  const int nx = 7, ny = 10;
  const double dx = 0.3, dy = 0.2;
  const InfluenceOperator op(pair, nx, ny, dx, dy);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const std::size_t n = static_cast<std::size_t>(nx) * ny;
  Plane p(n), qx(n), qy(n), un(n);
  for (auto* v : {&p, &qx, &qy})
    for (double& e : *v) e = uniform(random);
  op.normal(p.data(), un.data());
  const auto [ux, uy] = op.tangential(qx, qy, nx + 1);
  const Plane tn = op.normal_from_traction(qx, qy);
  const auto [nx_, ny_] = op.tangential_from_pressure(p, nx + 1);
  for (int i = 0; i <= nx; ++i)
    for (int j = 0; j < ny; ++j) {
      double sn = 0, sx = 0, sy = 0, st = 0, px = 0, py = 0;
      for (int k = 0; k < nx; ++k)
        for (int l = 0; l < ny; ++l) {
          const auto c = static_cast<std::size_t>(l + ny * k);
          const RectangleInfluence a = rectangle_influence(pair, (i - k) * dx, (j - l) * dy, dx, dy);
          sn += a.nn * p[c];
          sx += a.xx * qx[c] + a.xy * qy[c];
          sy += a.xy * qx[c] + a.yy * qy[c];
          st += a.nx * qx[c] + a.ny * qy[c];
          px -= a.nx * p[c];
          py -= a.ny * p[c];
        }
      const auto c = static_cast<std::size_t>(j + ny * i);
      if (i < nx) {
        EXPECT_NEAR(un[c], sn, 1e-14);
        EXPECT_NEAR(tn[c], st, 1e-14);
      }
      EXPECT_NEAR(ux[c], sx, 1e-14);
      EXPECT_NEAR(uy[c], sy, 1e-14);
      EXPECT_NEAR(nx_[c], px, 1e-14);
      EXPECT_NEAR(ny_[c], py, 1e-14);
    }
}

TEST(NormalProblem, MeetsHertzWithin02PercentAt40CellsForAxisRatios01To10) {
  const double Es = contact_modulus(kSteel, kSteel), F = 8e4;
  for (double ratio : {0.1, 0.3, 1.0, 3.0, 10.0}) {
    const double a = 5e-3 * std::sqrt(ratio), b = 5e-3 / std::sqrt(ratio), d = 2 * std::min(a, b) / 40;
    const HertzGap gap = hertz_gap(a, b, Es, F);
    const HertzContact exact = hertz_contact(gap.A, gap.B, Es, F);
    const double dx = a > b ? 2 * d : d, dy = b > a ? 2 * d : d;
    const PatchGrid g = centred_grid(static_cast<int>(1.1 * a / dx) + 1, static_cast<int>(1.1 * b / dy) + 1, dx, dy);
    const InfluenceOperator op(pair_of(kSteel, kSteel), g.nx, g.ny, g.dx, g.dy);
    const NormalSolution s = solve_normal(op, g, quadratic_gap(g, gap.A, gap.B), {.load = F, .approach = {}});
    EXPECT_NEAR(peak(s.pressure) / exact.p0, 1, 2e-3) << ratio;
    EXPECT_NEAR(s.approach / exact.approach, 1, 2e-3) << ratio;
    EXPECT_NEAR(s.load / F, 1, 1e-9);
    EXPECT_FALSE(s.touches_edge);
    const NormalSolution t = solve_normal(op, g, quadratic_gap(g, gap.A, gap.B), {.load = {}, .approach = s.approach});
    EXPECT_NEAR(t.load / F, 1, 1e-5) << "load and approach are inverse";
  }
}

// half_space.json, circ_norm_*: computed with CONTACT on the same cells.
TEST(NormalProblem, MeetsContactCellForCellOnTheCircle) {
  struct Row {
    double dx, p_max, approach;
    int cells;
  };
  for (const Row r :
       {Row{1e-3, 1076.15847297e6, 0.0898027331686e-3, 121}, Row{0.5e-3, 1074.78250351e6, 0.0898450979144e-3, 489},
        Row{0.25e-3, 1074.62875675e6, 0.08987096239e-3, 1901}}) {
    const int half = static_cast<int>(7e-3 / r.dx);
    const PatchGrid g = centred_grid(half, half, r.dx, r.dx);
    const InfluenceOperator op(pair_of(kSteel, kSteel), g.nx, g.ny, g.dx, g.dy);
    const NormalSolution s =
        solve_normal(op, g, quadratic_gap(g, 1000.0 / 840, 1000.0 / 840), {.load = 84954.6, .approach = {}});
    EXPECT_NEAR(peak(s.pressure) / r.p_max, 1, 1e-5);
    EXPECT_NEAR(s.approach / r.approach, 1, 1e-5);
    EXPECT_EQ(std::count_if(s.pressure.begin(), s.pressure.end(), [](double p) { return p > 0; }), r.cells);
  }
}

TEST(NormalProblem, TwoPatchesShareTheLoadOfTwoEqualBumps) {
  PatchGrid g = centred_grid(40, 15, 0.25e-3, 0.25e-3);
  Plane gap(g.size());
  for (int i = 0; i < g.nx; ++i)
    for (int j = 0; j < g.ny; ++j) {
      const double x = std::abs(g.x(i)) - 6e-3;
      gap[g.index(i, j)] = 4 * (x * x + g.y(j) * g.y(j));
    }
  const InfluenceOperator op(pair_of(kSteel, kSteel), g.nx, g.ny, g.dx, g.dy);
  const NormalSolution s = solve_normal(op, g, gap, {.load = 2e4, .approach = {}});
  double left = 0, right = 0;
  for (int i = 0; i < g.nx; ++i)
    for (int j = 0; j < g.ny; ++j) (g.x(i) < 0 ? left : right) += s.pressure[g.index(i, j)] * g.cell_area();
  EXPECT_NEAR(left, 1e4, 1e-3);
  EXPECT_NEAR(right, 1e4, 1e-3);
  EXPECT_EQ(s.pressure[g.index(g.nx / 2, g.ny / 2)], 0);
}

// coated_sphere.csv: rigid sphere, Fourier-domain solution with a grid error of up to 1 %.
TEST(NormalProblem, RigidSphereOnACoatedHalfSpaceMeetsTheTableWithin15Percent) {
  const double R = 0.01, F = 100;
  const HalfSpaceMaterial base{210e9, 0.3}, rigid{1e20, 0.3};
  const HertzContact hertz = hertz_contact(0.5 / R, 0.5 / R, contact_modulus(rigid, base), F);
  for (const ReferenceRow& r : reference_table("coated_sphere.csv")) {
    const LayeredHalfSpace body{{{r.at("h_over_aH") * hertz.a, {r.at("E1_over_E0") * base.young, 0.3}}}, base};
    const double d = hertz.a / 40;
    const PatchGrid g = centred_grid(56, 56, d, d);
    const InfluenceOperator op(layered_compliance(body), g.nx, g.ny, d, d);
    const NormalSolution s = solve_normal(op, g, quadratic_gap(g, 0.5 / R, 0.5 / R), {.load = F, .approach = {}});
    const auto cells = std::count_if(s.pressure.begin(), s.pressure.end(), [](double p) { return p > 0; });
    EXPECT_NEAR(peak(s.pressure) / hertz.p0 / r.at("p0_over_pH"), 1, 0.015)
        << r.at("h_over_aH") << ' ' << r.at("E1_over_E0");
    EXPECT_NEAR(std::sqrt(static_cast<double>(cells) / 3.141592653589793) * d / hertz.a / r.at("a_over_aH"), 1, 0.015)
        << r.at("h_over_aH") << ' ' << r.at("E1_over_E0");
  }
}

TEST(NormalProblem, SaysWhenTheGridIsTooSmallOrTheBodiesDoNotTouch) {
  const PatchGrid g = centred_grid(5, 5, 1e-3, 1e-3);
  const InfluenceOperator op(pair_of(kSteel, kSteel), g.nx, g.ny, g.dx, g.dy);
  EXPECT_TRUE(solve_normal(op, g, quadratic_gap(g, 1, 1), {.load = 8e4, .approach = {}}).touches_edge);
  EXPECT_THROW(solve_normal(op, g, quadratic_gap(g, 1, 1), {.load = {}, .approach = -1e-6}), CaseError);
  EXPECT_THROW(solve_normal(op, g, quadratic_gap(g, 1, 1), {.load = -1.0, .approach = {}}), CaseError);
}

}  // namespace
}  // namespace railstrata
