#include "judge/judgement.hpp"

#include <gtest/gtest.h>

#include <string>

#include "fatigue/row_strength.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {
namespace {

/// A clad rail that shakes down and a wheel whose surface decides by its factor for wandering traffic.
Summary clad_rail_and_wheel(double wheel) {
  Summary s;
  s.shakedown.bodies.resize(2);
  s.shakedown.bodies[0] = {"rail", {0.7, 1.15, 1.15, 1.15, 1.2}, "layer", 2.5e-3, 0, {}, {}};
  s.shakedown.bodies[1] = {"wheel", {0.8, wheel, wheel, wheel, 1.3}, "wheel", 0, 0, {}, {}};
  s.fatigue.resize(2);
  s.fatigue[0].body = "rail";
  s.fatigue[1].body = "wheel";
  return s;
}

TEST(Judgement, NamesTheBodyAndTheZoneThatDecide) {
  EXPECT_FALSE(judgement_of(Summary()));
  const Judgement no = *judgement_of(clad_rail_and_wheel(0.93));
  EXPECT_EQ(no.lasts, Lasts::no);
  EXPECT_EQ(no.decides, "wheel, at the surface");
  EXPECT_EQ(no.reason, "wheel, at the surface: yields in every passage (load factor to shakedown 0.930)");
  const Judgement yes = *judgement_of(clad_rail_and_wheel(1.2));
  EXPECT_EQ(yes.lasts, Lasts::yes);
  EXPECT_EQ(yes.decides, "layer of the rail, 2.50 mm deep");
  EXPECT_EQ(yes.zone, "rail: layer");
  EXPECT_EQ(no.zone, "wheel");
}

TEST(Judgement, AFactorBelowTheScatterOfStrengthsLastsNarrowly) {
  const Judgement narrow = *judgement_of(clad_rail_and_wheel(1.05));
  EXPECT_EQ(narrow.lasts, Lasts::narrowly);
  EXPECT_EQ(lasts_row(narrow.lasts).tone, "open");
  EXPECT_EQ(judgement_of(clad_rail_and_wheel(1.1))->lasts, Lasts::yes);
}

TEST(Judgement, OneTrackIsNeitherYesNorNo) {
  Summary s = clad_rail_and_wheel(1.2);
  s.shakedown.bodies[1].factors = {0.8, 0.93, 1.02, 1.1, 1.3};
  EXPECT_EQ(judgement_of(s)->lasts, Lasts::one_track);
  EXPECT_EQ(lasts_row(Lasts::one_track).tone, "open");
  s.shakedown.bodies[1].factors.single_track = kNotApplicable;
  EXPECT_EQ(judgement_of(s)->lasts, Lasts::perhaps_one_track);
}

TEST(Judgement, ALayerThatCracksDecidesOverFactorsThatHold) {
  Summary s = clad_rail_and_wheel(1.2);
  s.fatigue[0].brittle = {{"layer", 900e6, 0, 1.2, kNotApplicable, 1e-3}};
  const Judgement cracks = *judgement_of(s);
  EXPECT_EQ(cracks.lasts, Lasts::no);
  EXPECT_EQ(cracks.decides, "layer of the rail, at the surface");
  EXPECT_EQ(cracks.reason,
            "layer of the rail, at the surface: brittle layer cracks (σ₁ is 1.20 of its tensile strength)");
}

TEST(Judgement, NoYesBesideAFailedCheckOrAWarningThatTakesItBack) {
  Summary s = clad_rail_and_wheel(1.2);
  s.warnings = {{"von_mises_above_common_rail_yield", 600e6, 500e6, ""}};
  EXPECT_EQ(judgement_of(s)->lasts, Lasts::yes) << "a warning that leaves the stresses as they are";
  s.warnings = {{"patch_wider_than_layer", 20e-3, 5e-3, ""}};
  EXPECT_EQ(judgement_of(s)->lasts, Lasts::withheld);
  EXPECT_TRUE(judgement_of(s)->reason.starts_with("Patch beyond the layer; ")) << judgement_of(s)->reason;
  s.warnings.clear();
  s.checks = {at_most("F_z_relative_to_weight", 2, 1)};
  EXPECT_EQ(judgement_of(s)->lasts, Lasts::withheld);
  Summary fails = clad_rail_and_wheel(0.93);
  fails.checks = s.checks;
  EXPECT_EQ(judgement_of(fails)->lasts, Lasts::no);
}

TEST(Judgement, NoYesWhereLayersAndFatigueWereNotLookedAt) {
  Summary s = clad_rail_and_wheel(1.2);
  s.fatigue.pop_back();
  EXPECT_EQ(judgement_of(s)->lasts, Lasts::withheld);
  EXPECT_NE(judgement_of(s)->reason.find("wheel"), std::string::npos);
}

TEST(ProcessStress, IsHeldAgainstTheStrengthWhereItIs) {
  CaseSpec spec;
  EXPECT_EQ(largest_process_stress(spec, BodyId::rail).share, 0);
  spec.layers.resize(1);
  LayerSpec& layer = spec.layers[0];
  layer.name = "clad";
  layer.thickness = 2e-3;
  layer.material.strength.yield_strength = 800e6;
  layer.material.strength.initial_stress = {900e6, 900e6};
  const ProcessStress biaxial = largest_process_stress(spec, BodyId::rail);
  EXPECT_NEAR(biaxial.share, 900.0 / 800, 1e-12) << "von Mises of two equal principal stresses";
  EXPECT_EQ(biaxial.zone, "clad");
  EXPECT_EQ(largest_process_stress(spec, BodyId::wheel).share, 0);
  layer.material.strength.initial_stress = {0, -400e6};
  EXPECT_NEAR(largest_process_stress(spec, BodyId::rail).share, 0.5, 1e-12);
}

}  // namespace
}  // namespace railstrata
