#include "material/elastic.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace railstrata {
namespace {

constexpr Sym3 kStress{120e6, -340e6, -80e6, 60e6, -25e6, 90e6};

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
  EXPECT_NEAR(uniaxial.x, 0, 1e-14);
  EXPECT_NEAR(uniaxial.y, 0, 1e-14);
  EXPECT_NEAR(uniaxial.z, -7, 1e-12);
  EXPECT_NEAR(von_mises({-7, 0, 0, 0, 0, 0}), 7, 1e-12);
  EXPECT_NEAR(von_mises({0, 0, 0, 0, 0, 2}), 2 * std::sqrt(3.0), 1e-12);
}

TEST(Elastic, PrincipalStressesAreThoseOfAnEigensolverToRounding) {
  std::mt19937 random(3);
  std::normal_distribution<double> number;
  for (int i = 0; i < 20000; ++i) {
    Eigen::Matrix3d axes = Eigen::Quaterniond::UnitRandom().toRotationMatrix();
    const double gap = std::pow(10.0, -i % 18);  // two that come as close as rounding lets them
    const Eigen::Vector3d roots{number(random), 1.0, 1.0 + gap * number(random)};
    const Eigen::Matrix3d a = 1e9 * axes * roots.asDiagonal() * axes.transpose();
    const Eigen::Vector3d expected =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(a, Eigen::EigenvaluesOnly).eigenvalues();
    const Vec3 found = principal_stresses({a(0, 0), a(1, 1), a(2, 2), a(0, 1), a(1, 2), a(0, 2)});
    const double tolerance = 1e-14 * a.norm();
    EXPECT_NEAR(found.x, expected[2], tolerance) << i;
    EXPECT_NEAR(found.y, expected[1], tolerance) << i;
    EXPECT_NEAR(found.z, expected[0], tolerance) << i;
  }
}

TEST(Elastic, PacksOfBothPrecisionsGiveTheScalarsStress) {
  const Elastic m = elastic(210e9, 0.3, 7800);
  double strain[6], stress[6];
  Pack strains[6], stresses[6];
  PackOf<float> strains_f[6], stresses_f[6];
  for (int i = 0; i < 6; ++i) {
    strain[i] = 1e-3 * std::sin(1.0 + 3 * i);
    strains[i] = Pack{} + strain[i];
    strains_f[i] = PackOf<float>{} + static_cast<float>(strain[i]);
  }
  elastic_stress(m.lambda, m.mu, strain, stress);
  elastic_stress(m.lambda, m.mu, strains, stresses);
  elastic_stress(static_cast<float>(m.lambda), static_cast<float>(m.mu), strains_f, stresses_f);
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(stresses[i][kLanes - 1], stress[i], 1e-15 * 210e9);
    EXPECT_NEAR(stresses_f[i][0], stress[i], 1e-6 * 1e-3 * 210e9);
  }
}

// The three invariants of a stress, from its components and from its principal values.
TEST(Elastic, PrincipalStressesHaveTheInvariantsOfTheStress) {
  const Sym3& s = kStress;
  const Vec3 p = principal_stresses(s);
  EXPECT_GE(p.x, p.y);
  EXPECT_GE(p.y, p.z);
  const double det =
      s.xx * (s.yy * s.zz - s.yz * s.yz) - s.xy * (s.xy * s.zz - s.yz * s.xz) + s.xz * (s.xy * s.yz - s.yy * s.xz);
  EXPECT_NEAR((p.x + p.y + p.z) / (s.xx + s.yy + s.zz), 1, 1e-12);
  EXPECT_NEAR((p.x * p.y + p.y * p.z + p.z * p.x) /
                  (s.xx * s.yy + s.yy * s.zz + s.zz * s.xx - s.xy * s.xy - s.yz * s.yz - s.xz * s.xz),
              1, 1e-12);
  EXPECT_NEAR(p.x * p.y * p.z / det, 1, 1e-12);
  const double a = p.x - p.y, b = p.y - p.z, c = p.z - p.x;
  EXPECT_NEAR(von_mises(s) / std::sqrt(0.5 * (a * a + b * b + c * c)), 1, 1e-12);
}

TEST(Elastic, AHydrostaticStateHasNoVonMisesStress) {
  const Sym3 s{-5e8, -5e8, -5e8, 0, 0, 0};
  EXPECT_EQ(von_mises(s), 0);
  const Vec3 p = principal_stresses(s);
  EXPECT_EQ(p.x, -5e8);
  EXPECT_EQ(p.z, -5e8);
}

}  // namespace
}  // namespace railstrata
