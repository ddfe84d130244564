#include "damage/brittle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "tests/damage/hertz_stress.hpp"

namespace railstrata {
namespace {

// K_Ic = 15 MPa sqrt(m), sigma_1 = 870 MPa: 75 µm.
TEST(Brittle, CriticalFlawIsThatOfAnEdgeCrack) {
  EXPECT_NEAR(critical_flaw(15e6, 870e6), 75.4e-6, 0.1e-6);
  const double c = critical_flaw(40e6, 300e6);
  EXPECT_NEAR(1.12 * 300e6 * std::sqrt(M_PI * c), 40e6, 1);
  EXPECT_TRUE(std::isinf(critical_flaw(15e6, -1e6)));
  EXPECT_THROW(critical_flaw(0, 870e6), std::invalid_argument);
}

TEST(Brittle, PeaksAreByZoneWithResidualStress) {
  StressHistory h{.x = {0, 1}, .y = {0, 1, 2}, .depth = {0, 1e-3, 1e-3, 3e-3}, .zone = {1, 1, 0, 0}, .stress = {}};
  h.stress.resize(24);
  h.cycle(0, 2)[1] = {.xx = 300e6, .yy = 100e6};
  h.cycle(1, 1)[0] = {.xz = 500e6};  // principal stress 500 MPa
  h.cycle(2, 0)[0] = {.zz = 50e6};
  const std::vector<Sym3> residual{{.xx = -50e6, .yy = -50e6}, {}, {.yy = 80e6}, {}};
  const auto zones = principal_peaks(h, residual);
  ASSERT_EQ(zones.size(), 2u);
  EXPECT_EQ(zones[0].zone, 1);
  EXPECT_NEAR(zones[0].thickness, 1e-3, 1e-12);
  EXPECT_NEAR(zones[0].stress, 500e6, 1);
  EXPECT_EQ(zones[0].row, 1);
  EXPECT_NEAR(zones[1].stress, 80e6, 1);
}

TEST(ResidualRows, AreOfTheStressesAlongXAndY) {
  const std::vector<double> x{1, 2}, y{3, 4}, none, one{1};
  EXPECT_EQ(residual_rows(x, y)[1].xx, 2);
  EXPECT_EQ(residual_rows(x, y)[1].yy, 4);
  EXPECT_EQ(residual_rows(none, y)[0].yy, 3);
  EXPECT_TRUE(residual_rows(none, none).empty());
  EXPECT_THROW(residual_rows(x, one), std::invalid_argument);
}

// Friction draws the surface behind the patch: sigma_xx = 2 mu p0 at the trailing edge of a line contact.
TEST(Brittle, TractionDrawsTheSurfaceBehindThePatch) {
  const auto h = testing::history_of(testing::LineLoad{.friction = 0.3}, testing::rolling_samples(0.05), {0}, {0, 0.2});
  const auto zones = principal_peaks(h, {});
  EXPECT_NEAR(zones[0].stress, 0.6, 1e-6);
  EXPECT_EQ(zones[0].row, 0);
}

}  // namespace
}  // namespace railstrata
