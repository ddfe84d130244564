#include "fatigue/streamlines.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/judge/whole_summary.hpp"
#include "tests/result/crossed_cylinders.hpp"

namespace railstrata {
namespace {

DamageSummary damage_of(const CaseSpec& spec) {
  BemOptions options;
  options.cell = 0.5e-3;
  const BemResult r = solve_bem(spec, place(spec, {}), options);
  return damage_summary(spec, whole_summary(spec, r), streamlines(spec, r.field));
}

CaseSpec sliding() {
  CaseSpec spec = post_checks::crossed_cylinders();
  spec.drive.friction_coefficient = 0.3;
  spec.drive.creepage = -0.02;
  return spec;
}

}  // namespace

// In steady rolling elastic displacements take no work round: friction has what the rigid motion puts in. LMA on CN60
// has rows with rolling radii of their own, which creepages and a spin do not know.
TEST(Streamlines, FrictionEnergyIsThatOfTheTractionsInTheRigidMotion) {
  CaseSpec spec;
  spec.drive.traction_coefficient = 0.2;
  spec.drive.friction_coefficient = 0.5;
  const DamageSummary found = damage_of(spec);
  EXPECT_NEAR(found.friction_energy / found.motion_energy, 1, 0.01);
  EXPECT_LT(found.t_gamma_with_spin, 0.99 * found.motion_energy) << "the rows' own radii are more than a spin";
}

TEST(Streamlines, ShowTheShareOfAustenitisationWhereTheCaseSaysItsTemperature) {
  CaseSpec spec = sliding();
  EXPECT_TRUE(std::isnan(damage_of(spec).austenitisation));
  spec.rail_material.strength.heat.austenitisation_rise = 700;
  const DamageSummary found = damage_of(spec);
  EXPECT_GT(found.temperature_rise, 10);
  EXPECT_EQ(found.austenitisation, found.temperature_rise / 700);
  EXPECT_EQ(found.temperature_rise_lower, found.temperature_rise) << "there is no layer";
  EXPECT_EQ(found.temperature_rise_upper, found.temperature_rise);
}

// The running surface is that of the first layer, whatever the rail's own temperature; the bounds know the second.
TEST(Streamlines, OfALayeredRailTakeItsSurfaceAndAllItsLayers) {
  CaseSpec spec = sliding();
  spec.rail_material.strength.heat.austenitisation_rise = 700;
  spec.layers.resize(2);
  for (LayerSpec& layer : spec.layers) {
    layer.thickness = 0.5e-3;
    layer.material = spec.rail_material;
  }
  spec.layers[0].material.strength.heat.austenitisation_rise = 350;
  spec.layers[1].material.strength.heat.conductivity = 5;
  const DamageSummary found = damage_of(spec);
  EXPECT_EQ(found.austenitisation, found.temperature_rise / 350);
  EXPECT_NEAR(found.temperature_rise_lower / found.temperature_rise, 1, 1e-3) << "heat does not reach the second layer";
  EXPECT_GT(found.temperature_rise_upper, 1.2 * found.temperature_rise);
}

TEST(Streamlines, HaveTheWearOfTheSteelAtTheSurface) {
  CaseSpec spec = sliding();
  const DamageSummary unknown = damage_of(spec);
  EXPECT_EQ(unknown.rail_steel.factor, 1);
  EXPECT_EQ(unknown.rail_steel.source, WearSource::unknown);
  EXPECT_NE(unknown.rail_steel.text.find("give material.rail.grade, hardness or wear_factor"), std::string::npos);
  const auto times = [&](const CaseSpec& of) { return damage_of(of).usfd_depth / unknown.usfd_depth; };

  StrengthSpec& rail = spec.rail_material.strength;
  rail.grade = "R350HT";
  EXPECT_NEAR(times(spec), 1.0 / 3, 1e-12);
  EXPECT_EQ(damage_of(spec).rail_steel.source, WearSource::grade);
  rail.hardness = 400;
  EXPECT_NEAR(times(spec), 1.0 / 3, 1e-12) << "what the grade was measured with";
  rail.grade = "Hadfield";
  EXPECT_NEAR(times(spec), 1, 1e-12) << "no pearlite";
  rail.grade = "";
  rail.hardness = 700;
  EXPECT_NEAR(times(spec), 1.0 / 3, 1e-12) << "held, never extrapolated";
  EXPECT_EQ(damage_of(spec).rail_steel.source, WearSource::estimated);
  rail.wear_factor = 0.05;
  EXPECT_NEAR(times(spec), 0.05, 1e-12);

  spec.layers.resize(1);
  spec.layers[0].material = spec.rail_material;
  spec.layers[0].material.strength = {};
  spec.layers[0].material.strength.grade = "R200";
  EXPECT_NEAR(damage_of(spec).rail_steel.factor, 1.34, 1e-12) << "the rail below is not at the surface";
}

// KTH's depth has the hardness already: only what the case gives comes to it, and Archard's coefficient is the steel's.
TEST(Streamlines, CountHardnessOnceInArchardsLaws) {
  CaseSpec spec = sliding();
  StrengthSpec& rail = spec.rail_material.strength;
  rail.hardness = 294.7;
  rail.wear_coefficient = 1e-4;
  const DamageSummary soft = damage_of(spec);
  rail.hardness = 2 * 294.7;
  const DamageSummary hard = damage_of(spec);
  EXPECT_NEAR(hard.archard_depth / soft.archard_depth, 0.5, 1e-12);
  rail.wear_factor = 0.25;
  const DamageSummary given = damage_of(spec);
  EXPECT_NEAR(given.kth_depth / hard.kth_depth, 0.25, 1e-12);
  EXPECT_NEAR(given.archard_depth / hard.archard_depth, 1, 1e-12);
  EXPECT_NEAR(damage_of(spec).wheel_steel.factor, 1, 1e-12);
}

TEST(Streamlines, TellHowMuchOfJendelsWearIsSeizure) {
  CaseSpec spec = sliding();
  spec.rail_material.strength.hardness = 280;
  const DamageSummary sound = damage_of(spec);
  EXPECT_EQ(sound.kth_of_map.seized, 0);
  spec.rail_material.strength.hardness = 60;
  const DamageSummary seized = damage_of(spec);
  EXPECT_GT(seized.kth_of_map.outside(), 0.5);
}

}  // namespace railstrata
