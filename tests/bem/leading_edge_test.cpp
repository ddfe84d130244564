#include "bem/leading_edge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "bem/rolling_contact.hpp"
#include "bem/solve_bem.hpp"
#include "half_space_pair.hpp"
#include "halfspace/layered.hpp"
#include "reference_table.hpp"

namespace railstrata {
namespace {

constexpr double kLoad = 8e4;

/// Two bodies pressed into an ellipse a x b, cells of the shorter semi-axis over `cells`; the grid's cells lie anywhere
/// relative to the ellipse.
struct Patch {
  HertzGap gap;
  HertzContact hertz;
  PatchGrid grid;
  InfluenceOperator influence;
  RollingContact contact;
  double slope;  // f p0/G, what makes a large creepage
  Patch(double a, double b, int cells, double nu, double friction, const std::vector<HalfSpaceLayer>& layers = {},
        double shift = 0.3)
      : gap(hertz_gap(a, b, contact_modulus({200e9, nu}, {200e9, nu}), kLoad)),
        hertz(hertz_contact(gap.A, gap.B, contact_modulus({200e9, nu}, {200e9, nu}), kLoad)),
        grid(room(a, b, std::min(a, b) / cells, layers.empty() ? 1.0 : 1.3)),
        influence(combined_compliance(homogeneous_compliance({200e9, nu}), layered_compliance({layers, {200e9, nu}})),
                  grid.nx, grid.ny, grid.dx, grid.dy),
        slope(friction * hertz.p0 / HalfSpaceMaterial{200e9, nu}.shear()) {
    grid.x0 += shift * grid.dx;
    grid.y0 += 0.7 * shift * grid.dy;
    contact.gap = quadratic_gap(grid, gap.A, gap.B);
    contact.target.load = kLoad;
    contact.friction = friction;
  }
  static PatchGrid room(double a, double b, double d, double growth) {
    return centred_grid(static_cast<int>(growth * a / d) + 3, static_cast<int>(growth * b / d) + 3, d, d);
  }
  TangentialSolution solve(LeadingEdge edge, double xi, double eta = 0, double spin = 0) const {
    RollingContact c = contact;
    c.leading_edge = edge;
    c.x.creepage = xi;
    c.y.creepage = eta;
    c.spin = spin;
    return solve_rolling(influence, grid, c).tangential;
  }
};
constexpr LeadingEdge kNew = LeadingEdge::sub_cell, kPlain = LeadingEdge::whole_cell;

/// Rms second difference of |q| across rows over the mean |q|, where cells stick with `margin` of stick ahead and
/// behind.
double stripes(const PatchGrid& g, const Plane& q_x, const Plane& q_y, const std::vector<ContactState>& state,
               double margin) {
  const int m = static_cast<int>(std::ceil(margin / g.dx));
  const auto inside = [&](int i, int j) {
    for (int k = -m; k <= m; ++k)
      if (i + k < 0 || i + k >= g.nx || state[g.index(i + k, j)] != ContactState::stick) return false;
    return true;
  };
  const auto q = [&](int i, int j) { return std::hypot(q_x[g.index(i, j)], q_y[g.index(i, j)]); };
  double squares = 0, sum = 0;
  int count = 0;
  for (int i = 0; i < g.nx; ++i)
    for (int j = 1; j + 1 < g.ny; ++j) {
      if (!inside(i, j - 1) || !inside(i, j) || !inside(i, j + 1)) continue;
      const double bend = q(i, j - 1) - 2 * q(i, j) + q(i, j + 1);
      squares += bend * bend;
      sum += q(i, j);
      ++count;
    }
  return std::sqrt(squares / count) / (sum / count);
}
double stripes(const Patch& p, const TangentialSolution& s) {
  return stripes(p.grid, s.q_x, s.q_y, s.state, 0.2 * p.hertz.a);
}

TEST(LeadingEdge, WeightsFollowTheThreeHalvesLawOfTheGapAndNeedTwoEmptyCells) {
  const PatchGrid g = centred_grid(6, 1, 1e-3, 1e-3);
  NormalSolution n;
  n.pressure.assign(g.size(), 0.0);
  n.gap.assign(g.size(), 0.0);
  for (int j = 0; j < g.ny; ++j) {
    const double s = 0.1 + 0.4 * j;  // of the first empty cell beyond the edge, in cells
    for (int i = 0; i < g.nx; ++i) {
      if (i < 4) n.pressure[g.index(i, j)] = 1;
      if (i >= 4) n.gap[g.index(i, j)] = std::pow(s + (i - 4), 1.5);
    }
  }
  const Plane weight = leading_weights(g, n);
  for (int i = 0; i < g.nx; ++i)
    for (int j = 0; j < g.ny; ++j) {
      const double s = 0.1 + 0.4 * j, law = std::pow(s, 1.5) / (std::pow(s + 1, 1.5) - std::pow(s, 1.5));
      EXPECT_NEAR(weight[g.index(i, j)], i == 3 ? law : 0.0, 1e-12) << i << ' ' << j;
    }
  n.pressure[g.index(g.nx - 2, 0)] = 1;  // one empty cell left on the grid
  n.pressure[g.index(5, 1)] = 1;         // a second patch two cells ahead
  const Plane narrow = leading_weights(g, n);
  EXPECT_EQ(narrow[g.index(g.nx - 2, 0)], 0);
  EXPECT_EQ(narrow[g.index(3, 1)], 0);
  std::fill(n.gap.begin(), n.gap.end(), 1.0);  // does not open
  for (const double w : leading_weights(g, n)) EXPECT_EQ(w, 0);
}

TEST(LeadingEdge, KalkersCoefficientsAreMetWithin1PercentOn10CellsAnd07On20) {
  int compared = 0;
  for (const ReferenceRow& r : reference_table("kalker_table_E3.csv")) {
    const double ratio = r.at("a_over_b"), a = 5e-3 * std::sqrt(ratio), b = 5e-3 / std::sqrt(ratio);
    if (r.at("nu") != 0.25 || (ratio != 0.2 && ratio != 1 && ratio != 5)) continue;
    for (const auto& [cells, bound] : {std::pair{10, 0.01}, std::pair{20, 0.007}}) {
      const Patch p(a, b, cells, 0.25, 1e6);
      const double G = 200e9 / 2.5, c2 = a * b;
      EXPECT_NEAR(p.solve(kNew, 1e-4).force_x / (G * c2 * 1e-4 * r.at("C11")), 1, bound) << ratio << ' ' << cells;
      EXPECT_NEAR(p.solve(kNew, 0, 1e-4).force_y / (G * c2 * 1e-4 * r.at("C22")), 1, bound) << ratio << ' ' << cells;
      EXPECT_NEAR(p.solve(kNew, 0, 0, 0.01).force_y / (G * c2 * std::sqrt(c2) * 0.01 * r.at("C23")), 1, bound)
          << ratio << ' ' << cells;
    }
    ++compared;
  }
  EXPECT_EQ(compared, 3);
}

struct Drive {
  double xi, eta, spin;  // in units of f p0/G, of that over a
};

// Limits: the same scheme on 40 cells a semi-axis, and the plain scheme's, extrapolated, nearby.
TEST(LeadingEdge, ForcesOn10And20CellsAreWithin05And01PercentOfTheirLimits) {
  for (const Drive& d : {Drive{0.2345, 0, 0}, Drive{0, 0.19, 0}, Drive{0.1, 0.05, -0.1}, Drive{0.7, 0, 0}}) {
    const auto force = [&](int cells, LeadingEdge edge) {
      const Patch p(5e-3, 5e-3, cells, 0.28, 0.5);
      const TangentialSolution s = p.solve(edge, d.xi * p.slope, d.eta * p.slope, d.spin * p.slope / 5e-3);
      return std::hypot(s.force_x, s.force_y);
    };
    const double limit = force(40, kNew);
    EXPECT_NEAR(force(10, kNew) / limit, 1, 5e-3) << d.xi << ' ' << d.eta;
    EXPECT_NEAR(force(20, kNew) / limit, 1, 1e-3) << d.xi << ' ' << d.eta;
    EXPECT_NEAR((2 * force(40, kPlain) - force(20, kPlain)) / limit, 1, 3e-3) << d.xi << ' ' << d.eta;
    EXPECT_GT(force(10, kPlain) / limit, 1.01) << "what the plain scheme gives";
  }
}

TEST(LeadingEdge, StripesFallLikeTheCellAndArePlainSchemesNoMore) {
  for (const Drive& d : {Drive{0.2345, 0, 0}, Drive{0, 0.19, 0}, Drive{0.1, 0.05, -0.1}, Drive{0, 0, 0.5}}) {
    const auto of = [&](int cells, LeadingEdge edge) {
      const Patch p(5e-3, 5e-3, cells, 0.28, 0.5);
      return stripes(p, p.solve(edge, d.xi * p.slope, d.eta * p.slope, d.spin * p.slope / 5e-3));
    };
    EXPECT_LT(of(20, kNew), 0.02) << d.xi << ' ' << d.eta;
    EXPECT_LT(of(40, kNew), 0.01) << d.xi << ' ' << d.eta;
    EXPECT_GT(of(20, kPlain), 0.1) << d.xi << ' ' << d.eta;
  }
}

// Layers couple: pressure displaces the surfaces sideways, and the traction that takes that back adds a logarithm to
// the law ahead of the edge.
TEST(LeadingEdge, StripesOnLayersAreAFewPercentOfThePlainSchemesAndForcesNearer) {
  for (const double ratio : {0.25, 4.0}) {
    const auto solve = [&](int cells, LeadingEdge edge) {
      const Patch p(5e-3, 5e-3, cells, 0.28, 0.5, {{1.5e-3, {ratio * 200e9, 0.28}}});
      const TangentialSolution s = p.solve(edge, 0.15 * p.slope);
      return std::pair{s.force_x, stripes(p, s)};
    };
    const auto coarse = solve(20, kNew), fine = solve(40, kNew), plain = solve(20, kPlain);
    EXPECT_LT(coarse.second, 0.06) << ratio;
    EXPECT_LT(fine.second, 0.03) << ratio;
    EXPECT_GT(plain.second, 0.15) << ratio;
    EXPECT_NEAR(coarse.first / fine.first, 1, 0.02) << ratio;
  }
}

TEST(LeadingEdge, OfACaseLeavesNoStripesAndTheCreepageOfFinerCellsUnlessWholeCellsAreAskedFor) {
  CaseSpec spec;
  spec.geometry.lateral_shift = 1.5e-3;
  const auto solve = [&](double cell, LeadingEdge edge) {
    spec.bem.leading_edge = edge;
    BemOptions options;
    options.cell = cell;
    return solve_bem(spec, place(spec, {}), options);
  };
  const auto of = [](const BemResult& r) { return stripes(r.grid, r.field.q_x, r.field.q_y, r.field.state, 1.2e-3); };
  const BemResult base = solve(0.25e-3, kNew), fine = solve(0.125e-3, kNew), plain = solve(0.25e-3, kPlain);
  EXPECT_LT(of(base), 0.01);
  EXPECT_GT(of(plain), 0.1);
  EXPECT_NEAR(base.rigid_slip.x / fine.rigid_slip.x, 1, 2e-3);
  EXPECT_NEAR(solve(1e-3, kNew).rigid_slip.x / fine.rigid_slip.x, 1, 1.5e-2) << "by where the patch lies on its cells";
  EXPECT_GT(std::abs(plain.rigid_slip.x / fine.rigid_slip.x - 1), 1e-2);
  spec.layers.push_back({});
  spec.layers[0].thickness = 2e-3;
  spec.layers[0].material.young = 420e9;
  EXPECT_LT(of(solve(0.25e-3, kNew)), 0.03) << "cases/quick";
}

TEST(LeadingEdge, AGivenForceIsMetAndItsCreepageIsThatOfTheForceOfTheCreepage) {
  const Patch p(6e-3, 4e-3, 12, 0.28, 0.4);
  const TangentialSolution given = p.solve(kNew, 0.2 * p.slope, 0.1 * p.slope, 0.05);
  RollingContact c = p.contact;
  c.x.force = given.force_x;
  c.y.force = given.force_y;
  c.spin = 0.05;
  const TangentialSolution back = solve_rolling(p.influence, p.grid, c).tangential;
  EXPECT_NEAR(back.creepage_x / (0.2 * p.slope), 1, 1e-4);
  EXPECT_NEAR(back.creepage_y / (0.1 * p.slope), 1, 1e-4);
}

TEST(LeadingEdge, SpinUnderGrossSlipHasTheForceOfThePlainScheme) {
  const auto force = [](int cells, LeadingEdge edge, double spin) {
    const Patch p(5e-3, 5e-3, cells, 0.28, 0.5);
    return p.solve(edge, 0, 0, spin * p.slope / 5e-3).force_y;
  };
  const double limit = force(40, kPlain, 5);
  EXPECT_NEAR(force(10, kNew, 5) / limit, 1, 0.025);
  EXPECT_NEAR(force(20, kNew, 5) / limit, 1, 0.01);
}

// From rest at a given creepage: the force after the wheel has rolled half a semi-axis, four semi-axes.
TEST(LeadingEdge, TransientRollingConvergesFasterAndEndsInTheSteadyState) {
  const auto roll = [](int cells, LeadingEdge edge, double semi_axes) {
    Patch p(5e-3, 5e-3, cells, 0.28, 0.5);
    RollingContact& c = p.contact;
    c.leading_edge = edge;
    c.kind = RollingKind::shift;
    RollingSolution s = solve_rolling(p.influence, p.grid, c);
    c.x.creepage = 0.2345 * p.slope;
    for (int step = 0; step < std::lround(semi_axes * cells); ++step) {
      roll_on_one_cell(p.influence, p.grid, s, c);
      s = solve_rolling(p.influence, p.grid, c, {}, &s);
    }
    return s.tangential.force_x;
  };
  const double half = roll(40, kNew, 0.5);
  EXPECT_NEAR(roll(10, kNew, 0.5) / half, 1, 0.01);
  EXPECT_NEAR(roll(20, kNew, 0.5) / half, 1, 5e-3);
  EXPECT_GT(roll(10, kPlain, 0.5) / half, 1.01);
  const Patch p(5e-3, 5e-3, 10, 0.28, 0.5);
  EXPECT_NEAR(roll(10, kNew, 20) / p.solve(kNew, 0.2345 * p.slope).force_x, 1, 1e-3);
}

}  // namespace
}  // namespace railstrata
