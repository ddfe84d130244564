#include "fem/step_plan.hpp"

#include <gtest/gtest.h>

#include "small_rolling.hpp"

namespace railstrata {

using namespace fem_checks;

TEST(StepPlan, NamesTheBlocksThatMassScalingAddsToWithTheirMass) {
  const RollingSystem system = small_system(thinly_layered(small_case()));
  const StepLimits limits = StepPlan(system).limits;
  ASSERT_FALSE(limits.scaled_blocks.empty());
  double added = 0;
  for (const ScaledBlock& b : limits.scaled_blocks) {
    EXPECT_TRUE(b.name.starts_with("rail ") || b.name.starts_with("wheel ")) << b.name;
    EXPECT_GT(b.mass, 0);
    EXPECT_LT(b.mass, total_mass(system.rail()));
    added += b.added;
  }
  EXPECT_NEAR(added, limits.added_mass, 1e-12 * added);
}

TEST(StepPlan, WithRealMassesNamesNoBlock) {
  CaseSpec spec = thinly_layered(small_case());
  spec.run.mass_scaling_step = 0;
  const RollingSystem system = small_system(spec);
  EXPECT_TRUE(StepPlan(system).limits.scaled_blocks.empty());
}

}  // namespace railstrata
