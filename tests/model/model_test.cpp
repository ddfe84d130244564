#include "model/model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/faults.hpp"

namespace railstrata {
namespace {

constexpr double kRadius = 0.43, kYoung = 210e9;

// A disc on a rail of the same lateral radius: a circular Hertzian contact, on a mesh of few elements.
CaseSpec crossed_cylinders() {
  CaseSpec spec;
  spec.geometry.rail_profile = "arc:R=430 mm";
  spec.geometry.wheel_profile = "flat";
  spec.geometry.rail_shape = RailShape::block;
  spec.geometry.wheel_shape = WheelShape::disc;
  spec.geometry.wheel_radius = kRadius;
  spec.geometry.cant = 0;
  spec.geometry.wheel_section.bore_radius = 0.25;
  spec.geometry.block_width = 0.05;
  spec.mesh.element_size = 4e-3;
  spec.mesh.fine_width = 32e-3;
  spec.mesh.coarse_ratio = 2;
  spec.mesh.largest = 20e-3;
  spec.mesh.end_length = 0.06;
  spec.run.rolling = false;
  return spec;
}

}  // namespace

TEST(BuildModel, ALayerWithoutAWidthCoversANarrowerBlock) {
  CaseSpec spec = crossed_cylinders();
  spec.layers.emplace_back().thickness = 1e-3;
  EXPECT_GT(build_model(spec, {}).rail.elements(), 0);
  spec.layers[0].width = 0.055;
  EXPECT_THROW(build_model(spec, {}), CaseError);
}

namespace {

LayerSpec graded(BodyId on, std::vector<ModulusPoint> table, int elements) {
  LayerSpec layer;
  layer.on = on;
  layer.width = 0.02;
  layer.thickness = table.back().depth;
  layer.young_table = std::move(table);
  layer.elements = elements;
  return layer;
}

TEST(Place, ADiscStandsOnTheCrownWithItsAxleAtItsRadius) {
  const RigidContact c = place(crossed_cylinders(), {}).contact;
  EXPECT_NEAR(c.axle_height, kRadius, 1e-9);
  EXPECT_NEAR(c.point.y, 0, 1e-6);
  EXPECT_NEAR(c.point.z, 0, 1e-9);
  EXPECT_NEAR(c.angle, 0, 1e-6);
  EXPECT_NEAR(c.rolling_radius, kRadius, 1e-9);
  EXPECT_NEAR(c.curvature_rail_lateral, 1 / kRadius, 1e-6);
  EXPECT_NEAR(c.curvature_wheel_lateral, 0, 1e-9);
  EXPECT_NEAR(c.curvature_rolling, 1 / kRadius, 1e-6);
}

TEST(Place, AnUnknownProfileIsACaseErrorThatNamesIt) {
  CaseSpec spec = crossed_cylinders();
  spec.geometry.rail_profile = "CN61";
  try {
    place(spec, {});
    FAIL();
  } catch (const CaseError& e) {
    EXPECT_NE(std::string(e.what()).find("CN61"), std::string::npos) << e.what();
  }
}

TEST(BuildModel, AnUnbondedStretchLiesBeyondTheReachOfTheWheelAtItsStart) {
  CaseSpec spec = crossed_cylinders();
  spec.run.rolling = true;
  spec.run.positions = {0.1};
  spec.run.window = 0;
  spec.layers.push_back({});
  spec.layers[0].thickness = 3e-3;
  const double reach = 6 * hertz_estimate(spec, place(spec, {}).contact).a;
  const auto refusal = [&](double from, double to) {
    spec.layers[0].unbonded = {{from, to}};
    try {
      build_model(spec, {});
    } catch (const CaseError& e) {
      return std::string(e.what());
    }
    return std::string("taken");
  };
  EXPECT_NE(refusal(reach - 1e-3, 0.09).find("put the stretch farther on"), std::string::npos);
  EXPECT_NE(refusal(reach + 1e-3, 5).find("where the rail has ended"), std::string::npos);
  EXPECT_EQ(refusal(reach + 1e-3, 0.09), "taken");
  spec.layers[0].unbonded = {{reach + 1e-3, 0.09}};
  const Model model = build_model(spec, {});
  const SweptBody& rail = model.rail;
  EXPECT_EQ(rail.interfaces.at(0).friction, spec.layers[0].unbonded_friction);
  const std::vector<double>& at = rail.blocks[static_cast<std::size_t>(rail.contact.block)].stations.at;
  for (const double x : {reach + 1e-3, 0.09}) EXPECT_NE(std::find(at.begin(), at.end(), x), at.end()) << x;
}

TEST(BuildModel, ALayerThatLiesOffTheRailIsRefused) {
  CaseSpec spec = crossed_cylinders();
  spec.layers.emplace_back();
  spec.layers[0].from = 5;
  try {
    build_model(spec, {});
    FAIL() << "taken";
  } catch (const CaseError& e) {
    EXPECT_NE(std::string(e.what()).find("layer.0 lies off the rail"), std::string::npos) << e.what();
  }
}

TEST(BuildModel, TheFineCapIsAsWideAsThePatchNeeds) {
  CaseSpec spec = crossed_cylinders();
  spec.mesh.fine_width.reset();
  spec.mesh.element_size = 3e-3;
  EXPECT_EQ(build_model(spec, {}).spec.mesh.fine_width, kFineWidth);
  spec.geometry.rail_profile = "arc:R=2000 mm";
  EXPECT_GT(build_model(spec, {}).spec.mesh.fine_width, kFineWidth);
}

TEST(StaticLoad, IsTheWeightOfWheelAndSprungMass) {
  CaseSpec spec;
  spec.vehicle.wheel_mass = 700;
  spec.vehicle.sprung_mass = 9300;
  EXPECT_DOUBLE_EQ(spec.vehicle.load(), 98100);
}

// Two equal principal curvatures 1/R: a = (3 F R/(4 E*))^(1/3), p0 = 3 F/(2 pi a^2), approach a^2/R [Johnson1985 eqs.
// 4.22-4.24].
TEST(LateralFrictionShare, IsThatOfTheCaseOrOne) {
  CaseSpec spec = crossed_cylinders();
  spec.drive.friction_coefficient = 0.4;
  EXPECT_EQ(lateral_friction_share(spec), 1);
  spec.friction.lateral_coefficient = 0.3;
  EXPECT_DOUBLE_EQ(lateral_friction_share(spec), 0.75);
  spec.drive.friction_coefficient = 0;
  EXPECT_EQ(lateral_friction_share(spec), 1);
}

TEST(HertzEstimate, OfCrossedCylindersIsTheSpheres) {
  CaseSpec spec = crossed_cylinders();
  spec.wheel_material.young = 2 * kYoung;
  const HertzContact h = hertz_estimate(spec, place(spec, {}).contact);
  const double modulus = 1 / ((1 - 0.09) / kYoung + (1 - 0.09) / (2 * kYoung)), F = spec.vehicle.load();
  const double a = std::cbrt(0.75 * F * kRadius / modulus);
  EXPECT_NEAR(h.a / a, 1, 1e-5);
  EXPECT_NEAR(h.b / a, 1, 1e-5);
  EXPECT_NEAR(h.p0 / (1.5 * F / (std::numbers::pi * a * a)), 1, 1e-5);
  EXPECT_NEAR(h.approach / (a * a / kRadius), 1, 1e-5);
  EXPECT_DOUBLE_EQ(h.load, F);
}

// The mean of a linear modulus over a row is its value in the row's middle; rows across a kink of the table weigh both
// sides by their heights.
TEST(BuildModel, RowsOfAGradedLayerHaveTheMeanModulusOfTheirHeight) {
  CaseSpec spec = crossed_cylinders();
  spec.layers = {graded(BodyId::rail, {{0, 2 * kYoung}, {4e-3, kYoung}}, 4)};
  const Model linear = build_model(spec, {});
  ASSERT_EQ(linear.rail_materials.size(), 5u);
  EXPECT_NEAR(young(linear.rail_materials[0]), kYoung, 1);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(young(linear.rail_materials[k + 1]) / kYoung, 2 - (static_cast<double>(k) + 0.5) / 4, 1e-12) << k;

  spec.layers = {graded(BodyId::rail, {{0, 3 * kYoung}, {1e-3, kYoung}, {4e-3, kYoung}}, 2)};
  const Model kinked = build_model(spec, {});
  ASSERT_EQ(kinked.rail_materials.size(), 3u);
  EXPECT_NEAR(young(kinked.rail_materials[1]) / kYoung, (2 * 1 + 1 * 1) / 2.0, 1e-12);
  EXPECT_NEAR(young(kinked.rail_materials[2]) / kYoung, 1, 1e-12);
}

TEST(BuildModel, AtTheSurfaceAGradedLayerHasTheTablesFirstModulus) {
  CaseSpec spec = crossed_cylinders();
  spec.layers = {graded(BodyId::wheel, {{0, 3 * kYoung}, {2e-3, kYoung}}, 2)};
  const Model m = build_model(spec, {});
  ASSERT_EQ(m.wheel_at_surface.size(), 3u);
  EXPECT_NEAR(young(m.wheel_at_surface[1]) / kYoung, 3, 1e-12);
  EXPECT_NEAR(young(m.wheel_at_surface[2]), young(m.wheel_materials[2]), 1) << "rows below as they are meshed";
  EXPECT_NEAR(young(m.wheel_materials[1]) / kYoung, 2.5, 1e-12);
  ASSERT_EQ(m.rail_at_surface.size(), 1u);
  EXPECT_NEAR(young(m.rail_at_surface[0]), kYoung, 1);
}

TEST(BuildModel, AUniformLayerIsOneMaterialOfItsBodyAlone) {
  CaseSpec spec = crossed_cylinders();
  spec.layers.emplace_back();
  spec.layers[0].width = 0.02;
  spec.layers[0].material = {0.5 * kYoung, 0.4, 5000};
  const Model m = build_model(spec, {});
  ASSERT_EQ(m.rail_materials.size(), 2u);
  EXPECT_NEAR(young(m.rail_materials[1]), 0.5 * kYoung, 1);
  EXPECT_NEAR(poisson(m.rail_materials[1]), 0.4, 1e-12);
  EXPECT_EQ(m.rail_materials[1].density, 5000);
  EXPECT_EQ(m.wheel_materials.size(), 1u);
  EXPECT_NEAR(young(m.rail_at_surface[1]), 0.5 * kYoung, 1);
}

// Section coordinates of the wheel count from the axle, those of the rail from its own origin.
TEST(BuildModel, AMeshWithAnElementTurnedInsideOutIsACaseErrorThatNamesThePlaceAndWhatToChange) {
  CaseSpec spec;
  spec.mesh.element_size = 2e-3;
  spec.run.rolling = false;
  EXPECT_NO_THROW(build_model(spec, "."));
  spec.geometry.wheel_section.rim_thickness = 8e-3;
  try {
    build_model(spec, ".");
    FAIL() << "no error";
  } catch (const CaseError& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("\"rim\""), std::string::npos) << text;
    EXPECT_NE(text.find("inside out"), std::string::npos) << text;
  }
}

TEST(BuildModel, BothRunningSurfacesMeetInTheRigidContactPoint) {
  const Model m = build_model(crossed_cylinders(), {});
  const RigidContact& c = m.placement.contact;
  const Vec2 rail = m.rail_section_point(c.rail_s), wheel = m.wheel_section_point(c.wheel_s);
  EXPECT_NEAR(rail.y, c.point.y, 1e-9);
  EXPECT_NEAR(rail.z, c.point.z, 1e-9);
  EXPECT_NEAR(wheel.y + c.wheel_offset_y, c.point.y, 1e-9);
  EXPECT_NEAR(wheel.z + c.axle_height, c.point.z, 1e-9);
  const Vec2 up = m.rail_section_normal(c.rail_s), down = m.wheel_section_normal(c.wheel_s);
  EXPECT_NEAR(up.z, 1, 1e-9);
  EXPECT_NEAR(down.z, -1, 1e-9);
}

}  // namespace
}  // namespace railstrata
