// Line contact (plane strain): Hertz, Carter, Cattaneo, stresses, and the middle of very long patches.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bem/rolling_contact.hpp"
#include "bem/subsurface.hpp"
#include "half_space_pair.hpp"
#include "halfspace/layered.hpp"
#include "halfspace/line_contact.hpp"
#include "material/elastic.hpp"
#include "tests/halfspace/classical_rolling.hpp"

namespace railstrata {
namespace {

/// carter2d.csv: a = 5 mm, p0 = 576.9231 MPa, relative radius 0.5 m, f = 0.5; the line 12 mm long.
struct Cylinder {
  static constexpr double kA = 5e-3, kCurvature = 2.0, kFriction = 0.5, kLine = 12e-3;
  double p0 = 0.5 * kA * kCurvature * contact_modulus(kSteel, kSteel), load = 0.5 * std::numbers::pi * kA * p0 * kLine;
  PatchGrid grid;
  InfluenceOperator influence;
  explicit Cylinder(int cells, const LayeredHalfSpace& rail = {{}, kSteel})
      : grid(line_grid(static_cast<int>(0.6 * cells) + 2, 2 * kA / cells, kLine)),
        influence(combined_compliance(homogeneous_compliance(kSteel), layered_compliance(rail)), grid.nx, 1, grid.dx,
                  grid.dy, 0, true) {}
  RollingContact contact() const {
    RollingContact c;
    c.gap = quadratic_gap(grid, 0.5 * kCurvature, 0);
    c.target.load = load;
    c.friction = kFriction;
    return c;
  }
  RollingSolution at_force(double ratio, LeadingEdge edge = LeadingEdge::sub_cell) const {
    RollingContact c = contact();
    c.leading_edge = edge;
    c.x.force = -ratio * kFriction * load;
    return solve_rolling(influence, grid, c);
  }
};

TEST(LineContact, PressureIsHertzs) {
  const Cylinder c(100);
  const NormalSolution s = solve_normal(c.influence, c.grid, c.contact().gap, {.load = c.load, .approach = {}});
  EXPECT_FALSE(s.touches_edge);
  EXPECT_NEAR(s.load / c.load, 1, 1e-12);
  EXPECT_NEAR(peak(s.pressure) / c.p0, 1, 2e-4);
  for (int i = 0; i < c.grid.nx; ++i) {
    const double x = c.grid.x(i) / c.kA;
    if (std::abs(x) < 0.95) {
      EXPECT_NEAR(s.pressure[i] / (c.p0 * std::sqrt(1 - x * x)), 1, 2e-3) << x;
    } else if (std::abs(x) > 1.02) {
      EXPECT_EQ(s.pressure[i], 0) << x;
    }
  }
}

// carter2d.csv has 0.4 to 0.5 % left on these cells, Kalker's scheme of whole ones.
TEST(LineContact, CreepageIsCarters) {
  const Cylinder c(100);
  for (const auto& [ratio, exact] :
       {std::pair(0.3, -0.00081669987), std::pair(0.4, -0.0011270167), std::pair(0.64, -0.002)}) {
    const TangentialSolution s = c.at_force(ratio).tangential;
    EXPECT_NEAR(s.creepage_x / exact, 1, 1e-3) << ratio;
    EXPECT_NEAR(s.force_x / (-ratio * c.kFriction * c.load), 1, 1e-5);
    const CarterRolling carter = carter_rolling(c.kA, c.p0, c.kCurvature, c.kFriction, ratio);
    EXPECT_NEAR(s.stick_area / (2 * carter.stick_half_width * c.kLine), 1, 0.02) << ratio;
    for (int i = 0; i < c.grid.nx; ++i) {
      if (std::abs(std::abs(c.grid.x(i)) - c.kA) < 1.01 * c.grid.dx) continue;
      EXPECT_NEAR(s.q_x[i], carter.traction(c.grid.x(i)), 0.03 * c.kFriction * c.p0) << ratio << ' ' << c.grid.x(i);
    }
  }
}

// Every cell slides: one that was turned the wrong way round on the way there has to turn back.
TEST(LineContact, FullSlidingHasFrictionAgainstTheSlipInEveryCell) {
  for (const int cells : {40, 80, 100}) {
    const Cylinder c(cells);
    RollingContact sliding = c.contact();
    sliding.x.creepage = -0.3;
    const TangentialSolution s = solve_rolling(c.influence, c.grid, sliding).tangential;
    EXPECT_NEAR(s.force_x / (-c.kFriction * c.load), 1, 1e-9) << cells;
    for (const double q : s.q_x) EXPECT_LE(q, 0) << cells;
  }
}

// What the creepage puts in is what friction takes, but for what the grid loses, of first order in a cell.
TEST(LineContact, PowerOfTheForceIsDissipated) {
  double missing[2];
  for (const int fine : {0, 1}) {
    const TangentialSolution s = Cylinder(fine ? 200 : 100).at_force(0.4).tangential;
    missing[fine] = 1 - s.dissipation / (s.force_x * s.creepage_x);
  }
  EXPECT_LT(missing[0], 0.06);
  EXPECT_NEAR(2 * missing[1] - missing[0], 0, 0.005);
}

// The table's own cells: an even number over the patch, whole ones, as CONTACT has them.
TEST(LineContact, WholeCellsGiveContactsCreepage) {
  for (const auto& [cells, ratio, contact] :
       {std::tuple(20, 0.3, -0.00080210489), std::tuple(20, 0.64, -0.0019539235), std::tuple(50, 0.4, -0.0011182899),
        std::tuple(100, 0.3, -0.00081368604)}) {
    Cylinder c(cells);
    c.grid.x0 += 0.5 * c.grid.dx;
    EXPECT_NEAR(c.at_force(ratio, LeadingEdge::whole_cell).tangential.creepage_x / contact, 1, 2e-3) << cells;
  }
}

// Cattaneo in plane strain: what sticks is sqrt(1 - F/(f N)) of the half-width. [Johnson1985 sec. 7.2a]
TEST(LineContact, ShiftSticksInTheMiddleAsCattaneoSays) {
  const Cylinder c(200);
  RollingContact shift = c.contact();
  shift.kind = RollingKind::shift;
  shift.x.force = -0.4 * c.kFriction * c.load;
  const TangentialSolution s = solve_rolling(c.influence, c.grid, shift).tangential;
  EXPECT_NEAR(s.stick_area / (2 * c.kA * std::sqrt(0.6) * c.kLine), 1, 0.01);
  EXPECT_NEAR(-s.q_x[c.grid.nx / 2] / (c.kFriction * c.p0 * (1 - std::sqrt(0.6))), 1, 0.002);
}

// From rest to Carter's state: 40 half-widths on. What is rolled at constant force ends in the steady state.
TEST(LineContact, RollingFromRestEndsInTheSteadyState) {
  const Cylinder c(40);
  const RollingSolution steady = c.at_force(0.4);
  RollingContact rolling = c.contact();
  rolling.kind = RollingKind::shift;
  rolling.x.force = -0.4 * c.kFriction * c.load;
  RollingSolution s = solve_rolling(c.influence, c.grid, rolling);
  for (int i = 0; i < 200; ++i) {
    roll_on_one_cell(c.influence, c.grid, s, rolling);
    s = solve_rolling(c.influence, c.grid, rolling, {}, &s);
  }
  EXPECT_NEAR(s.tangential.creepage_x / steady.tangential.creepage_x, 1, 2e-3);
  for (std::size_t k = 0; k < c.grid.size(); ++k)
    EXPECT_NEAR(s.tangential.q_x[k], steady.tangential.q_x[k], 2e-3 * c.kFriction * c.p0);
}

Subsurface below(const Cylinder& c, const RollingSolution& s, const LayeredHalfSpace& rail = {{}, kSteel}) {
  const Plane none(c.grid.size(), 0.0);
  return {rail, c.grid, s.normal.pressure, s.tangential.q_x.empty() ? none : s.tangential.q_x, none};
}

// plane strain, nu = 0.3: 0.5577 p0 at 0.704 a. sigma_xx = -p0 [(a² + 2 z²)/(a sqrt(a² + z²)) - 2 z/a], sigma_zz =
// -p0 a/sqrt(a² + z²) below the middle. [Johnson1985 eq. 4.46]
TEST(LineContact, StressesBelowHertzsPressure) {
  const Cylinder c(100);
  RollingSolution s;
  s.normal = solve_normal(c.influence, c.grid, c.contact().gap, {.load = c.load, .approach = {}});
  const Subsurface body = below(c, s);
  for (const double z : {0.0, 0.5e-3, 2e-3, 5e-3, 20e-3}) {
    const InteriorPoint at = body.at({{0, 3e-3, z}}).front();
    const double r = std::hypot(c.kA, z), xx = -c.p0 * ((c.kA * c.kA + 2 * z * z) / (c.kA * r) - 2 * z / c.kA),
                 zz = -c.p0 * c.kA / r;
    EXPECT_NEAR(at.stress.xx / c.p0, xx / c.p0, 1e-3) << z;
    EXPECT_NEAR(at.stress.zz / c.p0, zz / c.p0, 1e-3) << z;
    EXPECT_NEAR(at.stress.yy / c.p0, 0.3 * (xx + zz) / c.p0, 1e-3) << z;
    EXPECT_TRUE(std::isnan(at.displacement.z));
  }
  const SubsurfacePeaks peaks = body.peaks({0.2e-3, 10e-3});
  EXPECT_NEAR(peaks.subsurface.von_mises.value / c.p0, 0.5577, 0.5577e-3);
  EXPECT_NEAR(peaks.subsurface.von_mises.depth / c.kA, 0.704, 0.005);
  EXPECT_NEAR(peaks.subsurface.von_mises.x, 0, 0.5 * c.grid.dx);
  EXPECT_LT(peaks.subsurface.von_mises.at_rim, peaks.subsurface.von_mises.value);
}

/// The middle of a patch sixty times as long as wide, on a layered rail: what it bears there is a line's load.
struct LongPatch {
  static constexpr double kA = 2e-3, kB = 120e-3, kLoad = 4e5, kFriction = 0.3;
  LayeredHalfSpace rail;
  HertzGap gap = hertz_gap(kA, kB, contact_modulus(kSteel, kSteel), kLoad);
  PatchGrid grid = centred_grid(24, 36, kA / 15, kB / 30), line = line_grid(24, kA / 15, 10e-3);
  SurfaceCompliance pair;
  InfluenceOperator influence, influence_of_line;
  explicit LongPatch(const LayeredHalfSpace& rail_)
      : rail(rail_),
        pair(combined_compliance(homogeneous_compliance(kSteel), layered_compliance(rail_))),
        influence(pair, grid.nx, grid.ny, grid.dx, grid.dy),
        influence_of_line(pair, line.nx, 1, line.dx, line.dy, 0, true) {}
  RollingContact contact(const PatchGrid& g, double load, double creepage) const {
    RollingContact c;
    c.gap = quadratic_gap(g, gap.A, g.line ? 0 : gap.B);
    c.target.load = load;
    c.friction = kFriction;
    c.x.creepage = creepage;
    return c;
  }
  std::size_t middle(int i) const { return grid.index(i, grid.ny / 2); }
};

TEST(SlowLineContact, LayeredLineIsTheMiddleOfAVeryLongPatch) {
  for (const LayeredHalfSpace& rail :
       {LayeredHalfSpace{{{1e-3, {420e9, 0.3}}}, kSteel}, LayeredHalfSpace{{{0.6e-3, {105e9, 0.3}}}, kSteel}}) {
    const LongPatch patch(rail);
    const double creepage = -5e-4;
    const RollingSolution whole =
        solve_rolling(patch.influence, patch.grid, patch.contact(patch.grid, patch.kLoad, creepage));
    double per_length = 0;
    for (int i = 0; i < patch.grid.nx; ++i) per_length += whole.normal.pressure[patch.middle(i)] * patch.grid.dx;
    const RollingSolution line = solve_rolling(patch.influence_of_line, patch.line,
                                               patch.contact(patch.line, per_length * patch.line.dy, creepage));
    const double p0 = peak(line.normal.pressure);
    for (int i = 0; i < patch.grid.nx; ++i) {
      const auto k = static_cast<std::size_t>(i);
      EXPECT_NEAR(line.normal.pressure[k], whole.normal.pressure[patch.middle(i)], 0.01 * p0);
      EXPECT_NEAR(line.tangential.q_x[k], whole.tangential.q_x[patch.middle(i)], 0.015 * patch.kFriction * p0);
    }
    const Plane none(patch.line.size(), 0.0);
    const Subsurface below_line(rail, patch.line, line.normal.pressure, line.tangential.q_x, none),
        below_patch(rail, patch.grid, whole.normal.pressure, whole.tangential.q_x, whole.tangential.q_y);
    std::vector<Vec3> places;
    for (const double z : {0.05e-3, 0.5e-3, 3e-3})
      for (const double x : {-1.2e-3, 0.0, 1.6e-3}) places.push_back({x, 0, z});
    const std::vector<InteriorPoint> of_line = below_line.at(places), of_patch = below_patch.at(places);
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Sym3 &a = of_line[k].stress, &b = of_patch[k].stress;
      EXPECT_NEAR(a.xx, b.xx, 0.015 * p0) << places[k].x << ' ' << places[k].z;
      EXPECT_NEAR(a.yy, b.yy, 0.015 * p0) << places[k].x << ' ' << places[k].z;
      EXPECT_NEAR(a.zz, b.zz, 0.015 * p0) << places[k].x << ' ' << places[k].z;
      EXPECT_NEAR(a.xz, b.xz, 0.015 * p0) << places[k].x << ' ' << places[k].z;
    }
  }
}

// The grid and its periodic images must not matter: half as wide, the same stresses.
TEST(LineContact, StressesBelowALayerDoNotKnowTheGrid) {
  const LayeredHalfSpace rail{{{3e-3, {630e9, 0.3}}}, kSteel};
  const Cylinder c(60, rail);
  const RollingSolution s = c.at_force(0.5);
  const Subsurface one = below(c, s, rail),
                   other(rail, c.grid, s.normal.pressure, s.tangential.q_x, Plane(c.grid.size(), 0.0), 16);
  for (const double z : {0.1e-3, 2.9e-3, 6e-3, 15e-3})
    for (const double x : {-3e-3, 0.0, 5e-3}) {
      const Sym3 a = one.at({{x, 0, z}}).front().stress, b = other.at({{x, 0, z}}).front().stress;
      EXPECT_NEAR(a.xx, b.xx, 1e-4 * c.p0) << x << ' ' << z;
      EXPECT_NEAR(a.zz, b.zz, 1e-4 * c.p0) << x << ' ' << z;
      EXPECT_NEAR(a.xz, b.xz, 1e-4 * c.p0) << x << ' ' << z;
    }
}

}  // namespace
}  // namespace railstrata
