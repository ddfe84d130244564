#include "judge/plausibility.hpp"

#include <gtest/gtest.h>

namespace railstrata {
namespace {

CaseSpec rolling_case(double ramp, double speed) {
  CaseSpec spec;
  spec.drive.traction_coefficient = 0.2;
  spec.drive.torque_ramp = ramp;
  spec.drive.speed = speed;
  spec.run.start = RunStart::rest;
  spec.run.window = 10e-3;
  return spec;
}

StepLimits adding(double kilograms) {
  StepLimits limits;
  limits.scaled_blocks = {{"rail cap", 10, 0.01}, {"wheel cap", 13, kilograms}};
  return limits;
}

}  // namespace

TEST(RunAdvice, WarnsOfAWindowThatBeginsBeforeTheTorqueHasItsFullValue) {
  const CaseSpec spec = rolling_case(4e-3, 25);  // 100 mm
  EXPECT_TRUE(run_advice(spec, 0.105, {}).empty());
  const std::vector<Warning> early = run_advice(spec, 0.104, {});
  ASSERT_EQ(early.size(), 1u);
  EXPECT_EQ(early[0].name, "measured_within_torque_ramp");
  EXPECT_DOUBLE_EQ(early[0].value, 0.1);
  EXPECT_DOUBLE_EQ(early[0].limit, 0.099);
  EXPECT_NE(early[0].text.find("the torque rises over 4 ms, 100 mm at this speed"), std::string::npos) << early[0].text;
}

TEST(RunAdvice, IsSilentOnTheRampOfAWheelThatIsNotDrivenOrDoesNotRoll) {
  CaseSpec free = rolling_case(4e-3, 25), still = free;
  free.drive.traction_coefficient = 0;
  still.run.rolling = false;
  EXPECT_TRUE(run_advice(free, 0.05, {}).empty());
  CaseSpec guided = rolling_case(4e-3, 25);
  guided.drive.creepage = -1e-3;
  EXPECT_TRUE(run_advice(guided, 0.05, {}).empty()) << "no torque drives it";
  EXPECT_TRUE(run_advice(still, 0, {}).empty());
}

TEST(RunAdvice, WarnsOfMassScalingThatAddsMoreThanAHundredthOfABlock) {
  const CaseSpec spec = rolling_case(4e-3, 25);
  EXPECT_TRUE(run_advice(spec, 1, adding(0.129)).empty());
  const std::vector<Warning> much = run_advice(spec, 1, adding(36.4));
  ASSERT_EQ(much.size(), 1u);
  EXPECT_EQ(much[0].name, "mass_scaling_adds_much");
  EXPECT_DOUBLE_EQ(much[0].value, 36.4 / 13);
  EXPECT_NE(much[0].text.find("36.4 kg to the 13 kg of the wheel cap"), std::string::npos) << much[0].text;
  EXPECT_EQ(much[0].text.find("rail cap"), std::string::npos);
}

TEST(RunAdvice, GivesTheRampAsTheReasonOfATractionThatIsNotReached) {
  const CaseSpec spec = rolling_case(4e-3, 25);
  Summary reached, missed;
  reached.position = missed.position = 0.06;
  reached.checks = {{"traction_coefficient_reached", true, 0.005, 0.01}};
  missed.checks = {{"F_z_relative_to_weight", true, 0, 1}, {"traction_coefficient_reached", false, 0.641, 0.01}};
  add_run_advice(reached, spec, {});
  add_run_advice(missed, spec, {});
  ASSERT_EQ(reached.warnings.size(), 1u);
  ASSERT_EQ(missed.warnings.size(), 1u);
  const std::string reason = "traction_coefficient_reached fails for this reason";
  EXPECT_EQ(reached.warnings[0].text.find(reason), std::string::npos);
  EXPECT_NE(missed.warnings[0].text.find(reason), std::string::npos);
}

// A ball of 6 mm semi-axes at 1051 MPa needs about 10 um (docs/friction.md); a law that does not fall, or falls gently,
// none.
TEST(RunAdvice, WarnsOfAFrictionMemoryTooShortForStableSliding) {
  CaseSpec spec;
  EXPECT_FALSE(memory_advice(spec, 1051e6, 12.3e-3));
  spec.friction.law = FrictionForm::falling_exponential;
  spec.friction.kinetic_coefficient = 0.2;
  spec.friction.half_velocity = 1;
  spec.friction.memory_distance = 20e-6;
  EXPECT_FALSE(memory_advice(spec, 1051e6, 12.3e-3));
  spec.friction.memory_distance = 5e-6;
  const std::optional<Warning> warning = memory_advice(spec, 1051e6, 12.3e-3);
  ASSERT_TRUE(warning);
  EXPECT_EQ(warning->name, "short_friction_memory");
  EXPECT_NEAR(5 * warning->value, 9.6, 0.2);
  spec.friction.half_velocity = 100;
  EXPECT_FALSE(memory_advice(spec, 1051e6, 12.3e-3));
}

}  // namespace railstrata
