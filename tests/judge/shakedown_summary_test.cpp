#include "fatigue/shakedown_summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/faults.hpp"
#include "judge/judgement.hpp"
#include "tests/result/crossed_cylinders.hpp"

namespace railstrata {
namespace {

using post_checks::crossed_cylinders;

BemOptions cells(double size) {
  BemOptions options;
  options.cell = size;
  return options;
}

struct Found {
  double p0_over_k = 0;
  ShakedownFactors factors;
  BodyShakedown body;
  /// p0/k at which the contact would reach the limit.
  double limit(double ShakedownFactors::*factor) const { return p0_over_k * factors.*factor; }
};

Found shakedown_of(const CaseSpec& spec, double cell, bool track = false) {
  const BemResult r = solve_bem(spec, place(spec, {}), cells(cell));
  std::vector<SectionShakedown> sections = half_space_shakedown(spec, r);
  if (track) add_single_track(spec, r, sections);
  const ShakedownSummary s = shakedown_summary(spec, sections);
  const double k = spec.rail_material.strength.yield_strength.value() / std::numbers::sqrt3;
  return {r.patch.largest_pressure / k, s.bodies.at(0).factors, s.bodies.at(0)};
}

CaseSpec frictionless() {
  CaseSpec spec = crossed_cylinders();
  spec.rail_material.strength.yield_strength = 500e6;
  return spec;
}

// Circular Hertz pressure, nu = 0.3: first yield at p0/k = 2.795, shakedown 4.632 (residual stress of depth alone) and
// at most 4.677 [Johnson1985 sec. 9.2]; docs/damage-verification.md.
TEST(ShakedownSummary, OfACircularContactIsThatOfHertzsStresses) {
  const Found found = shakedown_of(frictionless(), 0.25e-3);
  EXPECT_NEAR(found.limit(&ShakedownFactors::first_yield) / 2.795, 1, 5e-3);
  EXPECT_NEAR(found.limit(&ShakedownFactors::wandering) / 4.632, 1, 5e-3);
  EXPECT_NEAR(found.limit(&ShakedownFactors::upper) / 4.677, 1, 5e-3);
  EXPECT_EQ(found.body.zone, "rail");
}

TEST(ShakedownSummary, ALayerOfTheRailsOwnStiffnessAndStrengthChangesNothing) {
  const CaseSpec plain = frictionless();
  CaseSpec layered = plain;
  layered.layers.resize(1);
  layered.layers[0].thickness = 1.3e-3;
  layered.layers[0].material = plain.rail_material;
  const Found a = shakedown_of(plain, 0.25e-3), b = shakedown_of(layered, 0.25e-3);
  for (const auto factor : {&ShakedownFactors::first_yield, &ShakedownFactors::wandering, &ShakedownFactors::upper,
                            &ShakedownFactors::kinematic})
    EXPECT_NEAR(a.factors.*factor / (b.factors.*factor), 1, 1e-3);
  EXPECT_EQ(b.body.zones.size(), 2u);
}

TEST(ShakedownSummary, OnlyTheBodyThatTheCaseAsksAboutIsJudged) {
  CaseSpec spec = frictionless();
  spec.wheel_material.strength.yield_strength = 300e6;
  const BemResult r = solve_bem(spec, place(spec, {}), cells(0.5e-3));
  const auto judged_by = [&](JudgedBodies asked) {
    spec.run.judged = asked;
    return shakedown_summary(spec, half_space_shakedown(spec, r));
  };
  const ShakedownSummary both = judged_by(JudgedBodies::both), rail = judged_by(JudgedBodies::rail);
  ASSERT_EQ(both.bodies.size(), 2u);
  EXPECT_EQ(both.governing()->body, "wheel");
  ASSERT_EQ(rail.bodies.size(), 1u);
  EXPECT_EQ(rail.governing()->body, "rail");
  EXPECT_EQ(rail.bodies[0].factors.wandering, both.bodies[0].factors.wandering);
  EXPECT_EQ(rail.bodies[0].notes.at(0), "the wheel is not judged: run.judged = \"rail\"");
  EXPECT_EQ(judged_by(JudgedBodies::wheel).bodies.at(0).body, "wheel");
  spec.rail_material.strength.yield_strength.reset();
  EXPECT_TRUE(strength_to_judge(spec));
  spec.run.judged = JudgedBodies::rail;
  EXPECT_FALSE(strength_to_judge(spec));
}

TEST(SlowShakedownSummary, HalfTheCellsGiveTheSameFactors) {
  CaseSpec spec = frictionless();
  spec.drive.friction_coefficient = 0.25;
  spec.drive.traction_coefficient = 0.2;
  const Found coarse = shakedown_of(spec, 0.25e-3), fine = shakedown_of(spec, 0.125e-3);
  for (const auto factor : {&ShakedownFactors::first_yield, &ShakedownFactors::wandering, &ShakedownFactors::upper,
                            &ShakedownFactors::kinematic})
    EXPECT_NEAR(coarse.factors.*factor / (fine.factors.*factor), 1, 5e-3)
        << coarse.factors.*factor << " at " << coarse.body.depth;
}

// The residual stress of one track holds shear that depth alone cannot: with slip at 0.2 by 16 % (docs/damage.md).
TEST(SlowShakedownSummary, OneTrackLiesBetweenAnyTrafficAndTheUpperBound) {
  CaseSpec spec = frictionless();
  const Found free = shakedown_of(spec, 0.5e-3, true);
  EXPECT_EQ(free.factors.single_track, free.factors.wandering) << "within 2 % of the bound";
  spec.drive.friction_coefficient = 0.2;
  spec.drive.creepage = -0.3;
  const Found sliding = shakedown_of(spec, 0.5e-3, true);
  EXPECT_NEAR(sliding.limit(&ShakedownFactors::wandering) / 3.683, 1, 0.01);
  EXPECT_NEAR(sliding.limit(&ShakedownFactors::single_track) / 4.29, 1, 0.02);
  EXPECT_LE(sliding.factors.single_track, sliding.factors.upper);
}

// Plane strain, full slip: first yield, shakedown and kinematic limit of docs/damage-verification.md; p0/k.
TEST(ShakedownSummary, OfALineContactIsTheClosedFormsStress) {
  CaseSpec spec = frictionless();
  spec.geometry.contact = ContactShape::line;
  spec.geometry.line_length = 20e-3;
  spec.geometry.rail_profile = spec.geometry.wheel_profile = "flat";
  spec.geometry.wheel_radius = 0.5;
  spec.drive.creepage = -0.3;
  struct Row {
    double friction, first_yield, wandering, kinematic;
  };
  for (const Row& row : {Row{0, 3.107, 4.0, 4.0}, Row{0.2, 2.936, 3.202, 3.944}, Row{0.4, 2.123, 2.319, 2.407}}) {
    spec.drive.friction_coefficient = row.friction;
    const Found found = shakedown_of(spec, 0.125e-3, true);
    EXPECT_NEAR(found.limit(&ShakedownFactors::first_yield) / row.first_yield, 1, 5e-3) << row.friction;
    EXPECT_NEAR(found.limit(&ShakedownFactors::wandering) / row.wandering, 1, 5e-3) << row.friction;
    EXPECT_NEAR(found.limit(&ShakedownFactors::kinematic) / row.kinematic, 1, 5e-3) << row.friction;
    EXPECT_EQ(found.factors.single_track, found.factors.wandering) << "one line is every line";
  }
}

// The same circle from one solution without friction: docs/damage-verification.md at 0 and with full slip at 0.2, p0/k.
TEST(SlidingMap, OfACircularContactMeetsTheNumbersWithAndWithoutFriction) {
  const CaseSpec spec = frictionless();
  const BemResult r = solve_bem(spec, place(spec, {}), cells(0.25e-3));
  const std::vector<SlidingMap> maps = sliding_maps(r, half_space_shakedown(spec, r));
  ASSERT_EQ(maps.size(), 1u);
  EXPECT_EQ(maps[0].p_max, r.patch.largest_pressure);
  ASSERT_EQ(maps[0].limits.size(), 13u);
  const double p0_over_k = r.patch.largest_pressure / (500e6 / std::numbers::sqrt3);
  const auto expect = [&](std::size_t at, double traction, double yield, double wandering, double upper) {
    const SlidingLimit& l = maps[0].limits[at];
    EXPECT_NEAR(l.traction, traction, 1e-12);
    EXPECT_NEAR(p0_over_k * l.factors.first_yield / yield, 1, 5e-3);
    EXPECT_NEAR(p0_over_k * l.factors.wandering / wandering, 1, 5e-3);
    EXPECT_NEAR(p0_over_k * l.factors.upper / upper, 1, 5e-3);
  };
  expect(0, 0, 2.795, 4.632, 4.677);
  expect(4, 0.2, 2.717, 3.683, 4.584);
  for (std::size_t i = 1; i < maps[0].limits.size(); ++i)
    EXPECT_LT(maps[0].limits[i].factors.wandering, maps[0].limits[i - 1].factors.wandering);
}

TEST(Verdict, TheFirstLevelThatBearsTheLoadDecides) {
  const auto words = [](double yield, double wandering, double track, double upper, double kinematic) {
    return verdict_text(verdict_of(ShakedownFactors{yield, wandering, track, upper, kinematic}));
  };
  EXPECT_EQ(words(1.0, 1.2, 1.3, 1.4, 1.5), "stays elastic");
  EXPECT_EQ(words(0.9, 1.0, 1.3, 1.4, 1.5), "shakes down");
  EXPECT_EQ(words(0.9, 0.99, 1.0, 1.4, 1.5), "shakes down in one track");
  EXPECT_EQ(words(0.9, 0.99, kNotApplicable, 1.4, 1.5), "may shake down in one track");
  EXPECT_EQ(words(0.8, 0.9, 0.99, 0.99, 1.5), "yields in every passage");
  EXPECT_EQ(words(0.8, 0.9, 0.9, 0.95, 0.99), "ratchets");
  ShakedownSummary both;
  both.bodies.resize(2);
  both.bodies[0].factors = {0.9, 1.1, 1.1, 1.2, 1.3};
  both.bodies[1].factors = {1.5, 2, 2, 2, 2};
  EXPECT_EQ(verdict_of(both), Verdict::shakes_down);
}

TEST(Verdict, ALayerMayEndByItsBrittlenessOrByItsBond) {
  Summary s;
  s.shakedown.bodies.resize(1);
  s.shakedown.bodies[0].factors = {0.9, 1.1, 1.1, 1.2, 1.3};
  EXPECT_TRUE(fails_by(s).empty());
  s.fatigue.resize(1);
  s.fatigue[0].body = "rail";
  s.fatigue[0].brittle.resize(2);
  s.fatigue[0].brittle[0] = {"hard", 900e6, 0, 1.2, 1e-4, 1e-3};
  s.fatigue[0].brittle[1] = {"rail", 950e6, 0, 1.3, 1e-5};
  s.fatigue[0].interfaces.resize(2);
  s.fatigue[0].interfaces[0].delamination = 0.99;
  EXPECT_EQ(fails_by(s), std::vector<Verdict>{Verdict::layer_cracks});
  s.fatigue[0].interfaces[1].delamination = 1;
  s.shakedown.bodies[0].factors.kinematic = s.shakedown.bodies[0].factors.upper = 0.9;
  s.shakedown.bodies[0].factors.single_track = s.shakedown.bodies[0].factors.wandering = 0.9;
  EXPECT_EQ(fails_by(s), (std::vector<Verdict>{Verdict::ratchets, Verdict::layer_cracks, Verdict::interface_shears}));
  const LayerWorst worst = layer_worst(s);
  EXPECT_EQ(worst.share_of_tensile, 1.2) << "the rail itself is no layer";
  EXPECT_EQ(worst.critical_flaw, 1e-4);
  EXPECT_EQ(worst.delamination, 1);
  EXPECT_TRUE(std::isnan(worst.shear_range)) << "not known";
}

TEST(ShakedownSummary, AZoneWithoutAStrengthIsTold) {
  CaseSpec spec = frictionless();
  spec.rail_material.strength.yield_strength.reset();
  spec.rail_material.strength.grade = "B320";  // whose yield strength nobody states
  spec.layers.resize(1);
  spec.layers[0].name = "clad";
  spec.layers[0].thickness = 1e-3;
  spec.layers[0].material = spec.rail_material;
  spec.layers[0].material.strength = {};
  spec.layers[0].material.strength.yield_strength = 900e6;
  const std::vector<SectionShakedown> found =
      half_space_shakedown(spec, solve_bem(spec, place(spec, {}), cells(0.5e-3)));
  ASSERT_EQ(found.size(), 1u);
  ASSERT_EQ(found[0].strength.notes.size(), 1u);
  EXPECT_EQ(found[0].strength.notes[0],
            "yield strength of rail: not known of grade B320; it is taken to stay elastic and is not judged: give "
            "material.rail.yield_strength");
  ASSERT_EQ(found[0].fatigue.brittle.size(), 2u);
  EXPECT_NEAR(found[0].fatigue.brittle[0].thickness, 1e-3, 1e-9);
  EXPECT_TRUE(std::isnan(found[0].fatigue.brittle[1].thickness));
}

// Where the surface decides, behind a strip of slip of three cells.
TEST(SlowShakedownSummary, SaysWhereAStripOfSlipIsTooShortForItsCells) {
  CaseSpec spec;
  spec.rail_material.strength.yield_strength = 480e6;
  spec.drive.friction_coefficient = 0.5;
  const auto notes = [&](double traction, double cell) {
    spec.drive.traction_coefficient = traction;
    return half_space_shakedown(spec, solve_bem(spec, place(spec, {}), cells(cell))).at(0).notes;
  };
  ASSERT_EQ(notes(0.1, 0.25e-3).size(), 1u);
  EXPECT_EQ(notes(0.1, 0.25e-3)[0].find("the surface decides where the slip zone is "), 0u);
  EXPECT_TRUE(notes(0.3, 0.25e-3).empty());
}

TEST(ShakedownSummary, ProcessStressMovesFirstYieldAlone) {
  CaseSpec spec = frictionless();
  const Found without = shakedown_of(spec, 0.5e-3);
  spec.rail_material.strength.initial_stress = {-200e6, -100e6};
  const Found with = shakedown_of(spec, 0.5e-3);
  EXPECT_NE(with.factors.first_yield, without.factors.first_yield);
  EXPECT_EQ(with.factors.wandering, without.factors.wandering);
}

TEST(ShakedownSummary, AStrengthTableThatEndsTooEarlyIsToldWithItsPlace) {
  CaseSpec spec = frictionless();
  spec.rail_material.strength.yield_strength.reset();
  spec.rail_material.strength.strength_table = {{0, 800e6}, {3e-3, 500e6}};
  try {
    half_space_shakedown(spec, solve_bem(spec, place(spec, {}), cells(0.5e-3)));
    FAIL();
  } catch (const CaseError& e) {
    EXPECT_NE(std::string(e.what()).find("material.rail.strength_table: ends at 3 mm, stresses are looked at down to"),
              std::string::npos)
        << e.what();
  }
  spec.rail_material.strength.strength_table.push_back({0.1, 500e6});
  EXPECT_EQ(half_space_shakedown(spec, solve_bem(spec, place(spec, {}), cells(0.5e-3))).size(), 1u);
}

TEST(ShakedownSummary, OfBodiesWithoutAStrengthThereIsNone) {
  CaseSpec spec = frictionless();
  spec.rail_material.strength.yield_strength.reset();
  const BemResult r = solve_bem(spec, place(spec, {}), cells(0.5e-3));
  EXPECT_TRUE(half_space_shakedown(spec, r).empty());
  spec.wheel_material.strength.grade = "ER8";
  const std::vector<SectionShakedown> wheel = half_space_shakedown(spec, r);
  ASSERT_EQ(wheel.size(), 1u);
  EXPECT_EQ(wheel[0].body, BodyId::wheel);
  EXPECT_FALSE(wheel[0].strength.notes.empty()) << "an estimate is reported";
}

}  // namespace
}  // namespace railstrata
