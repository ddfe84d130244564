#include "material/elastic.hpp"

#include <gtest/gtest.h>

using namespace railstrata;

TEST(Elastic, LameConstantsGiveBackYoungAndPoisson) {
  const Elastic m = elastic(210e9, 0.3, 7800);
  EXPECT_NEAR(young(m), 210e9, 1);
  EXPECT_NEAR(poisson(m), 0.3, 1e-14);
}

TEST(Elastic, UniaxialStrainStressIsThePWaveModulus) {
  const Elastic m = elastic(210e9, 0.3, 7800);
  const double strain[6] = {1e-3, 0, 0, 0, 0, 0};
  double stress[6];
  elastic_stress(m.lambda, m.mu, strain, stress);
  EXPECT_NEAR(stress[0], 1e-3 * m.p_wave_modulus(), 1e-3);
  EXPECT_NEAR(stress[1], 1e-3 * m.lambda, 1e-3);
}

TEST(Elastic, PrincipalStressesOfPureShearAndRepeatedRoots) {
  const Vec3 shear = principal_stresses({0, 0, 0, 5, 0, 0});
  EXPECT_NEAR(shear.x, 5, 1e-12);
  EXPECT_NEAR(shear.y, 0, 1e-12);
  EXPECT_NEAR(shear.z, -5, 1e-12);
  const Vec3 uniaxial = principal_stresses({-7, 0, 0, 0, 0, 0});
  EXPECT_NEAR(uniaxial.x, 0, 1e-7);
  EXPECT_NEAR(uniaxial.z, -7, 1e-12);
  EXPECT_NEAR(von_mises({-7, 0, 0, 0, 0, 0}), 7, 1e-12);
  EXPECT_NEAR(von_mises({0, 0, 0, 0, 0, 2}), 2 * std::sqrt(3.0), 1e-12);
}
