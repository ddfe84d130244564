// Repeated rolling of Hertz's line pressure in plane strain, J2, nu = 0.3, G/k = 250, lengths over the half-width a,
// stresses over k, strains over k/G: the loads of [Bhargava1985]. The reference figures are those of plane finite
// elements on a track of finite length, good to 8 % in residual stress, 0.1 a in its depth and 25 % in increments of
// displacement; cells of 0.2 a or 0.1 a along x, as given.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/parallel.hpp"
#include "steady/steady_pass.hpp"
#include "tests/damage/hertz_stress.hpp"

namespace railstrata {
namespace {

constexpr double kShear = 250;  // G over k
constexpr double kInfinite = std::numeric_limits<double>::infinity();

SteadyGrid line_grid(double cell, double row, double length = 48) {
  SteadyGrid g{.nx = static_cast<int>(std::lround(length / cell)),
               .ny = 1,
               .dx = cell,
               .dy = 0,
               .front = 10,
               .active = 6,
               .hold = 6};
  g.thickness.assign(static_cast<std::size_t>(std::lround(1.6 / row)), row);
  return g;
}

struct LineRolling {
  SteadyBody body;
  Field contact;
  PassState state;

  /// tension: along x, over the largest pressure, the same everywhere (what a body of finite depth adds).
  LineRolling(const SteadyGrid& grid, double load, double friction, double hardening = 0, double yield = std::sqrt(3.),
              double tension = 0)
      : body(grid, rows(grid, hardening, yield), {1.5 * kShear, kShear}),
        contact(grid.active_size()),
        state(body.virgin()) {
    const testing::LineLoad line{friction, .3};
    for (int r = 0; r < grid.rows(); ++r)
      for (int i = 0; i < grid.active_stations(); ++i) {
        Sym3 s = load * line.at(grid.x(i), 0, grid.depth(r));
        s.xx += load * tension;
        s.yy += load * .3 * tension;
        const auto e = body.strain_of(r, {s.xx, s.yy, s.zz, s.xy, s.yz, s.xz});
        for (int c = 0; c < 6; ++c) contact[grid.active_index(c, r, i, 0)] = e[c];
      }
  }
  static std::vector<SteadyRow> rows(const SteadyGrid& grid, double hardening, double yield) {
    SteadyRow row{{1.5 * kShear, kShear}, {kShear, yield, 0, 0, {}, {}}};  // lambda = 1.5 G at nu = 0.3
    row.law.modulus[0] = hardening;
    return std::vector<SteadyRow>(grid.thickness.size(), row);
  }
  PassResult pass() { return body.run_pass(contact, state); }
};

struct Extreme {
  double value = 0, depth = 0;
};
Extreme lowest(const SteadyGrid& g, const PassResult& pass, int component) {
  Extreme found;
  for (int r = 0; r < g.rows(); ++r)
    if (pass.residual_stress[r][component] < found.value) found = {pass.residual_stress[r][component], g.depth(r)};
  return found;
}
double largest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()) * kShear; }
/// Surface over the foot of the yielding rows, along the travel, in k a/G.
double forward(const PassResult& pass) { return pass.forward[0] * kShear; }

void expect_stress(const SteadyGrid& g, const PassResult& pass, Extreme x, Extreme y) {
  const Extreme s_x = lowest(g, pass, 0), s_y = lowest(g, pass, 1);
  EXPECT_NEAR(s_x.value, x.value, 0.08 * std::abs(x.value));
  EXPECT_NEAR(s_x.depth, x.depth, 0.1 + 1e-9);
  EXPECT_NEAR(s_y.value, y.value, 0.08 * std::abs(y.value));
  EXPECT_NEAR(s_y.depth, y.depth, 0.1 + 1e-9);
}

TEST(LineRolling, BelowFirstYieldNothingYieldsAndJustAboveItDoes) {
  const SteadyGrid g = line_grid(0.1, 0.05);
  EXPECT_EQ(largest(LineRolling(g, 3.09, 0).pass().accumulated), 0);  // 3.107 at 0.705 a
  EXPECT_GT(largest(LineRolling(g, 3.13, 0).pass().accumulated), 0);
  EXPECT_EQ(largest(LineRolling(g, 50, 0, 0, kInfinite).pass().accumulated), 0);
}

TEST(LineRolling, ResidualStressStandsInEquilibriumAndIsOfDepthAlone) {
  LineRolling run(line_grid(0.1, 0.05), 4.35, 0);
  const PassResult pass = run.pass();
  for (const auto& s : pass.residual_stress)
    for (const int c : {2, 3, 4, 5}) EXPECT_NEAR(s[c], 0, 1e-11);
}

/// Far above shakedown, where 6 half-widths leave 7 % of error in the first residual stress; near it there is none.
TEST(LineRolling, LateFlowShowsAWindowThatIsTooShort) {
  EXPECT_GT(LineRolling(line_grid(0.2, 0.1), 5, 0, 66.67).pass().late_flow, 1e-3);
  EXPECT_EQ(LineRolling(line_grid(0.2, 0.1), 3.5, 0).pass().late_flow, 0);
}

TEST(LineRolling, AtThreeAndAHalfItShakesDownInTheSecondPass) {
  const SteadyGrid g = line_grid(0.05, 0.025);
  LineRolling run(g, 3.5, 0);
  EXPECT_NEAR(largest(run.pass().accumulated), 0.176, 0.02);
  const PassResult second = run.pass();
  EXPECT_LT(largest(second.accumulated), 1e-6 * kShear);
  // So little above first yield (3.107) one percent of the load changes residual stress by some 8 %: the extremes
  // differ by 10 % and 15 %, the profile by less than the reference's 0.08 k.
  const std::vector<double> depth = {.33, .47, .62, .78, .93, 1.07, 1.23},
                            along = {.003, -.190, -.283, -.305, -.276, -.207, -.106},
                            across = {-.041, -.220, -.277, -.265, -.218, -.153, -.078};
  for (std::size_t n = 0; n < depth.size(); ++n) {
    const int r = static_cast<int>(depth[n] / 0.025);
    EXPECT_NEAR(second.residual_stress[r][0], along[n], 0.08);
    EXPECT_NEAR(second.residual_stress[r][1], across[n], 0.08);
  }
  EXPECT_NEAR(lowest(g, second, 0).depth, .76, .1);
  EXPECT_NEAR(lowest(g, second, 1).depth, .66, .1);
}

/// Elements held at 100 half-widths have 0.0065 p0 more tension along x under the load than a half-plane (linear
/// elements, 8 to 112 half-widths: 0.058, 0.037, 0.020, 0.011, 0.0059), 1 % of the stress difference that yields. With
/// it the method has what the program's own elements of that size find step by step (tests/body/repeated_rolling_test).
TEST(LineRolling, AtThreeAndAHalfTheDifferenceToElementsIsThatTheyAreHeldSomewhere) {
  const SteadyGrid g = line_grid(0.05, 0.025);
  LineRolling run(g, 3.5, 0, 0, std::sqrt(3.), 0.0065);
  run.pass();
  expect_stress(g, run.pass(), {-.287, .74}, {-.269, .66});
}

TEST(LineRolling, BetweenTheLimitsItRatchetsForwardForEver) {
  const SteadyGrid g = line_grid(0.2, 0.1);
  LineRolling run(g, 4.35, 0);
  const PassResult first = run.pass();
  expect_stress(g, first, {-1.004, .45}, {-1.139, .45});
  EXPECT_GT(forward(first), 0.5);  // start-up: along the travel
  expect_stress(g, run.pass(), {-.930, .5}, {-1.101, .45});
  PassResult pass = run.pass();
  std::vector<double> flow;
  for (int n = 4; n <= 8; ++n) {
    const double before = forward(pass);
    pass = run.pass();
    flow.push_back(before - forward(pass));
  }
  expect_stress(g, pass, {-.872, .5}, {-1.084, .5});
  EXPECT_GT(flow.back(), 0.09);                           // the track's ends hold the reference back
  EXPECT_NEAR(flow.back(), flow[3], 0.01 * flow.back());  // for ever
}

TEST(LineRolling, AtFiveItRatchetsTenTimesAsFast) {
  const SteadyGrid g = line_grid(0.2, 0.1);
  LineRolling run(g, 5, 0);
  run.pass();  // on an endless track; the reference's first pass begins with the load set down 12 a away
  PassResult pass = run.pass();
  const double before = forward(pass);
  pass = run.pass();
  expect_stress(g, pass, {-1.922, .25}, {-1.448, .2});
  EXPECT_NEAR(before - forward(pass), 1.8, 0.25 * 1.8);
}

TEST(LineRolling, LinearKinematicHardeningStopsTheFlowAndKeepsOnYielding) {
  const SteadyGrid g = line_grid(0.2, 0.1);
  LineRolling run(g, 5, 0, 66.67);
  PassResult pass = run.pass();
  for (int n = 2; n <= 4; ++n) pass = run.pass();
  expect_stress(g, pass, {-1.240, .3}, {-1.321, .25});
  EXPECT_NEAR(largest(pass.accumulated), 3.4, 0.25 * 3.4);
  for (int n = 5; n <= 16; ++n) pass = run.pass();
  EXPECT_GT(largest(pass.accumulated), 3);
  EXPECT_LT(largest(pass.net), 0.01 * largest(pass.accumulated));
}

TEST(LineRolling, WithFrictionBelowTheLimitItShakesDownFromPassToPass) {
  LineRolling run(line_grid(0.1, 0.1), 3, .2);
  PassResult pass = run.pass();
  const double start = largest(pass.accumulated);
  for (const double step : {.0063, .0020}) {
    const double before = forward(pass);
    pass = run.pass();
    EXPECT_NEAR(forward(pass) - before, step, 0.25 * step);
  }
  for (int n = 4; n <= 14; ++n) pass = run.pass();
  EXPECT_LT(largest(pass.accumulated), 0.01 * start);
}

TEST(LineRolling, ALongerPeriodChangesAPassByLessThanOnePercent) {
  LineRolling usual(line_grid(0.1, 0.1), 4.35, 0), twice(line_grid(0.1, 0.1, 96), 4.35, 0);
  const PassResult a = usual.pass(), b = twice.pass();
  for (std::size_t n = 0; n < a.residual_stress.size(); ++n)
    for (const int c : {0, 1}) EXPECT_NEAR(a.residual_stress[n][c], b.residual_stress[n][c], 0.02);
}

TEST(LineRolling, HasTheSameBitsForOneAndTwoThreads) {
  const int threads = max_threads();
  std::vector<double> histories[2];
  for (const int n : {1, 2}) {
    set_threads(n);
    LineRolling run(line_grid(0.2, 0.1), 5, .1, 66.67);
    run.pass();
    run.pass();
    histories[n - 1] = run.state.history;
  }
  set_threads(threads);
  EXPECT_TRUE(histories[0] == histories[1]);
}

}  // namespace
}  // namespace railstrata
