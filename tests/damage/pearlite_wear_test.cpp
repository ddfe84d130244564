#include "damage/pearlite_wear.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "damage/hardness.hpp"

namespace railstrata {

// The middles of EN 13674-1: R200 has 200 to 240 HBW, R260 260 to 300, R350HT 350 to 390.
TEST(PearliteWear, IsThatOfTheMeasuredRailsAtTheirHardness) {
  EXPECT_NEAR(pearlite_wear(vickers_from_brinell(220)), 1.34, 1e-12);
  EXPECT_NEAR(pearlite_wear(vickers_from_brinell(280)), 1, 1e-12);
  EXPECT_NEAR(pearlite_wear(vickers_from_brinell(370)), 1.0 / 3, 1e-12);
}

TEST(PearliteWear, IsAPowerOfTheHardnessBetweenTwoOfThem) {
  const double middle = std::sqrt(280.0 * 370.0);
  EXPECT_NEAR(pearlite_wear(vickers_from_brinell(middle)), std::sqrt(1.0 / 3), 1e-12);
}

TEST(PearliteWear, IsHeldBeyondThem) {
  EXPECT_NEAR(pearlite_wear(700), 1.0 / 3, 1e-12);
  EXPECT_NEAR(pearlite_wear(150), 1.34, 1e-12);
  EXPECT_NEAR(pearlite_wear_range().softest, 220 / 0.95, 1e-9);
  EXPECT_NEAR(pearlite_wear_range().hardest, 370 / 0.95, 1e-9);
  EXPECT_THROW(pearlite_wear(0), std::invalid_argument);
}

}  // namespace railstrata
