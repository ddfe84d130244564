#include "model/material_strength.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/faults.hpp"
#include "material/steels.hpp"

namespace railstrata {
namespace {

std::optional<PlasticLaw> law_of(const MaterialSpec& material) {
  return plastic_law(material, "rail", "material.rail");
}

TEST(PlasticLaw, AStrengthAloneIsPerfectPlasticityAndNoStrengthIsElastic) {
  MaterialSpec m;
  EXPECT_FALSE(law_of(m).has_value());
  m.strength.yield_strength = 500e6;
  const PlasticLaw law = law_of(m).value();
  EXPECT_EQ(law.top.plastic.yield, 500e6);
  EXPECT_EQ(law.top.plastic.saturation, 0);
  EXPECT_EQ(law.top.plastic.modulus[0], 0);
  EXPECT_NEAR(law.top.plastic.mu, 210e9 / 2.6, 1);
  EXPECT_NEAR(law.top.lambda, 210e9 * 0.3 / (1.3 * 0.4), 1);
  EXPECT_TRUE(law.notes.empty()) << "given, not estimated";
  m.strength.elastic = true;
  EXPECT_FALSE(law_of(m).has_value()) << "elastic on purpose";
}

TEST(PlasticLaw, AGivenLawBeginsAtTheYieldStrengthAndScalesWithTheTables) {
  MaterialSpec m;
  m.strength.isotropic_hardening = IsotropicHardening{80e6, 12};
  m.strength.kinematic_hardening = {{60e9, 250}, {5e9, 10}};
  m.strength.strength_table = {{0, 600e6}, {10e-3, 300e6}};
  const PlasticLaw law = law_of(m).value();
  const PlasticParameters<double> top = law.at(0).plastic, middle = law.at(5e-3).plastic, deep = law.at(1).plastic;
  EXPECT_EQ(top.yield, 600e6);
  EXPECT_EQ(top.modulus[1], 5e9);
  EXPECT_NEAR(middle.yield, 450e6, 1);
  EXPECT_NEAR(middle.saturation, 60e6, 1);
  EXPECT_NEAR(middle.modulus[0], 45e9, 1);
  EXPECT_EQ(middle.recall[0], 250);
  EXPECT_EQ(middle.rate, 12);
  EXPECT_EQ(middle.mu, top.mu) << "elasticity is not scaled";
  EXPECT_NEAR(deep.yield, 300e6, 1) << "below the last row as there";
  m.strength.strength_table.clear();
  m.strength.yield_strength = 400e6;
  m.strength.hardness_table = {{0, 400}, {10e-3, 300}};
  EXPECT_NEAR(law_of(m)->at(10e-3).plastic.yield, 300e6, 1);
}

TEST(PlasticLaw, AReadySetSaysHowSureItIsAndScalesWithHardness) {
  MaterialSpec m;
  m.strength.grade = "R260";
  m.strength.hardening = "r260";
  PlasticLaw law = law_of(m).value();
  EXPECT_EQ(law.at(0).plastic.yield, hardening_set("R260").hardening.law.yield) << "not the grade's proof stress";
  ASSERT_EQ(law.notes.size(), 1u);
  EXPECT_NE(law.notes[0].find("set R260, estimated"), std::string::npos) << law.notes[0];
  m.strength.hardness = 550;  // twice what 880 MPa are
  law = law_of(m).value();
  EXPECT_NEAR(law.at(2e-3).plastic.modulus[2] / hardening_set("R260").hardening.law.modulus[2], 2, 1e-12);
  m.strength.yield_strength = 480e6;
  EXPECT_NE(law_of(m)->notes.back().find("serves shakedown and fatigue alone"), std::string::npos);
  MaterialSpec published;
  published.young = 230e9;
  published.strength.hardening = "bearing_martensite_Hazar";
  EXPECT_EQ(law_of(published)->notes.size(), 2u) << "source, and another modulus than it was fitted with";
}

TEST(PlasticLaw, EstimatedIsOfTheTensileStrengthElseOfTheHardness) {
  MaterialSpec m;
  m.strength.hardening = "estimated";
  m.strength.tensile_strength = 880e6;
  const PlasticLaw of_tensile = law_of(m).value();
  EXPECT_NEAR(of_tensile.at(0).plastic.yield, hardening_set("R260").hardening.law.yield, 1);
  m.strength.tensile_strength.reset();
  m.strength.hardness = 275;
  EXPECT_NEAR(law_of(m)->at(0).plastic.yield, of_tensile.at(0).plastic.yield, 1) << "3.2 MPa times HV";
}

std::optional<StrainLifeOfMaterial> life_of(const StrengthSpec& s) {
  MaterialSpec m;
  m.strength = s;
  return strain_life_of(m, "rail", "material.rail");
}

TEST(PlasticLaw, AGradeBringsItsSetUnlessAnotherKeyGivesALaw) {
  MaterialSpec m;
  m.strength.grade = "R260";
  EXPECT_EQ(law_of(m).value().top.plastic.yield, hardening_set("R260").hardening.law.yield);
  m.strength.kinematic_hardening = {{60e9, 250}};
  EXPECT_EQ(law_of(m).value().top.plastic.yield, 470e6) << "the law that is given, from the grade's yield strength on";
  m.strength.kinematic_hardening.clear();
  m.strength.yield_strength = 500e6;
  EXPECT_EQ(law_of(m).value().top.plastic.modulus[0], 0);
  m.strength.yield_strength.reset();
  m.strength.hardening = "estimated";
  EXPECT_EQ(law_of(m).value().top.plastic.yield, estimated_hardening(880e6).yield);
}

TEST(MaterialStrength, EnduranceIsGivenElseOfTheGrade) {
  StrengthSpec s;
  const auto known = [&] { return MaterialStrength(s, "rail", "material.rail").endurance(); };
  EXPECT_TRUE(std::isnan(known().limit));
  s.grade = "R260";
  EXPECT_NEAR(known().limit, 0.577 * 0.45 * 880e6, 1);  // FKM guideline: alternating shear
  // both endurance limits lie on the line: alternating tension has tau = sigma/2, sigma_h = sigma/3
  EXPECT_NEAR((0.5 + known().weight / 3) * 0.45 * 880e6, known().limit, 1);
  s.fatigue.limit = 300e6;
  EXPECT_EQ(known().limit, 300e6);
  s.grade.clear();
  EXPECT_TRUE(std::isnan(known().limit)) << "without a weight";
  s.fatigue.dang_van = 0.3;
  EXPECT_EQ(known().weight, 0.3);
}

TEST(StrainLifeOfMaterial, IsGivenElseEstimatedFromTheTensileStrengthOfTheMaterialItsGradeOrItsHardness) {
  StrengthSpec s;
  EXPECT_FALSE(life_of(s)) << "nothing known";
  s.hardness = 275;  // 880 MPa
  EXPECT_NEAR(life_of(s)->life.strength, 1.5 * 880e6, 1);
  s.grade = "R350HT";
  EXPECT_EQ(life_of(s)->life.strength, 1.5 * 1175e6);
  s.tensile_strength = 1200e6;
  EXPECT_EQ(life_of(s)->life.strength, 1.5 * 1200e6);
  EXPECT_EQ(life_of(s)->other.ductility, 0.45) << "the second estimate";
  EXPECT_NE(life_of(s)->note.find("two estimates from a tensile strength of 1200 MPa"), std::string::npos);
  s.fatigue.strength_coefficient = 1500e6;
  s.fatigue.strength_exponent = -0.1;
  s.fatigue.ductility_coefficient = 0.3;
  s.fatigue.ductility_exponent = -0.55;
  EXPECT_EQ(life_of(s)->life.ductility, 0.3);
  EXPECT_EQ(life_of(s)->other.ductility, 0.3) << "given: no range";
  EXPECT_EQ(life_of(s)->note, "");
  StrengthSpec martensite;
  martensite.tensile_strength = 2400e6;
  EXPECT_FALSE(life_of(martensite)) << "beyond the uniform material law";
}

}  // namespace
}  // namespace railstrata
