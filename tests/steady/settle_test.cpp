#include "steady/settle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace railstrata {
namespace {

constexpr int kModes = 60;

/// Rates from 1 down to 1e-4, a wheel.
double rate_of(int k) { return std::pow(10.0, -4.0 * k / (kModes - 1)); }

StateChange towards(const std::vector<double>& state, const std::vector<double>& end) {
  StateChange out;
  for (int k = 0; k < kModes; ++k) {
    out.mean.push_back(rate_of(k) * (end[k] - state[k]));
    out.pace.push_back(1);
    out.flow += out.mean.back() * out.mean.back();
  }
  out.flow = std::sqrt(out.flow);
  return out;
}

TEST(Settle, IsTheImplicitStepOfADecay) {
  std::vector<double> from(kModes, 0.0), end(kModes), scale(kModes, 1.0);
  for (int k = 0; k < kModes; ++k) end[k] = 1 + 0.1 * k;
  const auto change = [&](const std::vector<double>& s) { return towards(s, end); };
  for (const double wheels : {1.0, 30.0, 1e3, 1e5}) {
    const SettledState out = settle(from, change(from), wheels, scale, change, {.tolerance = 1e-3, .changes = 2000});
    EXPECT_LE(out.unsettled, 1e-3) << wheels;
    for (int k = 0; k < kModes; k += 20) {
      const double exact = wheels * rate_of(k) * end[k] / (1 + wheels * rate_of(k));
      EXPECT_NEAR(out.state[k] / exact, 1, 0.02) << wheels << " " << k;
    }
  }
}

TEST(Settle, ChangesGoWithTheRootOfTheWheels) {
  std::vector<double> from(kModes, 0.0), end(kModes, 1.0), scale(kModes, 1.0);
  const auto change = [&](const std::vector<double>& s) { return towards(s, end); };
  const int few = settle(from, change(from), 100, scale, change, {.tolerance = 0.03, .changes = 5000}).changes;
  const int many = settle(from, change(from), 1e4, scale, change, {.tolerance = 0.03, .changes = 5000}).changes;
  EXPECT_LT(few, 100);
  EXPECT_LT(many, 1000) << "descent without acceleration takes as many changes as wheels";
}

TEST(Settle, StopsAtAnObstacle) {
  // what is pushed on by 0.01 a wheel stops where all that is above its limit is taken back: kinked there
  const std::vector<double> from(3, 0.0), scale(3, 1.0);
  const auto change = [](const std::vector<double>& s) {
    StateChange out;
    for (int k = 0; k < 3; ++k) {
      const double limit = 0.5 * (k + 1);
      out.mean.push_back(s[k] > limit ? 0.01 - (s[k] - limit) : 0.01);
      out.pace.push_back(1);
    }
    out.flow = 0.02;
    return out;
  };
  const SettledState out = settle(from, change(from), 1e4, scale, change, {.tolerance = 1e-4, .changes = 2000});
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(out.state[k], 0.5 * (k + 1) + 0.01, 1e-3);
}

TEST(Settle, WhatOnlyGrowsGrowsByTheWheels) {
  const auto change = [](const std::vector<double>&) { return StateChange{.mean = {2e-5}, .pace = {0}, .flow = 2e-5}; };
  const SettledState out = settle({1}, change({}), 1e5, std::vector<double>{1}, change);
  EXPECT_NEAR(out.state[0], 3, 1e-12);
}

TEST(Settle, AskedToStopItThrows) {
  Control control;
  control.stop = true;
  const auto change = [](const std::vector<double>&) { return StateChange{.mean = {2e-5}, .pace = {1}, .flow = 2e-5}; };
  EXPECT_THROW(settle({1}, change({}), 1e5, std::vector<double>{1}, change, {.control = &control}), std::exception);
}

}  // namespace
}  // namespace railstrata
