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

// Where both parts are equal, (2N)^(b - c) = e_f E/s_f, the strain is twice either.
TEST(StrainLife, TransitionLifeIsThatOfTheClosedForm) {
  const StrainLife life = median_strain_life(880e6);
  const double reversals =
      std::pow(life.ductility * kYoung / life.strength, 1 / (life.strength_exponent - life.ductility_exponent));
  const double plastic = life.ductility * std::pow(reversals, life.ductility_exponent);
  EXPECT_NEAR(cycles_of_strain(life, kYoung, 2 * plastic), reversals / 2, 1e-9 * reversals);
  EXPECT_NEAR(cycles_of_plastic_strain(life, plastic), reversals / 2, 1e-9 * reversals);
  EXPECT_NEAR(cycles_of_stress(life, kYoung * plastic), reversals / 2, 1e-9 * reversals);
}

TEST(StrainLife, LongAndShortLivesAreThoseOfOnePart) {
  const StrainLife life = median_strain_life(880e6);
  for (const double amplitude : {1e-4, 1e-3, 1e-2, 0.3}) {
    const double n = cycles_of_strain(life, kYoung, amplitude);
    const double strain = life.strength / kYoung * std::pow(2 * n, life.strength_exponent) +
                          life.ductility * std::pow(2 * n, life.ductility_exponent);
    EXPECT_NEAR(strain / amplitude, 1, 1e-10) << amplitude;
  }
  EXPECT_NEAR(cycles_of_strain(life, kYoung, 1e-4) / cycles_of_stress(life, kYoung * 1e-4), 1, 1e-3);
}

}  // namespace
}  // namespace railstrata
