#include "damage/grades.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/faults.hpp"

namespace railstrata {
namespace {

TEST(Grades, StandardMinimaAreThoseOfTheStandards) {
  EXPECT_EQ(grade("R220").tensile.low, 770e6);
  EXPECT_EQ(grade("R260").tensile.low, 880e6);
  EXPECT_EQ(grade("R350HT").tensile.low, 1175e6);
  EXPECT_EQ(grade("R400HT").tensile.low, 1280e6);
  EXPECT_EQ(grade("R260").hardness.low, 260);
  EXPECT_EQ(grade("R260").hardness.high, 300);
  EXPECT_EQ(grade("R350HT").hardness.high, 390);
  EXPECT_EQ(grade("ER7").yield.low, 520e6);
  EXPECT_EQ(grade("ER8").yield.low, 540e6);
  EXPECT_EQ(grade("ER9").yield.low, 580e6);
  EXPECT_EQ(grade("ER8").tensile.high, 980e6);
  EXPECT_EQ(grade("ER9").hardness.low, 255);
}

TEST(Grades, EveryNumberSaysHowSureItIsAndWhereItComesFrom) {
  for (const Grade& g : grades()) {
    for (const GradeNumber& n : {g.yield, g.tensile, g.hardness}) {
      EXPECT_EQ(n.known(), !n.source.empty()) << g.name;
      EXPECT_EQ(n.known(), !certainty_text(n.certainty).empty()) << g.name;
      EXPECT_LE(n.low, n.high) << g.name;
      EXPECT_EQ(n.known(), n.low > 0) << g.name;
    }
    EXPECT_LE(g.yield.high, g.tensile.low) << g.name << ": a steel yields before it breaks";
  }
  EXPECT_EQ(grade("R260").yield.certainty, Certainty::estimated) << "no standard asks for a rail's yield strength";
  EXPECT_EQ(grade("ER7").yield.certainty, Certainty::standard_minimum);
  EXPECT_FALSE(grade("B320").yield.known()) << "not invented";
}

TEST(Grades, AnUnknownNameIsRefusedWithTheNearestOne) {
  EXPECT_EQ(grade("r350ht").name, "R350HT");
  try {
    grade("R350H");
    FAIL() << "no such grade";
  } catch (const CaseError& e) {
    EXPECT_NE(std::string(e.what()).find("did you mean \"R350HT\""), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("ER9"), std::string::npos) << e.what();
  }
}

// Rows of ISO 18265, table A.1: HV, HB, Rm. The straight lines are within 3 % of them.
TEST(Hardness, ConvertsAsTheTableOfIso18265) {
  const double rows[][3] = {{200, 190, 640}, {300, 285, 965}, {400, 380, 1290}, {500, 475, 1630}};
  for (const auto& row : rows) {
    EXPECT_NEAR(vickers_from_brinell(row[1]), row[0], 1e-9);
    EXPECT_NEAR(tensile_from_vickers(row[0]), row[2] * 1e6, 0.03 * row[2] * 1e6) << row[0];
  }
}

TEST(Hardness, YieldAndBack) {
  EXPECT_DOUBLE_EQ(yield_from_vickers(300, 0.5), 480e6);
  EXPECT_DOUBLE_EQ(vickers_from_yield(480e6, 0.5), 300);
  // Tabor: H = 3 Y. 300 HV: H = 2.942 GPa, Y = 980.7 MPa, k = H/(3 sqrt 3) = 566.2 MPa.
  EXPECT_NEAR(flow_stress_from_vickers(300), 980.665e6, 1);
  EXPECT_NEAR(shear_yield(flow_stress_from_vickers(300)), 566.19e6, 0.01e6);
  EXPECT_DOUBLE_EQ(vickers_from_flow_stress(flow_stress_from_vickers(450)), 450);
  EXPECT_THROW(yield_from_vickers(-1, 0.5), std::invalid_argument);
  EXPECT_THROW(yield_from_vickers(300, 1.2), std::invalid_argument);
  EXPECT_THROW(tensile_from_vickers(std::nan("")), std::invalid_argument);
}

// The hardness of the standards with the line of ISO 18265 gives the tensile strength of the standards within 6 %.
TEST(Hardness, FitsTheGradesOwnTensileStrength) {
  for (const char* name : {"R220", "R260", "R350HT", "R400HT", "ER7", "ER8", "ER9"}) {
    const Grade& g = grade(name);
    EXPECT_NEAR(tensile_from_vickers(vickers_from_brinell(g.hardness.low)) / g.tensile.low, 1, 0.06) << name;
  }
}

}  // namespace
}  // namespace railstrata
