#include "traffic/traffic_range.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "model/material_strength.hpp"
#include "reader/case_file.hpp"
#include "traffic/uncertain_inputs.hpp"

namespace railstrata {
namespace {

constexpr double kBeyond = std::numeric_limits<double>::infinity();

/// A run whose only row is the ductility at the surface.
RangeRun run_of(const std::string& input, double mgt, double followed = 50) {
  RangeRun out{input, input.empty() ? "" : "1"};
  out.result.lives = {{.body = "rail",
                       .zone = "rail",
                       .place = "at the surface",
                       .mechanism = "ductility exhausted",
                       .wheels = {mgt, mgt, mgt},
                       .mgt = {mgt, mgt, mgt},
                       .followed = followed}};
  out.result.wheels = 1;
  out.result.tonnes = 20;
  out.result.reached = 1e9 * followed;
  return out;
}

// A life that is proportional to its ductility has the ends of the ductility.
TEST(TrafficRange, OneInputGivesItsOwnLives) {
  const TrafficRange out = range_of({run_of("", 10), run_of("a", 7), run_of("a", 13)}, {{"a", "life.a"}});
  EXPECT_NEAR(out.lives[0].mgt.low, 7, 1e-12);
  EXPECT_EQ(out.lives[0].mgt.best, 10);
  EXPECT_NEAR(out.lives[0].mgt.high, 13, 1e-12);
  EXPECT_NEAR(out.lives[0].wheels.low, 7e6 / 20, 1e-6) << "of one collective 20 t by one wheel";
  EXPECT_NEAR(out.first.low, 7, 1e-12);
  EXPECT_EQ(out.effects.front().input, "a");
  EXPECT_NEAR(out.effects.front().share, 1, 1e-12);
  EXPECT_EQ(deciding_text(out), "a decides (100 % of the range): 1 to 1 gives 7 MGT to 13 MGT");
}

// ln L of L = x y with equal spreads: √2 times that of one.
TEST(TrafficRange, FactorsOfALifeAddAsSquaresOfLogarithms) {
  const TrafficRange out =
      range_of({run_of("", 10), run_of("a", 8), run_of("a", 12.5), run_of("b", 12.5), run_of("b", 8)},
               {{"a", "life.a"}, {"b", "life.b"}});
  EXPECT_NEAR(out.first.low, 10 * std::pow(0.8, std::sqrt(2.0)), 1e-12);
  EXPECT_NEAR(out.first.high, 10 * std::pow(1.25, std::sqrt(2.0)), 1e-12);
  EXPECT_NEAR(out.effects[0].share, 0.5, 1e-12);
  EXPECT_NEAR(out.effects[1].share, 0.5, 1e-12);
}

TEST(TrafficRange, BothSidesStandApartAndAnEndThatOnlyLengthensLowersNothing) {
  const TrafficRange out = range_of({run_of("", 10), run_of("a", 15), run_of("a", 20)}, {{"a", "life.a"}});
  EXPECT_EQ(out.first.low, 10);
  EXPECT_NEAR(out.first.high, 20, 1e-12) << "the end that goes further";
}

TEST(TrafficRange, TheOrderOfInputsChangesNoBit) {
  std::vector<std::pair<std::string, std::pair<double, double>>> inputs{
      {"a", {7, 13}}, {"b", {9.1, 10.7}}, {"c", {3.3, 31}}, {"d", {10.1, 9.7}}};
  const auto range = [&] {
    std::vector<RangeRun> runs{run_of("", 10)};
    std::vector<NamedInput> names;
    for (const auto& [name, ends] : inputs) {
      names.push_back({name, ""});
      runs.push_back(run_of(name, ends.first));
      runs.push_back(run_of(name, ends.second));
    }
    return range_of(std::move(runs), names);
  };
  const TrafficRange first = range();
  EXPECT_EQ(first.effects.front().input, "c");
  for (int turn = 0; turn < 4; ++turn) {
    std::rotate(inputs.begin(), inputs.begin() + 1, inputs.end());
    const TrafficRange other = range();
    EXPECT_EQ(first.first.low, other.first.low);
    EXPECT_EQ(first.first.high, other.first.high);
    for (std::size_t i = 0; i < first.effects.size(); ++i) {
      EXPECT_EQ(first.effects[i].input, other.effects[i].input);
      EXPECT_EQ(first.effects[i].share, other.effects[i].share);
    }
  }
}

TEST(TrafficRange, ALifeBeyondTheHorizonIsInfiniteAndCountsAsTheHorizonBelow) {
  const TrafficRange out = range_of({run_of("", kBeyond), run_of("a", 20), run_of("a", kBeyond)}, {{"a", ""}});
  EXPECT_NEAR(out.first.low, 20, 1e-12) << "one input alone: its own life, whatever the best one is";
  EXPECT_EQ(out.first.best, kBeyond);
  EXPECT_EQ(out.first.high, kBeyond);
  const TrafficRange high = range_of({run_of("", 20), run_of("a", 10), run_of("a", kBeyond)}, {{"a", ""}});
  EXPECT_EQ(high.first.high, kBeyond);
  EXPECT_NEAR(high.effects.front().share, 1, 1e-12);
  EXPECT_EQ(deciding_text(high), "a decides (100 % of the range): 1 to 1 gives 10 MGT to > 50 MGT");
  const TrafficRange none = range_of({run_of("", kBeyond), run_of("a", kBeyond), run_of("a", kBeyond)}, {{"a", ""}});
  EXPECT_EQ(none.first.low, kBeyond);
  EXPECT_EQ(deciding_text(none), "");
}

TEST(TrafficRange, ARunThatEndedEarlyOrFailedSaysNothing) {
  const TrafficRange early = range_of({run_of("", 20), run_of("a", 15), run_of("a", kBeyond, 12)}, {{"a", ""}});
  EXPECT_EQ(early.first.high, 20);
  EXPECT_FALSE(early.effects.front().known[1]);
  RangeRun failed = run_of("a", 15);
  failed.fault = "no contact";
  const TrafficRange out = range_of({run_of("", 20), failed, run_of("a", 30)}, {{"a", ""}});
  EXPECT_EQ(out.first.low, 20);
  EXPECT_NEAR(out.first.high, 30, 1e-12);
}

TEST(TrafficRange, TheRangeOfTheDamageLawIsAnInput) {
  std::vector<RangeRun> runs{run_of("", 10), run_of("a", 10), run_of("a", 10)};
  runs[0].result.lives[0].mgt = {10.0 / 3, 10, 30};
  const TrafficRange out = range_of(runs, {{"a", ""}});
  EXPECT_NEAR(out.first.low, 10.0 / 3, 1e-12);
  EXPECT_NEAR(out.first.high, 30, 1e-12);
  EXPECT_EQ(out.effects.front().input, kDamageLaw);
}

// Nothing wears, nothing flows: a life is cycles (limit/stress)^8, and the limit has the ends 0.9 and 1.1.
TEST(TrafficRange, ALifeOnALineHasThePowersOfItsLimit) {
  const CaseSpec spec =
      parse_case(
          "[geometry]\nrail_profile = \"arc:R=80 mm\"\nwheel_profile = \"arc:R=-400 mm\"\ncant = 0\n"
          "[material.rail]\nyield_strength = \"3000 MPa\"\nfatigue_limit = \"100 MPa\"\n"
          "dang_van_coefficient = 0.23\nfatigue_exponent = 8\n"
          "[drive]\ntraction_coefficient = 0\nfriction_coefficient = 0\nspin = \"0 1/m\"\n"
          "[life]\nstrength_scatter = 0.05\nwear_scatter = 0\nplace_scatter = \"0 mm\"\n[[load]]\npassages = 1000\n"
          "wheel_load = \"100 kN\"\n",
          "a.toml")
          .spec;
  ClockOptions options;
  options.bem.cell = 1e-3;
  options.horizon = 1e12;
  std::vector<std::string> told;
  Control control;
  control.on_info = [&](const std::string& text) { told.push_back(text); };
  const TrafficRange out = run_range(spec, {}, options, control);
  ASSERT_EQ(out.runs.size(), 3u);
  const InputEffect& strength = out.effects[0].input == "strength" ? out.effects[0] : out.effects[1];
  EXPECT_NEAR(strength.life[0].mgt / out.first.best, std::pow(0.9, 8), 1e-6);
  EXPECT_NEAR(strength.life[1].mgt / out.first.best, std::pow(1.1, 8), 1e-6);
  // and Miner's sum 1/3 to 3, where the stress stays above the limit
  EXPECT_NEAR(std::log(out.first.low / out.first.best), -std::hypot(std::log(3), 8 * std::log(0.9)), 1e-6);
  EXPECT_NE(told.back().find("run 3 of 3, strength × 1.1: first crack"), std::string::npos) << told.back();
  EXPECT_TRUE(control.on_info && !control.on_progress) << "as they were";
}

// ---- inputs of a case

constexpr const char* kCase =
    "[material.rail]\ngrade = \"R260\"\nhardening = \"R260\"\nfatigue_limit = \"100 MPa\"\n[passes]\nductility = 10\n"
    "[drive]\ntraction_coefficient = 0.1\nfriction_coefficient = 0.4\n"
    "[[load]]\nlateral_shift = \"2 mm\"\npassages = 1\n[[load]]\npassages = 2\n";

TEST(UncertainInputs, EveryInputHasTwoDeviationsToBothSides) {
  const auto inputs = uncertain_inputs(parse_case(kCase, "a.toml").spec);
  ASSERT_EQ(inputs.size(), 5u);
  EXPECT_EQ(inputs[0].ends[0].value, "7");
  EXPECT_NEAR(*inputs[0].ends[1].spec.passes.ductility, 13, 1e-12);
  EXPECT_EQ(inputs[1].ends[0].value, "0.28");
  EXPECT_NEAR(inputs[1].ends[1].spec.drive.friction_coefficient, 0.52, 1e-12);
  EXPECT_EQ(inputs[2].ends[0].value, "× 0.93");
  EXPECT_NEAR(inputs[3].ends[0].spec.collective.wear_factor, 0.6, 1e-12);
  EXPECT_EQ(inputs[4].ends[1].value, "+1 mm");
  EXPECT_NEAR(*inputs[4].ends[1].spec.loads[0].lateral_shift, 3e-3, 1e-12);
  EXPECT_NEAR(inputs[4].ends[1].spec.geometry.lateral_shift, 1e-3, 1e-12);
  EXPECT_FALSE(inputs[4].ends[1].spec.loads[1].lateral_shift) << "has the case's";
}

TEST(UncertainInputs, WhatDoesNotScatterOrIsNotThereNeedsNoRun) {
  EXPECT_TRUE(uncertain_inputs(parse_case("[drive]\nfriction_coefficient = 0\ntraction_coefficient = 0\n[life]\n"
                                          "wear_scatter = 0\nplace_scatter = \"0 mm\"\n[[load]]\npassages = 1\n",
                                          "a.toml")
                                   .spec)
                  .empty());
}

// scaled() of material/plastic.hpp, by the keys of a case: of a set, of one that follows a hardness over depth, and of
// a law that is given.
TEST(UncertainInputs, AStrengthScalesTheWholeLawAtEveryDepth) {
  for (const char* strength :
       {"grade = \"R260\"\nhardening = \"R260\"\n",
        "grade = \"R260\"\nhardening = \"R260\"\nhardness_table = [[\"0 mm\", \"400 HV\"], [\"10 mm\", \"300 HV\"]]\n",
        "yield_strength = \"500 MPa\"\nkinematic_hardening = [{modulus = \"100 GPa\", recall = 400}]\n"}) {
    const MaterialSpec material = parse_case(std::string("[material.rail]\n") + strength, "a.toml").spec.rail_material;
    const MaterialSpec stronger = with_strength(material, 1.07);
    const auto before = plastic_law(material, "", ""), after = plastic_law(stronger, "", "");
    ASSERT_TRUE(before && after) << strength;
    for (const double depth : {0.0, 2e-3, 5e-3, 20e-3}) {
      const auto a = scaled(before->at(depth).plastic, 1.07), b = after->at(depth).plastic;
      EXPECT_NEAR(b.yield / a.yield, 1, 1e-12) << strength << depth;
      EXPECT_NEAR(b.saturation, a.saturation, 1e-6);
      for (int k = 0; k < kMostBackstresses; ++k) EXPECT_NEAR(b.modulus[k], a.modulus[k], 1e-3);
    }
  }
}

}  // namespace
}  // namespace railstrata
