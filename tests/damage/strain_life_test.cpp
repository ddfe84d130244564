#include "damage/strain_life.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace railstrata {
namespace {

constexpr double kYoung = 200e9;

// Numbers by hand: Rm/E = 0.0025, 0.005 and 0.011.
TEST(StrainLife, UniformMaterialLawHasTheNumbersOfSoftAndHardSteel) {
  EXPECT_DOUBLE_EQ(uniform_material_law(500e6, kYoung)->strength, 750e6);
  EXPECT_DOUBLE_EQ(uniform_material_law(500e6, kYoung)->ductility, 0.59);
  EXPECT_DOUBLE_EQ(uniform_material_law(1000e6, kYoung)->ductility, 0.59 * 0.75);
  EXPECT_FALSE(uniform_material_law(2200e6, kYoung));
  EXPECT_THROW(uniform_material_law(-1, kYoung), std::invalid_argument);
}

TEST(StrainLife, PlasticStrainOfALifeGivesTheLifeBack) {
  const StrainLife life = median_strain_life(880e6);
  const double amplitude = life.ductility * std::pow(2 * 1e5, life.ductility_exponent);
  EXPECT_NEAR(cycles_of_plastic_strain(life, amplitude), 1e5, 1e-4);
}

}  // namespace
}  // namespace railstrata
