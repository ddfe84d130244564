#include "damage/hardness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "material/steels.hpp"

namespace railstrata {
namespace {

// Rows of ISO 18265, table A.1: HV, HB, Rm. The straight lines are within 3 % of them.
TEST(Hardness, ConvertsAsTheTableOfIso18265) {
  const double rows[][3] = {{200, 190, 640}, {300, 285, 965}, {400, 380, 1290}, {500, 475, 1630}};
  for (const auto& row : rows) {
    EXPECT_NEAR(vickers_from_brinell(row[1]), row[0], 1e-9);
    EXPECT_NEAR(tensile_from_vickers(row[0]), row[2] * 1e6, 0.03 * row[2] * 1e6) << row[0];
  }
}

TEST(Hardness, GivesTheYieldStrengthByItsShare) {
  EXPECT_DOUBLE_EQ(yield_from_vickers(300, 0.5), 480e6);
  EXPECT_THROW(yield_from_vickers(-1, 0.5), std::invalid_argument);
  EXPECT_THROW(yield_from_vickers(300, 1.2), std::invalid_argument);
  EXPECT_THROW(tensile_from_vickers(std::nan("")), std::invalid_argument);
}

// The hardness of the standards with the line of ISO 18265 gives the tensile strength of the standards within 6 %.
TEST(Hardness, FitsTheGradesOwnTensileStrength) {
  for (const char* name : {"R220", "R260", "R350HT", "R400HT", "ER7", "ER8", "ER9"}) {
    const Steel& g = grade(name);
    EXPECT_NEAR(tensile_from_vickers(vickers_from_brinell(g.hardness.low)) / g.tensile.low, 1, 0.06) << name;
  }
}

}  // namespace
}  // namespace railstrata
