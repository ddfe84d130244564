#include <gtest/gtest.h>

#include <cmath>

#include "core/faults.hpp"
#include "reader/case_file.hpp"

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
  EXPECT_EQ(rail.heat.conductivity, 45);
  EXPECT_FALSE(rail.yield_strength.has_value());
  EXPECT_DOUBLE_EQ(wheel.yield_strength.value(), std::sqrt(3) * 300e6);
  EXPECT_EQ(wheel.wear_coefficient, 3e-4);
  EXPECT_EQ(first.yield_strength, 900e6);
  EXPECT_EQ(first.initial_stress, (std::vector<double>{-344e6, -200e6}));
  EXPECT_EQ(first.fracture_toughness, 15e6);
  EXPECT_EQ(first.bond.shear, 200e6);
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

TEST(StrengthCase, HardeningIsReadAtEachMaterialAndReadsBackTheSame) {
  const LoadedCase once = parse_case(R"toml(
[material.rail]
yield_strength = "300 MPa"
isotropic_hardening = { saturation = "80 MPa", rate = 12 }
kinematic_hardening = [{ modulus = "60 GPa", recall = 250 }, { recall = 0, modulus = "500 MPa" }]
[material.wheel]
hardening = "er8"
[[layer]]
young_ratio = 1
elastic = true
yield_strength = "900 MPa"
[[layer]]
young_ratio = 1
hardness = "600 HV"
[[layer.kinematic_hardening]]
modulus = "20 GPa"
recall = 100
)toml",
                                     "a.toml");
  for (const LoadedCase& loaded : {once, parse_case(resolved_case(once.spec), "b.toml")}) {
    const CaseSpec& spec = loaded.spec;
    const StrengthSpec& rail = spec.rail_material.strength;
    EXPECT_EQ(rail.isotropic_hardening, (IsotropicHardening{80e6, 12}));
    EXPECT_EQ(rail.kinematic_hardening, (std::vector<KinematicHardening>{{60e9, 250}, {500e6, 0}}));
    EXPECT_EQ(spec.wheel_material.strength.hardening, "er8");
    EXPECT_TRUE(spec.layers.at(0).material.strength.elastic);
    EXPECT_FALSE(spec.layers.at(1).material.strength.elastic);
    EXPECT_EQ(spec.layers.at(1).material.strength.kinematic_hardening, (std::vector<KinematicHardening>{{20e9, 100}}));
    ASSERT_EQ(loaded.idle.size(), 4u) << "contact is elastic, with a note for each key";
    std::string notes;
    for (const IdleSetting& setting : loaded.idle) notes += setting.text + "\n";
    for (const char* key : {"material.wheel.hardening", "material.rail.isotropic_hardening",
                            "material.rail.kinematic_hardening", "layer.1.kinematic_hardening"})
      EXPECT_NE(notes.find(std::string(key) + " has no effect with run.plasticity = false"), std::string::npos)
          << notes;
  }
  EXPECT_EQ(resolved_case(CaseSpec{}).find("hardening"), std::string::npos) << "cases without it stay as they were";
}

TEST(StrengthCase, HardeningIsSetAsAWhole) {
  const std::string key = "material.rail.kinematic_hardening";
  const CaseSpec spec =
      parse_case("[material.rail]\nhardening = \"R260\"\n", "a.toml",
                 {"material.rail.yield_strength=400 MPa", key + "=[{modulus = \"5 GPa\", recall = 10}]"})
          .spec;
  EXPECT_EQ(spec.rail_material.strength.kinematic_hardening, (std::vector<KinematicHardening>{{5e9, 10}}));
  EXPECT_EQ(spec.rail_material.strength.hardening, "") << "the command line goes first";
}

// As a program writes them that knows no special cases.
TEST(StrengthCase, HardeningOfNoneIsAllowed) {
  const StrengthSpec s = parse_case(
                             "[material.rail]\nyield_strength = \"480 MPa\"\nisotropic_hardening = { saturation = "
                             "\"0 MPa\", rate = 0 }\nkinematic_hardening = [{ modulus = \"0 GPa\", recall = 0 }]\n"
                             "[material.wheel]\nyield_strength = \"480 MPa\"\nkinematic_hardening = []\n",
                             "a.toml")
                             .spec.rail_material.strength;
  EXPECT_EQ(s.kinematic_hardening, (std::vector<KinematicHardening>{{0, 0}}));
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
      {"[material.rail]\nfatigue_strength_coefficient = \"1320 MPa\"\nfatigue_strength_exponent = -0.09\n"
       "fatigue_ductility_exponent = -0.6\n",
       "a.toml:2:32: material.rail.fatigue_strength_coefficient: the strain-life curve needs "
       "fatigue_ductility_coefficient too"},
      {"[material.rail]\nfatigue_strength_exponent = 0.09\n",
       "a.toml:2:29: material.rail.fatigue_strength_exponent = 0.09: must be between -0.5 and -0.01"},
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
       "a.toml:3:25: layer.0.initial_stress_table.0: must be a depth, a longitudinal stress and a lateral stress"},
      {"[material.rail]\nyield_strength = \"300 MPa\"\nisotropic_hardening = { saturation = \"80 MPa\" }\n",
       "a.toml:3:1: material.rail.isotropic_hardening has no rate"},
      {"[material.rail]\nyield_strength = \"300 MPa\"\nisotropic_hardening = { saturation = \"80 MPa\", rate = 0 }\n",
       "a.toml:3:1: material.rail.isotropic_hardening: saturation = 0.08 GPa is never reached at rate = 0"},
      {"[material.rail]\nyield_strength = \"300 MPa\"\nisotropic_hardening = \"80 MPa\"\n",
       "is a text, must be a table with a saturation and a rate, e.g. { saturation = \"80 MPa\", rate = 12 }"},
      {"[material.rail]\nisotropic_hardening = { saturation = \"80 MPa\", rate = 12 }\n",
       "a.toml:2:1: material.rail.isotropic_hardening: gives how the material hardens, but not where it begins"},
      {"[material.rail]\nyield_strength = \"300 MPa\"\nisotropic_hardening = { saturation = \"-300 MPa\", rate = 1 }\n",
       "saturation = -0.3 GPa takes the whole yield strength of 0.3 GPa away"},
      {"[material.rail]\nyield_strength = \"600 MPa\"\nisotropic_hardening = { saturation = \"-300 MPa\", rate = 900 "
       "}\n",
       "softens by saturation x rate = 270 GPa, faster than the material unloads"},
      {"[material.rail]\nyield_strength = \"300 MPa\"\nkinematic_hardening = [{ modulus = \"-1 GPa\", recall = 1 }]\n",
       "a.toml:3:36: material.rail.kinematic_hardening.0.modulus = \"-1 GPa\": must be between 0 GPa and 10000 GPa"},
      {"[material.rail]\nyield_strength = \"300 MPa\"\nkinematic_hardening = [{ modulus = \"9 GPa\", recall = -1 }]\n",
       "material.rail.kinematic_hardening.0.recall = -1: must be between 0 and 1000000"},
      {"[material.rail]\nyield_strength = \"300 MPa\"\nkinematic_hardening = [{ modulus = \"9 GPa\", gamma = 1 }]\n",
       "unknown key material.rail.kinematic_hardening.0.gamma"},
      {"[material.rail]\nyield_strength = \"300 MPa\"\nkinematic_hardening = [\"9 GPa\"]\n",
       "material.rail.kinematic_hardening.0 = \"9 GPa\": is a text, must be a list of tables with a modulus and a "
       "recall"},
      {"[material.rail]\nyield_strength = \"300 MPa\"\nkinematic_hardening = [{ modulus = \"9 GPa\", recall = 1 }, { "
       "modulus = \"9 GPa\", recall = 2 }, { modulus = \"9 GPa\", recall = 3 }, { modulus = \"9 GPa\", recall = 4 }, { "
       "modulus = \"9 GPa\", recall = 5 }]\n",
       "has 5 backstresses, at most 4 are computed"},
      {"[material.rail]\nhardening = \"R26\"\n", "a.toml:2:13: material.rail.hardening: no hardening set \"R26\""},
      {"[material.rail]\nhardening = \"estimated\"\n", "needs tensile_strength, a grade or hardness"},
      {"[material.rail]\nhardening = \"R260\"\nyield_strength = \"300 MPa\"\nkinematic_hardening = [{ modulus = \"9 "
       "GPa\", "
       "recall = 1 }]\n",
       "[material.rail] has hardening and kinematic_hardening: a case has one of them"},
      {"[material.rail]\nhardening = \"R260\"\nelastic = true\n",
       "a.toml:3:11: material.rail.elastic = true: the material has a law of hardening too"}};
  for (const Bad& bad : all) try {
      parse_case(bad.text, "a.toml");
      ADD_FAILURE() << "accepted: " << bad.text;
    } catch (const CaseError& e) {
      EXPECT_NE(std::string(e.what()).find(bad.answer), std::string::npos) << e.what();
      for (const Diagnostic& d : e.diagnostics) EXPECT_FALSE(d.remedy.empty()) << d.message;
    }
}

TEST(StrengthCase, HardeningIsNotedAsUnusedUnlessALifeFollowsTheRail) {
  const std::string card = "[material.rail]\nhardening = \"R260\"\n";
  EXPECT_EQ(parse_case(card, "a.toml").idle.size(), 1u);
  EXPECT_TRUE(parse_case(card + "[life]\nuntil = \"50 Mt\"\n", "a.toml").idle.empty());
}

}  // namespace
}  // namespace railstrata
