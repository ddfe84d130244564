#include <gtest/gtest.h>

#include <cmath>

#include "case/case_file.hpp"
#include "core/faults.hpp"

namespace railstrata {
namespace {

TEST(StrengthCase, EveryKeyIsReadInSiUnitsAtEachMaterial) {
  const CaseSpec spec = parse_case(R"toml(
[material.rail]
strength_table = [["0 mm", "750 MPa"], ["10 mm", "500 MPa"]]
hardness = "285 HBW"
conductivity = "45 W/(m K)"
[material.wheel]
shear_yield_strength = "300 MPa"
wear_coefficient = 3e-4
[[layer]]
young_ratio = 1
thickness = "2 mm"
yield_strength = "900 MPa"
initial_stress = ["-344 MPa", "-200 MPa"]
fracture_toughness = "15 MPa √m"
bond_shear = "200 MPa"
[[layer]]
young_ratio = 1
thickness = "2 mm"
initial_stress_table = [["0 mm", "-300 MPa", "-200 MPa"], ["2 mm", "0 MPa", "10 MPa"]]
)toml",
                                   "a.toml")
                            .spec;
  const StrengthSpec &rail = spec.rail_material.strength, &wheel = spec.wheel_material.strength,
                     &first = spec.layers.at(0).material.strength, &second = spec.layers.at(1).material.strength;
  EXPECT_EQ(rail.strength_table, (std::vector<DepthPoint>{{0, 750e6}, {10e-3, 500e6}}));
  EXPECT_DOUBLE_EQ(rail.hardness.value(), 300);
  EXPECT_EQ(rail.conductivity, 45);
  EXPECT_FALSE(rail.yield_strength.has_value());
  EXPECT_DOUBLE_EQ(wheel.yield_strength.value(), std::sqrt(3) * 300e6);
  EXPECT_EQ(wheel.wear_coefficient, 3e-4);
  EXPECT_EQ(first.yield_strength, 900e6);
  EXPECT_EQ(first.initial_stress, (std::vector<double>{-344e6, -200e6}));
  EXPECT_EQ(first.fracture_toughness, 15e6);
  EXPECT_EQ(first.bond_shear, 200e6);
  EXPECT_EQ(second.initial_stress_table, (std::vector<StressPoint>{{0, -300e6, -200e6}, {2e-3, 0, 10e6}}));
}

TEST(StrengthCase, TheResolvedCaseIsReadBackTheSame) {
  const LoadedCase once = parse_case(
      "[material.rail]\nhardness_table = [[\"0 mm\", \"380 HV\"], [\"10 mm\", \"300 HV\"]]\n"
      "[[layer]]\nyoung_ratio = 1\nshear_yield_strength = \"500 MPa\"\ninitial_stress = [\"-344 MPa\", \"0 MPa\"]\n",
      "a.toml");
  const CaseSpec back = parse_case(resolved_case(once.spec), "b.toml").spec;
  EXPECT_EQ(back.rail_material.strength.hardness_table, once.spec.rail_material.strength.hardness_table);
  EXPECT_EQ(back.layers.at(0).material.strength.yield_strength,
            once.spec.layers.at(0).material.strength.yield_strength);
  EXPECT_EQ(back.layers.at(0).material.strength.initial_stress,
            once.spec.layers.at(0).material.strength.initial_stress);
}

struct Bad {
  const char* text;
  const char* answer;
};

TEST(StrengthCase, WhatContradictsItselfIsToldWithItsPlaceAndRemedy) {
  const Bad all[] = {
      {"[material.rail]\nyield_strength = \"500 MPa\"\nshear_yield_strength = \"300 MPa\"\n",
       "a.toml:3:24: [material.rail] has yield_strength and shear_yield_strength: a case has one of them"},
      {"[material.rail]\nyield_strength = \"900 MPa\"\ntensile_strength = \"880 MPa\"\n",
       "a.toml:3:20: material.rail.tensile_strength = 0.88 GPa: must be at least yield_strength = 0.9 GPa"},
      {"[material.rail]\nyield_strength = \"1200 MPa\"\nhardness = \"280 HV\"\n",
       "a.toml:3:12: material.rail.hardness = 280 HV: does not fit to yield_strength = 1.2 GPa, a material of this "
       "hardness yields at 1098 MPa at most"},
      {"[material.rail]\ngrade = \"r260\"\ntensile_strength = \"300 MPa\"\n",
       "a.toml:3:20: material.rail.tensile_strength = 0.3 GPa: must be at least the yield strength of R260 = 0.47 GPa"},
      {"[material.rail]\ntensile_strength = \"900 MPa\"\n"
       "strength_table = [[\"0 mm\", \"950 MPa\"], [\"10 mm\", \"500 MPa\"]]\n",
       "a.toml:2:20: material.rail.tensile_strength = 0.9 GPa: must be at least strength_table = 0.95 GPa"},
      {"[material.rail]\nhardness = \"200 HV\"\n"
       "strength_table = [[\"0 mm\", \"700 MPa\"], [\"10 mm\", \"900 MPa\"]]\n",
       "a.toml:2:12: material.rail.hardness = 200 HV at a depth of 10 mm: does not fit to strength_table = 0.9 GPa, a "
       "material of this hardness yields at 785 MPa at most"},
      {"[material.rail]\nyield_strength = \"900 MPa\"\n"
       "hardness_table = [[\"0 mm\", \"400 HV\"], [\"10 mm\", \"200 HV\"]]\n",
       "a.toml:3:18: material.rail.hardness_table = 200 HV at a depth of 10 mm: does not fit to yield_strength = 0.9 "
       "GPa"},
      {"[material.rail]\nhardness = \"-300 HV\"\n",
       "a.toml:2:12: material.rail.hardness = \"-300 HV\": must be between 50 HV and 2000 HV"},
      {"[material.rail]\nyield_strength = \"500 GPa\"\n",
       "a.toml:2:18: material.rail.yield_strength = \"500 GPa\": must be between 0.01 GPa and 20 GPa"},
      {"[material.wheel]\ninitial_stress = [\"-300 MPa\"]\n",
       "a.toml:2:18: material.wheel.initial_stress: has 1 value, must have two: the longitudinal and the lateral "
       "stress"},
      {"[[layer]]\nyoung_ratio = 1\nthickness = \"3 mm\"\n"
       "strength_table = [[\"0 mm\", \"900 MPa\"], [\"2 mm\", \"700 MPa\"]]\n",
       "a.toml:4:18: layer.0.strength_table: ends at 2 mm, the layer is 3 mm thick"},
      {"[[layer]]\nyoung_ratio = 1\ninitial_stress_table = [[\"0 mm\", \"1 MPa\"], [\"2 mm\", \"1 MPa\"]]\n",
       "a.toml:3:25: layer.0.initial_stress_table.0: must be a depth, a longitudinal stress and a lateral stress"}};
  for (const Bad& bad : all) try {
      parse_case(bad.text, "a.toml");
      ADD_FAILURE() << "accepted: " << bad.text;
    } catch (const CaseError& e) {
      EXPECT_NE(std::string(e.what()).find(bad.answer), std::string::npos) << e.what();
      for (const Diagnostic& d : e.diagnostics) EXPECT_FALSE(d.remedy.empty()) << d.message;
    }
}

}  // namespace
}  // namespace railstrata
