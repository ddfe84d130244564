#include "judge/plausibility.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "judge/check_limits.hpp"
#include "tests/judge/whole_summary.hpp"
#include "tests/result/crossed_cylinders.hpp"

namespace railstrata {
namespace {

/// A circular contact on a block of 60 mm: the patch has a diameter of 12 mm.
CaseSpec sphere() { return post_checks::crossed_cylinders(); }

Summary solved(const CaseSpec& spec, double cell = 0.5e-3) {
  BemOptions options;
  options.cell = cell;
  return whole_summary(spec, solve_bem(spec, place(spec, {}), options));
}

/// Null where the summary does not warn of it.
const Warning* find(const Summary& s, const std::string& name) {
  const auto found =
      std::find_if(s.warnings.begin(), s.warnings.end(), [&](const Warning& w) { return w.name == name; });
  return found == s.warnings.end() ? nullptr : &*found;
}

bool holds(const Summary& s, const std::string& name) {
  return std::all_of(s.checks.begin(), s.checks.end(), [&](const Check& c) { return c.name != name || c.ok; });
}

/// A sound half-space summary with a patch of 12 x 12 mm, on which single numbers can be changed.
struct Sound {
  CaseSpec spec = sphere();
  Summary summary;
  PatchSurroundings around;
  Sound() {
    summary.run.engine = Engine::bem;
    summary.contact.patch.p_max = 1e9;
    summary.contact.patch.length = summary.contact.patch.width = 12e-3;
    summary.contact.contact_angle = 0;
    around.flange = FlangePlace{28e-3, 0.5e-3, -30e-3};
    around.curvature_rolling = 1 / 0.42;
  }
  std::vector<std::string> warnings(double element = 0.25e-3) const {
    std::vector<std::string> out;
    for (const Warning& w : implausible(summary, spec, around, element)) out.push_back(w.name);
    return out;
  }
};
using Names = std::vector<std::string>;

TEST(Plausibility, ASoundResultIsSilent) {
  EXPECT_EQ(Sound().warnings(), Names{});
  const Summary s = solved(sphere());
  EXPECT_TRUE(std::all_of(s.warnings.begin(), s.warnings.end(),
                          [](const Warning& w) { return w.name == "von_mises_above_common_rail_yield"; }));
}

TEST(Plausibility, EachLimitSpeaksAboveAndIsSilentBelow) {
  Sound s;
  EXPECT_EQ(s.warnings(1.3e-3), Names{"few_cells_over_patch"});
  EXPECT_EQ(s.warnings(1.1e-3), Names{});
  s.around.edges.angle_spanned = 1.01 * kLargestAngleSpanned;
  EXPECT_EQ(s.warnings(), Names{"patch_spans_angle"});
  s.around.edges.angle_spanned *= 0.98;
  s.around.edges.half_width_over_radius = 1.01 * kLargestOfRadius;
  EXPECT_EQ(s.warnings(), Names{"patch_large_against_radius"});
  s.around.edges.half_width_over_radius *= 0.98;
  s.around.curvature_rolling = 2.02 * kLargestOfRadius / 12e-3;
  EXPECT_EQ(s.warnings(), Names{"patch_large_against_radius"});
  s.around.curvature_rolling *= 0.98;
  s.around.edges.edge_share = 1.01 * kLargestOfEdgeDistance;
  EXPECT_EQ(s.warnings(), Names{"patch_near_edge"});
  s.around.edges.edge_share *= 0.98;
  s.around.flange->contact_depth = 26.1e-3;
  EXPECT_EQ(s.warnings(), Names{"contact_on_flange_crest"});
  s.around.flange->contact_depth = 25.9e-3;
  s.around.flange->beyond_gauge = 1e-3;
  EXPECT_EQ(s.warnings(), Names{"flange_outside_gauge"});
  s.around.flange->beyond_gauge = -1e-3;
  s.around.bent_by_others = 1.01 * kLargestBending;
  EXPECT_EQ(s.warnings(), Names{"patches_near_each_other"});
  s.around.bent_by_others *= 0.98;
  EXPECT_EQ(s.warnings(), Names{});
  s.summary.life.groove = 1.01 * kGroove;
  EXPECT_EQ(s.warnings(), Names{"wheels_in_one_track"});
  s.summary.life.groove *= 0.98;
  EXPECT_EQ(s.warnings(), Names{});
  s.spec.third_body.thickness = 20e-6;
  s.spec.third_body.shear_modulus = 100e6;
  s.summary.contact.patch.q_max_point = 1.01 * kLargestFilmShear * 6e-3 * 100e6 / 20e-6;
  EXPECT_EQ(s.warnings(), Names{"soft_film"});
  s.summary.contact.patch.q_max_point *= 0.98;
  EXPECT_EQ(s.warnings(), Names{});
}

// 20 um of clay is silent (0.7 % at 0.2 of the weight); a jelly of 1 MPa has creepages beyond one and fails.
TEST(Plausibility, AFilmThatIsNoFilmFailsTheCheck) {
  CaseSpec spec = sphere();
  spec.drive.friction_coefficient = 0.5;
  spec.drive.traction_coefficient = 0.2;
  spec.third_body.thickness = 20e-6;
  spec.third_body.shear_modulus = 106e6;
  const Summary clay = solved(spec, 1e-3);
  EXPECT_EQ(find(clay, "soft_film"), nullptr);
  EXPECT_TRUE(holds(clay, "film_of_patch"));
  spec.third_body.shear_modulus = 0.5e6;
  const Summary jelly = solved(spec, 1e-3);
  EXPECT_NE(find(jelly, "soft_film"), nullptr);
  EXPECT_FALSE(holds(jelly, "film_of_patch"));
}

TEST(Plausibility, FiniteElementsAreAskedForWhatTheyCannotDoAlone) {
  Sound s;
  s.summary.run.engine = Engine::fem;
  s.spec.mesh.element_size = 1e-3;
  s.around.edges = {1.0, 1.0, 0.9, "the side of the rail"};
  EXPECT_EQ(s.warnings(1e-3), Names{}) << "a mesh has the profiles and the edges";
  EXPECT_EQ(s.warnings(1.1e-3), Names{}) << "ten elements";
  EXPECT_EQ(s.warnings(1.3e-3), Names{"few_cells_over_patch"});
  s.around.second = SecondContact{5e-6, -33e-3, -38e-3, 1.0};
  EXPECT_EQ(s.warnings(1e-3), Names{"second_contact"});
}

TEST(Plausibility, APatchThatReachesBeyondALayerIsToldWhereverItStands) {
  Sound s;
  s.spec.layers.push_back({});
  s.spec.layers[0].width = 40e-3;
  s.around.rail_reach = 19e-3;
  EXPECT_EQ(s.warnings(), Names{});
  s.around.rail_reach = 21e-3;
  EXPECT_EQ(s.warnings(), Names{"patch_wider_than_layer"});
  s.spec.layers[0].thickness_table = {{-20e-3, 1e-3}, {20e-3, 0.5e-3}};
  s.around.layer_change = 0.05;
  EXPECT_EQ(s.warnings(), Names{});
  s.around.layer_change = 0.15;
  EXPECT_EQ(s.warnings(), Names{"layer_varies_below_patch"});
}

TEST(Plausibility, TensionThatStillRisesAtTheRimIsToldWhereItCounts) {
  Sound s;
  s.summary.rail.matrix = StressPair{{400e6, 0, 0, 3e-3}, {11e6, 8e-3, 0, 3e-3, true}};
  EXPECT_EQ(s.warnings(), Names{"stress_maximum_at_rim"});
  s.summary.rail.matrix->sigma1.value = 9e6;
  EXPECT_EQ(s.warnings(), Names{}) << "below 1 % of the largest pressure";
}

// The text has the places of both.
TEST(Plausibility, ASecondContactNamesBothPlaces) {
  Sound s;
  s.around.rail_y = -4e-3;
  s.around.wheel_y = 6e-3;
  s.summary.run.engine = Engine::fem;
  s.spec.mesh.element_size = 1e-3;
  s.around.second = SecondContact{5e-6, -33e-3, -38e-3, 0.5};
  const std::string text = implausible(s.summary, s.spec, s.around, 0.25e-3).at(0).text;
  for (const char* part : {"first place: y = -4.0 mm of the rail, 6.0 mm of the wheel, at 0.0°",
                           "second place: y = -33.0 mm of the rail, -38.0 mm of the wheel, at 28.6°"})
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(Plausibility, TextsHaveTheNumbersInUnitsOfThePage) {
  Sound s;
  s.summary.rail.subsurface = StressPair{};
  s.summary.rail.subsurface->von_mises.value = 652.4e6;
  s.spec.mesh.element_size = 1e-3;
  const std::vector<Warning> all = implausible(s.summary, s.spec, s.around, 0.25e-3);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].value, 652.4e6);
  EXPECT_NE(all[0].text.find(" steels (652 MPa, limit 500 MPa): "), std::string::npos) << all[0].text;
}

// Largest pressures of this sphere: within 1 % at six cells across the patch, 8.5 % off at two and a half.
TEST(Plausibility, CoarseCellsAreToldAndUselessOnesFail) {
  const Summary fine = solved(sphere(), 1e-3), coarse = solved(sphere(), 2e-3), useless = solved(sphere(), 5e-3);
  EXPECT_EQ(find(fine, "few_cells_over_patch"), nullptr);
  ASSERT_NE(find(coarse, "few_cells_over_patch"), nullptr);
  EXPECT_TRUE(holds(coarse, "cell_of_patch"));
  EXPECT_FALSE(holds(useless, "cell_of_patch"));
}

TEST(Plausibility, APatchAsWideAsItsBlockIsTold) {
  CaseSpec spec = sphere();
  spec.geometry.block_width = 56e-3;
  spec.rail_material.young = spec.wheel_material.young = 4e9;  // a patch of 46 mm
  const Summary s = solved(spec, 1e-3);
  ASSERT_NE(find(s, "patch_near_edge"), nullptr);
  EXPECT_NE(find(s, "patch_near_edge")->text.find("the side of the block"), std::string::npos);
  EXPECT_NE(find(s, "patch_large_against_radius"), nullptr);
  EXPECT_EQ(find(solved(sphere()), "patch_near_edge"), nullptr);
}

// A wheel hollow by 301 mm fills an arc of 300 mm: the patch would be wider than the 60 mm of both.
TEST(Plausibility, APatchCutOffByTheEndOfAProfileFailsAndIsTold) {
  CaseSpec spec = sphere();
  spec.geometry.rail_profile = "arc:R=300 mm";
  spec.geometry.wheel_profile = "arc:R=-301 mm";
  spec.geometry.rail_shape = RailShape::rail;
  const Summary cut = solved(spec, 1e-3);
  EXPECT_FALSE(holds(cut, "patch_cut_off"));
  ASSERT_NE(find(cut, "patch_near_edge"), nullptr);
  EXPECT_NE(find(cut, "patch_near_edge")->text.find("here the side of the rail at y = -30.0 mm"), std::string::npos)
      << find(cut, "patch_near_edge")->text;
  EXPECT_GT(find(cut, "patch_near_edge")->value, 0.95);
  EXPECT_TRUE(holds(cut, "patch_reaches_edge_of_grid")) << "the grid is larger";

  spec.geometry.wheel_profile = "arc:R=-310 mm";  // 50 mm of the 60
  const Summary near = solved(spec, 1e-3);
  EXPECT_TRUE(holds(near, "patch_cut_off"));
  EXPECT_NE(find(near, "patch_near_edge"), nullptr);
  spec.geometry.wheel_profile = "flat";
  const Summary far = solved(spec, 1e-3);
  EXPECT_TRUE(holds(far, "patch_cut_off"));
  EXPECT_EQ(find(far, "patch_near_edge"), nullptr);

  spec.geometry.wheel_profile = "arc:R=-310 mm";
  spec.geometry.rail_shape = RailShape::block;
  spec.geometry.block_width = 48e-3;
  EXPECT_FALSE(holds(solved(spec, 1e-3), "patch_cut_off")) << "pressure beyond the block";
}

// Elastic stresses of 3 GPa are no steel's: half-spaces say so as finite elements do.
TEST(Plausibility, HalfSpacesWarnOfYieldAndOfAWheelOnItsFlange) {
  CaseSpec spec;
  spec.geometry.lateral_shift = 50e-3;
  const Summary derailed = solved(spec);
  EXPECT_NE(find(derailed, "von_mises_above_common_rail_yield"), nullptr);
  EXPECT_NE(find(derailed, "contact_on_flange_crest"), nullptr);
  EXPECT_NE(find(derailed, "flange_outside_gauge"), nullptr);
  CaseSpec light = sphere();
  light.vehicle.wheel_mass = light.vehicle.sprung_mass = 200;
  EXPECT_EQ(find(solved(light), "von_mises_above_common_rail_yield"), nullptr);
  spec.rail_material.strength.yield_strength = 480e6;
  EXPECT_EQ(find(solved(spec), "von_mises_above_common_rail_yield"), nullptr) << "its own strength is known";
}

// Gauge corner of 13 mm in a flange root of 14 mm.
TEST(Plausibility, ConformalContactIsTold) {
  CaseSpec spec = sphere();
  spec.geometry.rail_profile = "arc:R=30 mm";
  spec.geometry.wheel_profile = "arc:R=-31 mm";
  const Summary s = solved(spec);
  ASSERT_NE(find(s, "patch_spans_angle"), nullptr);
  EXPECT_GT(find(s, "patch_spans_angle")->value, kLargestAngleSpanned);
}

TEST(SubsurfaceBegin, IsATenthOfTheShorterSemiAxisOrHalfAThinLayer) {
  PatchMeasures patch;
  patch.length = 12e-3;
  patch.width = 16e-3;
  EXPECT_DOUBLE_EQ(subsurface_begin(patch, HUGE_VAL), 0.6e-3);
  EXPECT_DOUBLE_EQ(subsurface_begin(patch, 0.2e-3), 0.1e-3);
}

}  // namespace
}  // namespace railstrata
