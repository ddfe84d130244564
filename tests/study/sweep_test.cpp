#include "study/sweep.hpp"

#include <gtest/gtest.h>

#include "core/faults.hpp"

namespace railstrata {
namespace {

LoadedCase base() { return parse_case("[case]\ntitle = \"base\"\n", "base.toml"); }

SweepOptions coarse() {
  SweepOptions options;
  options.bem.cell = 1e-3;
  return options;
}

}  // namespace

TEST(Sweep, SolvesTheCasesThatTakeTheirValuesAndNamesTheFaultOfTheOthers) {
  std::vector<SweepCase> cases =
      plan_sweep(base(), {}, {{"drive.friction_coefficient", {"0.3", "7", "0.1"}}});  // at most 2; more than F_T / G
  ASSERT_EQ(cases.size(), 3u);
  int ended = 0;
  SweepOptions options = coarse();
  options.ended = [&] { ++ended; };
  run_sweep(cases, options);
  EXPECT_EQ(ended, 3);
  EXPECT_EQ(cases[0].fault, "");
  EXPECT_TRUE(cases[0].summary.contains("contact"));
  EXPECT_FALSE(cases[1].loaded);
  EXPECT_NE(cases[1].fault, "");
  EXPECT_FALSE(cases[2].loaded);
  EXPECT_NE(cases[2].fault, "");
  EXPECT_TRUE(cases[1].summary.is_null() && cases[2].summary.is_null());
}

TEST(Sweep, IsRefusedIfNoCaseTakesItsValues) {
  EXPECT_THROW(plan_sweep(base(), {}, {{"drive.no_such_key", {"1", "2"}}}), CaseError);
}

TEST(Sweep, LeavesOutWhatHasNotBegunWhenItIsStopped) {
  std::vector<SweepCase> cases = plan_sweep(base(), {}, {{"drive.traction_coefficient", {"0.1", "0.2"}}});
  const std::atomic<bool> stop{true};
  SweepOptions options = coarse();
  options.stop = &stop;
  run_sweep(cases, options);
  EXPECT_FALSE(cases[0].done || cases[1].done);
}

TEST(Sweep, ThrowsWhatGoesWrongWhereACaseEnds) {
  std::vector<SweepCase> cases = plan_sweep(base(), {}, {{"drive.traction_coefficient", {"0.1"}}});
  SweepOptions options = coarse();
  options.ended = [] { throw EnvironmentError("the disk is full"); };
  EXPECT_THROW(run_sweep(cases, options), EnvironmentError);
  EXPECT_TRUE(cases[0].done);
}

}  // namespace railstrata
