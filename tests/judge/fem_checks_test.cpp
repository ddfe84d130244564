#include <gtest/gtest.h>

#include <algorithm>

#include "judge/check_limits.hpp"
#include "judge/fem_summary.hpp"
#include "tests/fem/small_rolling.hpp"

namespace railstrata {
namespace {

/// The check of the traction of a wheel that is to reach `wanted` and reaches `reached`.
std::vector<Check> traction_checks(double wanted, double reached) {
  CaseSpec spec = fem_checks::small_case();
  spec.drive.friction_coefficient = 0.3;
  spec.drive.traction_coefficient = wanted;
  MeanContact mean;
  const Model model = build_model(spec, ".");
  mean.F_z = model.load;
  mean.F_x = reached * model.load;
  std::vector<Check> out = finite_element_checks(model, {}, mean);
  std::erase_if(out, [](const Check& c) { return c.name != "traction_coefficient_reached"; });
  return out;
}

TEST(FemChecks, AskWhetherABrakingWheelReachesItsTraction) {
  for (const double sign : {1.0, -1.0}) {
    const std::vector<Check> missed = traction_checks(sign * 0.2, -0.0042),
                             reached = traction_checks(sign * 0.2, sign * 0.2);
    ASSERT_EQ(missed.size(), 1u) << "traction " << sign * 0.2;
    EXPECT_FALSE(missed[0].ok);
    EXPECT_EQ(missed[0].limit, check_row("traction_coefficient_reached").fem_limit);
    ASSERT_EQ(reached.size(), 1u);
    EXPECT_TRUE(reached[0].ok);
  }
  EXPECT_TRUE(traction_checks(0, 0).empty()) << "a wheel that rolls freely wants none";
}

}  // namespace
}  // namespace railstrata
