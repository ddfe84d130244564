#include "bem/tangential_problem.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/faults.hpp"
#include "half_space_pair.hpp"
#include "reference_table.hpp"
#include "tests/halfspace/classical_rolling.hpp"

namespace railstrata {
namespace {

// Same cells, same unknowns: the two programs agree far below the discretisation error, in the number of slipping cells
// exactly.
TEST(SteadyRolling, MeetsContactOnCircleAndEllipseForForceCreepageAndSpin) {
  int compared = 0;
  for (const ReferenceRow& r : reference_table("half_space.csv")) {
    if (r.name.find("_norm") != std::string::npos || r.at("contact_cells") > 8000) continue;
    const ReferenceContact c(1e3 * r.at("A_1_per_mm"), 1e3 * r.at("B_1_per_mm"), 1e-3 * r.at("dx_mm"));
    TangentialProblem p = c.rolling();
    const bool force_given = std::isfinite(r.at("FX_rel"));
    if (force_given)
      p.x.force = -r.at("FX_rel") * c.kFriction * c.kLoad;
    else
      p.x.creepage = r.at("creep_x");
    p.y.creepage = r.at("creep_y");
    p.spin = 1e3 * r.at("spin_rad_per_mm");
    const TangentialSolution s = solve_tangential(c.influence, c.grid, p);
    if (force_given) {
      EXPECT_NEAR(s.creepage_x / r.at("out_creep_x"), 1, 1e-5) << r.name;
    }
    EXPECT_NEAR(s.force_x, -r.at("FX_N"), 1e-5 * c.kLoad) << r.name;
    EXPECT_NEAR(s.force_y, -r.at("FY_N"), 1e-5 * c.kLoad) << r.name;
    EXPECT_NEAR(s.moment, -1e-3 * r.at("MZ_Nmm"), 1e-7 * c.kLoad) << r.name;
    EXPECT_NEAR(largest_traction(s) / (1e6 * r.at("tau_max_MPa")), 1, 1e-4) << r.name;
    EXPECT_EQ(std::count(s.state.begin(), s.state.end(), ContactState::slip), static_cast<long>(r.at("slip_cells")))
        << r.name;
    ++compared;
  }
  EXPECT_EQ(compared, 22);
}

void expect_line(const std::string& file, const PatchGrid& g, const NormalSolution& n, const TangentialSolution& s) {
  int compared = 0;
  for (const ReferenceRow& r : reference_table(file)) {
    const int i = static_cast<int>(std::lround((1e-3 * r.at("x_mm") - g.x0) / g.dx)),
              j = static_cast<int>(std::lround((1e-3 * r.at("y_mm") - g.y0) / g.dy));
    if (i < 0 || j < 0 || i >= g.nx || j >= g.ny) continue;
    const std::size_t k = g.index(i, j);
    EXPECT_NEAR(n.pressure[k], 1e6 * r.at("pn_MPa"), 1e4);
    EXPECT_NEAR(s.q_x[k], -1e6 * r.at("px_MPa"), 5e4);
    EXPECT_NEAR(s.q_y[k], -1e6 * r.at("py_MPa"), 5e4);
    EXPECT_EQ(static_cast<int>(s.state[k]), static_cast<int>(r.at("state")));
    ++compared;
  }
  EXPECT_GT(compared, 25);
}

TEST(SteadyRolling, LinesThroughThePatchMeetContactTo005MPa) {
  const ReferenceContact coarse(1000.0 / 840, 1000.0 / 840, 0.5e-3), fine(1000.0 / 840, 1000.0 / 840, 0.25e-3);
  TangentialProblem p = coarse.rolling();
  p.x.force = -0.4 * coarse.kFriction * coarse.kLoad;
  expect_line("circ_fx0.4_dx0.5_y0.csv", coarse.grid, coarse.normal,
              solve_tangential(coarse.influence, coarse.grid, p));
  p = fine.rolling();
  p.spin = 0.6;
  expect_line("circ_cr3_dx0.25_x0.csv", fine.grid, fine.normal, solve_tangential(fine.influence, fine.grid, p));
  p.x.creepage = -1e-3;
  p.y.creepage = 5e-4;
  p.spin = 0.12;
  expect_line("circ_cr1_dx0.25_y0.csv", fine.grid, fine.normal, solve_tangential(fine.influence, fine.grid, p));
}

TEST(TransientRolling, ShiftThenRollingAtConstantForceMeetsContactStepByStep) {
  const ReferenceContact c(1000.0 / 840, 1000.0 / 840, 0.5e-3);
  const auto table = reference_table("circ_cattaneo_to_carter_dx0.5.csv");
  TangentialProblem p = c.rolling();
  p.kind = RollingKind::shift;
  p.x.force = -0.4 * c.kFriction * c.kLoad;
  TangentialSolution s = solve_tangential(c.influence, c.grid, p);
  EXPECT_NEAR(s.creepage_x / (1e-3 * table[0].at("creep_x_or_shift_mm")), 1, 1e-4);
  EXPECT_EQ(std::count(s.state.begin(), s.state.end(), ContactState::slip),
            static_cast<long>(table[0].at("slip_cells")));
  for (std::size_t step = 1; step < table.size(); ++step) {
    roll_on_one_cell(c.influence, c.grid, s, p);
    s = solve_tangential(c.influence, c.grid, p, {}, &s);
    EXPECT_NEAR(s.creepage_x / table[step].at("creep_x_or_shift_mm"), 1, 2e-4) << step;
    EXPECT_NEAR(largest_traction(s) / (1e6 * table[step].at("tau_max_MPa")), 1, 5e-5) << step;
    EXPECT_EQ(std::count(s.state.begin(), s.state.end(), ContactState::slip),
              static_cast<long>(table[step].at("slip_cells")))
        << step;
  }
}

TEST(Shift, MeetsCattaneoMindlinForPoissonZero) {
  const HalfSpaceMaterial body{200e9, 0.0};
  const HertzGap gap = hertz_gap(5e-3, 5e-3, contact_modulus(body, body), 6e4);
  const HertzContact hertz = hertz_contact(gap.A, gap.B, contact_modulus(body, body), 6e4);
  const PatchGrid g = grid_around(5e-3, 5e-3, 0.1e-3, 0.1e-3);
  const InfluenceOperator op(pair_of(body, body), g.nx, g.ny, g.dx, g.dy);
  TangentialProblem p;
  p.kind = RollingKind::shift;
  p.traction_bound = solve_normal(op, g, quadratic_gap(g, gap.A, gap.B), {.load = 6e4, .approach = {}}).pressure;
  for (double& v : p.traction_bound) v *= 0.3;
  const double force = 0.5 * 0.3 * 6e4;
  p.y.force = force;
  const TangentialSolution s = solve_tangential(op, g, p);
  const CattaneoShift exact = cattaneo_shift(hertz, 0.3, force, body, body);
  EXPECT_NEAR(s.creepage_y / exact.shift, 1, 2e-3);
  EXPECT_NEAR(std::sqrt(s.stick_area / std::numbers::pi) / exact.stick_radius, 1, 5e-3);
  double worst = 0;
  for (int i = 0; i < g.nx; ++i)
    for (int j = 0; j < g.ny; ++j) {
      const double r = std::hypot(g.x(i), g.y(j));
      if (std::abs(r - exact.stick_radius) < 3 * g.dx || r > hertz.a - 3 * g.dx) continue;
      worst = std::max(worst, std::abs(s.q_y[g.index(i, j)] - cattaneo_traction(hertz, 0.3, exact.stick_radius, r)));
    }
  EXPECT_LT(worst, 0.01 * 0.3 * hertz.p0);
}

TEST(SteadyRolling, AcrossALongPatchMeetsCarter) {
  // b = 30 a: the middle strip is plane strain; p0, a and the relative curvature of the strip's own Hertz line
  const double a = 2e-3, b = 60e-3, F = 2e5, f = 0.3;
  const HertzGap gap = hertz_gap(a, b, contact_modulus(kSteel, kSteel), F);
  const PatchGrid g = centred_grid(42, 40, a / 40, b / 38);
  const InfluenceOperator op(pair_of(kSteel, kSteel), g.nx, g.ny, g.dx, g.dy);
  const HertzContact hertz = hertz_contact(gap.A, gap.B, contact_modulus(kSteel, kSteel), F);
  TangentialProblem p;
  p.traction_bound = solve_normal(op, g, quadratic_gap(g, gap.A, gap.B), {.load = F, .approach = {}}).pressure;
  for (double& v : p.traction_bound) v *= f;
  const double ratio = 0.5;
  CarterRolling carter = carter_rolling(a, hertz.p0, 2 * gap.A, f, ratio);
  p.x.creepage = carter.creepage;
  const TangentialSolution s = solve_tangential(op, g, p);
  double force = 0, stick = 0;
  for (int i = 0; i < g.nx; ++i) {
    force += s.q_x[g.index(i, g.ny / 2)] * g.dx;
    stick += s.state[g.index(i, g.ny / 2)] == ContactState::stick ? g.dx : 0.0;
  }
  EXPECT_NEAR(force / (-ratio * f * hertz.p0 * a * std::numbers::pi / 2), 1, 0.015);
  EXPECT_NEAR(stick / (2 * carter.stick_half_width), 1, 0.03);
}

TEST(SteadyRolling, ConvergesForEveryTractionAndAxisRatio01To10AndObeysCoulomb) {
  const double F = 8e4, f = 0.4;
  for (double ratio : {0.1, 0.3, 1.0, 3.0, 10.0}) {
    const double a = 5e-3 * std::sqrt(ratio), b = 5e-3 / std::sqrt(ratio);
    const HertzGap gap = hertz_gap(a, b, contact_modulus(kSteel, kSteel), F);
    const PatchGrid g = grid_around(a, b, a / 13, b / 13);
    const InfluenceOperator op(pair_of(kSteel, kSteel), g.nx, g.ny, g.dx, g.dy);
    TangentialProblem p;
    p.traction_bound = solve_normal(op, g, quadratic_gap(g, gap.A, gap.B), {.load = F, .approach = {}}).pressure;
    for (double& v : p.traction_bound) v *= f;
    for (double level : {0.0, 1e-3, 0.1, 0.5, 0.9, 0.99})
      for (double angle : {0.0, 0.8, 2.2})
        for (double spin : {0.0, 0.4}) {
          p.x.force = level * f * F * std::cos(angle);
          p.y.force = level * f * F * std::sin(angle);
          p.spin = spin;
          if (level > 0.5 && spin > 0) continue;  // friction also pays for the spin
          const TangentialSolution s = solve_tangential(op, g, p);
          EXPECT_NEAR(s.force_x, *p.x.force, 1e-5 * F);
          EXPECT_NEAR(s.force_y, *p.y.force, 1e-5 * F);
          for (std::size_t k = 0; k < g.size(); ++k) {
            const double q = std::hypot(s.q_x[k], s.q_y[k]);
            ASSERT_LE(q, p.traction_bound[k] * (1 + 1e-9) + 1e-3);
            ASSERT_GE(s.q_x[k] * s.slip.x[k] + s.q_y[k] * s.slip.y[k], -1e-9 * p.traction_bound[k]);
          }
        }
    for (double creep : {1e-6, 1e-3, 3e-2, 1.0}) {
      p.x = {creep, {}};
      p.y = {-0.5 * creep, {}};
      p.spin = -0.2;
      EXPECT_NO_THROW(solve_tangential(op, g, p)) << ratio << ' ' << creep;
    }
  }
}

TEST(SteadyRolling, FullSlideCarriesTheWholeFriction) {
  const ReferenceContact c(1.2, 0.9, 0.5e-3);
  TangentialProblem p = c.rolling();
  p.x.creepage = -0.05;
  const TangentialSolution s = solve_tangential(c.influence, c.grid, p);
  EXPECT_EQ(s.stick_area, 0);
  EXPECT_NEAR(s.force_x / (-c.kFriction * c.kLoad), 1, 1e-4);
  EXPECT_NEAR(s.dissipation / (0.05 * c.kFriction * c.kLoad), 1, 1e-3);
}

TEST(SteadyRolling, NoTractionWithoutFrictionAndNoForceBeyondIt) {
  const ReferenceContact c(1.2, 1.2, 1e-3);
  TangentialProblem p = c.rolling();
  p.x.force = -c.kFriction * c.kLoad * 1.01;
  EXPECT_THROW(solve_tangential(c.influence, c.grid, p), CaseError);
  p.x.force = 0;
  EXPECT_EQ(largest_traction(solve_tangential(c.influence, c.grid, p)), 0);
  std::fill(p.traction_bound.begin(), p.traction_bound.end(), 0.0);
  p.x = {-1e-3, {}};
  EXPECT_EQ(largest_traction(solve_tangential(c.influence, c.grid, p)), 0);
  p.x.force = -1;
  EXPECT_THROW(solve_tangential(c.influence, c.grid, p), CaseError);
}

}  // namespace
}  // namespace railstrata
