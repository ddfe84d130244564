#include "runs/run_control.hpp"

#include <gtest/gtest.h>

namespace railstrata {
namespace {

RunTimes begun_ago(double seconds) {
  RunTimes times;
  times.begun -=
      std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(seconds));
  return times;
}

}  // namespace

TEST(RunControl, AskedForNothingItGoesOn) {
  Control nobody;
  RunControl control({}, nobody);
  EXPECT_EQ(control.demand(), Demand::go_on);
  EXPECT_FALSE(control.must_stop());
}

TEST(RunControl, ARequestToSaveIsFollowedOnce) {
  Control asked;
  asked.save = true;
  RunControl control({}, asked);
  EXPECT_EQ(control.demand(), Demand::save);
  EXPECT_FALSE(asked.save);
  EXPECT_EQ(control.demand(), Demand::go_on);
}

TEST(RunControl, ARequestToStopIsNotTheLimit) {
  Control asked;
  RunControl control({}, asked);
  EXPECT_EQ(control.demand(), Demand::go_on);
  asked.stop = true;
  EXPECT_EQ(control.demand(), Demand::save_and_stop);
  EXPECT_TRUE(control.must_stop());
  EXPECT_FALSE(control.limit_reached());
}

TEST(RunControl, CheckpointsComeWhenTheirTimeIsOver) {
  RunTimes times = begun_ago(11);
  times.checkpoint_every = 10;
  Control nobody;
  RunControl control(times, nobody);
  EXPECT_EQ(control.demand(), Demand::save);
  control.saved(0.1);
  EXPECT_EQ(control.demand(), Demand::go_on);
}

TEST(RunControl, TheLimitLeavesTimeForTwoCheckpoints) {
  RunTimes times = begun_ago(50);
  times.limit = 100;
  Control nobody;
  RunControl early(times, nobody);
  EXPECT_EQ(early.demand(), Demand::go_on);
  early.saved(26);  // 50 + 2 x 26 is more than 100
  EXPECT_EQ(early.demand(), Demand::save_and_stop);
  EXPECT_TRUE(early.limit_reached());
  EXPECT_TRUE(early.must_stop());
}

}  // namespace railstrata
