#include "material/strain_claim.hpp"

#include <gtest/gtest.h>

namespace railstrata {
namespace {

TEST(StrainClaim, EquivalentStrainOfTensionIsTheStrainAndOfShearTheTensorOneByRootThree) {
  const double tension[6] = {0.02, -0.01, -0.01, 0, 0, 0}, shear[6] = {0, 0, 0, 0, 0, 0.03};
  EXPECT_NEAR(equivalent_strain(tension), 0.02, 1e-17);
  EXPECT_NEAR(equivalent_strain(shear), 0.06 / 1.7320508075688772, 1e-16);
}

TEST(StrainClaim, WarnsAboveFivePercentAndClaimsNothingAboveTen) {
  EXPECT_EQ(strain_warning(0), "");
  EXPECT_EQ(strain_warning(0.0499), "");
  EXPECT_NE(strain_warning(0.0501).find("reaches 5.0 %"), std::string::npos);
  EXPECT_EQ(strain_warning(0.0999).find("No claim of accuracy"), std::string::npos);
  EXPECT_EQ(strain_warning(0.1001).find("No claim of accuracy: plastic strain reaches 10.0 %"), 0u);
}

}  // namespace
}  // namespace railstrata
