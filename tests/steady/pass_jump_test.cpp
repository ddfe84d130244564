#include "steady/pass_jump.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "steady/pass_class.hpp"
#include "steady/steady_pass.hpp"

namespace railstrata {
namespace {

using State = std::vector<double>;

State jumped(const State& start, int rounds, const std::function<State(const State&)>& change, int* asked = nullptr) {
  return *state_after(start, change(start), rounds, [&](const State& s) -> std::optional<State> {
    if (asked) ++*asked;
    return change(s);
  });
}

/// Modes that keep a share of themselves in a round: what moves at all speeds is what makes plain extrapolation fail.
TEST(PassJump, WhatSettlesAtAnySpeedSettlesInAJumpToo) {
  const State kept = {0, .1, .3, .5, .7, .8, .9, .95, .98};
  const auto change = [&](const State& s) {
    State d(s.size());
    for (std::size_t n = 0; n < s.size(); ++n) d[n] = (kept[n] - 1) * s[n];
    return d;
  };
  for (const int rounds : {6, 20, 50, 150, 400}) {
    const State end = jumped(State(kept.size(), 1.0), rounds, change);
    for (std::size_t n = 0; n < end.size(); ++n) EXPECT_LT(std::abs(end[n]), 1) << rounds << " " << kept[n];
  }
}

TEST(PassJump, AConstantRateAddsUpExactlyWithFewerStagesThanRounds) {
  int asked = 0;
  const State end = jumped(
      {1, 2}, 150,
      [](const State&) {
        return State{1e-3, -2e-3};
      },
      &asked);
  EXPECT_NEAR(end[0], 1.15, 1e-12);
  EXPECT_NEAR(end[1], 1.7, 1e-12);
  EXPECT_EQ(asked + 1, stages_of(150));
  EXPECT_LT(asked, 20);
}

/// x' = x^-4/4000 from x = 1 on is x^5 = 1 + n/800.
TEST(PassJump, ItsErrorFallsWithTheThirdPowerOfTheLength) {
  const auto change = [](const State& s) { return State{std::pow(s[0], -4) / 4000}; };
  const auto error = [&](int rounds) {
    return std::abs(jumped({1}, rounds, change)[0] - std::pow(1 + rounds / 800.0, 0.2));
  };
  EXPECT_NEAR(std::log2(error(100) / error(50)), 3, 0.35);
  EXPECT_NEAR(std::log2(error(50) / error(25)), 3, 0.35);
}

TEST(PassJump, TheNextLengthIsThatOfASecondOrderStepWithinBounds) {
  EXPECT_EQ(next_jump(100, 0.02, 0.02), 80);
  EXPECT_EQ(next_jump(100, 0.08, 0.02), 40);
  EXPECT_EQ(next_jump(100, 0, 0.02), 400);
  EXPECT_EQ(next_jump(100, 1e3, 0.02), 25);
}

State history_of(double xx, double accumulated) {
  State h(kStreamlineHistory, 0.0);
  h[0] = xx;
  h[6] = accumulated;
  return h;
}

TEST(PassJump, TheErrorOfAClosedCycleIsTakenFromWhatFlowsInIt) {
  const auto error = [](double net_off, double flow_off) {  // ten rounds of net 1e-6 and Δp 1e-3
    return jump_error(history_of(0, 0), history_of(1e-5, 1e-2), history_of(1e-6 + net_off, 1e-3 + flow_off),
                      history_of(1e-6 + net_off, 1e-3 + flow_off), 10);
  };
  EXPECT_NEAR(error(0, 0), 0, 1e-12);
  // all of the net strain, √(2/3) 1e-6, against 1 % of Δp, which counts as closed
  EXPECT_NEAR(error(1e-6, 0), 0.8 * std::sqrt(2.0 / 3) * 0.1, 1e-9);
  EXPECT_NEAR(error(0, 5e-5), 0.8 * 0.05, 1e-9);
  EXPECT_EQ(jump_error(history_of(0, 0), history_of(0, 0), history_of(0, 0), history_of(0, 0), 10), 0);
}

TEST(PassJump, AStopInAJumpGivesItUp) {
  EXPECT_FALSE(state_after({1}, {1}, 100, [](const State&) { return std::optional<State>(); }));
}

}  // namespace
}  // namespace railstrata
