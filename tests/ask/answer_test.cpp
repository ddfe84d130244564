#include "ask/judge.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "judge/judgement.hpp"
#include "reader/case_file.hpp"
#include "tests/ask/both_pairs.hpp"

namespace railstrata {
namespace {

using Overrides = std::vector<std::string>;
struct AskOf : testing::TestWithParam<Overrides> {
  Overrides with(Overrides more) const {
    more.insert(more.end(), GetParam().begin(), GetParam().end());
    return more;
  }
};
INSTANTIATE_TEST_SUITE_P(Pairs, AskOf, testing::ValuesIn(kBothPairs),
                         [](const auto& pair) { return pair.param.empty() ? "LMA_CN60" : "S1002_UIC60"; });

Answer solve(const std::vector<std::string>& overrides) {
  const LoadedCase loaded = parse_case("[case]\ntitle = \"from a text\"\n", "none.toml", overrides);
  AskOptions how;
  how.bem.cell = 0.5e-3;
  return ask(loaded.spec, place(loaded.spec, "."), {}, how);
}

void expect_same_bits(const Answer& a, const Answer& b) {
  EXPECT_EQ(a.result.field.p, b.result.field.p);
  EXPECT_EQ(a.result.field.q_x, b.result.field.q_x);
  EXPECT_EQ(a.result.field.q_y, b.result.field.q_y);
  EXPECT_EQ(a.result.rigid_slip.x, b.result.rigid_slip.x);
  ASSERT_TRUE(a.summary.rail.subsurface && b.summary.rail.subsurface);
  EXPECT_EQ(a.summary.rail.subsurface->von_mises.value, b.summary.rail.subsurface->von_mises.value);
}

}  // namespace

TEST_P(AskOf, TwoThreadsAtATimeGetTheBitsOfOneAfterTheOther) {
  const std::vector<Overrides> cases{with({"drive.traction_coefficient=0.1"}),
                                     with({"drive.traction_coefficient=0.3", "geometry.lateral_shift=2 mm"})};
  const Answer first = solve(cases[0]), second = solve(cases[1]);
  EXPECT_NE(first.result.rigid_slip.x, second.result.rigid_slip.x);
  for (int round = 0; round < 3; ++round) {
    Answer a, b;
    std::thread one([&] { a = solve(cases[0]); }), other([&] { b = solve(cases[1]); });
    one.join();
    other.join();
    expect_same_bits(a, first);
    expect_same_bits(b, second);
  }
}

TEST_P(AskOf, GivesPatchForcesStressesAndSummary) {
  const Answer s = solve(with({}));
  EXPECT_EQ(s.summary.title, "from a text");
  EXPECT_EQ(s.summary.run.engine, Engine::bem);
  EXPECT_GT(s.summary.run.threads, 0);
  EXPECT_NEAR(s.result.force.z, -(660 + 8000) * 9.81, 1e-4 * 8660 * 9.81);
  const double deepest = s.summary.rail.subsurface->von_mises.value;
  EXPECT_GT(deepest, 0.3 * s.result.patch.largest_pressure);
  EXPECT_LT(deepest, s.result.patch.largest_pressure);
  const InteriorPoint below = rail_interior(s.result).at({{0, 0, 1e-3}}).front();
  EXPECT_LT(below.stress.zz, -0.5 * s.result.patch.largest_pressure);  // a millimetre below the middle of the patch
}

TEST_P(AskOf, WhatIsWantedLaterIsAddedToTheSameBits) {
  const Overrides overrides = with({"material.rail.yield_strength=400 MPa", "material.wheel.yield_strength=400 MPa"});
  const LoadedCase loaded = parse_case("[case]\ntitle = \"from a text\"\n", "none.toml", overrides);
  const Placement placement = place(loaded.spec, ".");
  AskOptions how;
  how.bem.cell = 0.5e-3;
  Answer in_steps = ask(loaded.spec, placement, kContactAlone, how);
  EXPECT_FALSE(judgement_of(in_steps.summary));
  judge(loaded.spec, {.rail = false, .wheel = false}, in_steps, how);
  const Answer at_once = solve(overrides);
  expect_same_bits(in_steps, at_once);
  EXPECT_EQ(judgement_of(in_steps.summary)->reason, judgement_of(at_once.summary)->reason);
  EXPECT_EQ(in_steps.summary.fatigue.size(), 2U);
}

TEST_P(AskOf, AStaticCaseIsWithoutFriction) {
  const Answer s = solve(with({"run.rolling=false"}));
  EXPECT_EQ(s.result.force.x, 0);
  EXPECT_EQ(s.result.patch.largest_traction, 0);
}

}  // namespace railstrata
