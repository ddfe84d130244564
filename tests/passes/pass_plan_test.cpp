#include "passes/pass_plan.hpp"
#include "spec/case_spec.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace railstrata {
namespace {

TEST(PassPlan, ListsBeginAgainAfterTheirLastValueEachByItself) {
  PassesSpec spec;
  spec.lateral_positions = {0, 2e-3, -1e-3};
  spec.traction_coefficients = {0.1, -0.05};
  EXPECT_EQ(passes_per_cycle(spec), 6);
  const double lateral[] = {0, 2e-3, -1e-3, 0, 2e-3, -1e-3, 0};
  const std::size_t traction[] = {0, 1, 0, 1, 0, 1, 0};
  for (int pass = 1; pass <= 7; ++pass) {
    EXPECT_EQ(pass_plan(spec, pass).lateral, lateral[pass - 1]) << pass;
    EXPECT_EQ(pass_plan(spec, pass).traction, traction[pass - 1]) << pass;
  }
  EXPECT_EQ(farthest_pass(spec), 2e-3);
}

TEST(PassPlan, WithoutListsEveryPassIsTheSame) {
  EXPECT_EQ(passes_per_cycle({}), 1);
  EXPECT_EQ(pass_plan({}, 17).lateral, 0);
  EXPECT_EQ(cases_of_tractions({}).size(), 1u);
}

TEST(PassPlan, ACaseForEachTractionTakesThePlaceOfACreepage) {
  CaseSpec spec;
  spec.drive.creepage = -1e-3;
  spec.passes.traction_coefficients = {0.1, -0.05};
  const std::vector<CaseSpec> cases = cases_of_tractions(spec);
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[1].drive.traction_coefficient, -0.05);
  EXPECT_FALSE(cases[1].drive.creepage.has_value());
}

/// Of a normal distribution cut at three: deviation 0.98658; mean of 4000 within 4/sqrt(4000).
TEST(PassPlan, PlacesScatterAsANormalDistributionCutAtThreeDeviations) {
  PassesSpec spec;
  spec.lateral_deviation = 2e-3;
  EXPECT_EQ(passes_per_cycle(spec), 10);
  EXPECT_DOUBLE_EQ(farthest_pass(spec), 6e-3);
  constexpr int kPasses = 4000;
  double sum = 0, squares = 0, beyond = 0;
  for (int pass = 1; pass <= kPasses; ++pass) {
    const double v = pass_plan(spec, pass).lateral / 2e-3;
    EXPECT_LE(std::abs(v), 3);
    sum += v;
    squares += v * v;
    beyond += std::abs(v) > 1 ? 1 : 0;
  }
  EXPECT_NEAR(sum / kPasses, 0, 4 / std::sqrt(kPasses));
  EXPECT_NEAR(std::sqrt(squares / kPasses), 0.98658, 0.04);
  EXPECT_NEAR(beyond / kPasses, (0.31731 - 0.0027) / 0.9973, 0.03);
}

TEST(PassPlan, ASeedGivesItsOwnPlacesAndTheSameOnesAgain) {
  PassesSpec one, two;
  one.lateral_deviation = two.lateral_deviation = 1e-3;
  two.lateral_seed = 2;
  EXPECT_EQ(pass_plan(one, 5).lateral, pass_plan(one, 5).lateral);
  EXPECT_NE(pass_plan(one, 5).lateral, pass_plan(one, 6).lateral);
  EXPECT_NE(pass_plan(one, 5).lateral, pass_plan(two, 5).lateral);
}

}  // namespace
}  // namespace railstrata
