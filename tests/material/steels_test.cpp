#include "material/steels.hpp"

#include <gtest/gtest.h>

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
  for (const Steel& g : steels()) {
    if (!g.tensile.known()) continue;
    for (const SteelNumber& n : {g.yield, g.tensile, g.hardness, g.wear}) {
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

TEST(Grades, HaveTheWearThatIsMeasuredOrNone) {
  EXPECT_EQ(grade("R200").wear.low, 1.34);
  EXPECT_EQ(grade("R260").wear.low, 1);
  EXPECT_NEAR(grade("R350HT").wear.low, 1.0 / 3, 1e-15);
  EXPECT_EQ(grade("ER8").wear.low, 1);
  EXPECT_FALSE(grade("R400HT").wear.known()) << "not invented";
  EXPECT_TRUE(grade("R400HT").pearlite);
  EXPECT_FALSE(grade("B320").pearlite);
  EXPECT_FALSE(grade("Hadfield").pearlite);
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

}  // namespace
}  // namespace railstrata
