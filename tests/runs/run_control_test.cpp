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

TEST(RunControl, WithoutWishesAndTimesItGoesOn) {
  RunControl control({}, {});
  EXPECT_EQ(control.demand(), Demand::go_on);
  control.watch_preload();
  EXPECT_FALSE(control.preload_stop());
}

TEST(RunControl, AWishToSaveIsFollowedOnce) {
  std::atomic<bool> save{true};
  RunControl control({}, {nullptr, &save});
  EXPECT_EQ(control.demand(), Demand::save);
  EXPECT_FALSE(save);
  EXPECT_EQ(control.demand(), Demand::go_on);
}

TEST(RunControl, AWishToStopIsNotTheLimit) {
  std::atomic<bool> stop{false};
  RunControl control({}, {&stop, nullptr});
  EXPECT_EQ(control.demand(), Demand::go_on);
  stop = true;
  EXPECT_EQ(control.demand(), Demand::save_and_stop);
  control.watch_preload();
  EXPECT_TRUE(control.preload_stop());
  EXPECT_FALSE(control.limit_reached());
}

TEST(RunControl, CheckpointsComeWhenTheirTimeIsOver) {
  RunTimes times = begun_ago(11);
  times.checkpoint_every = 10;
  RunControl control(times, {});
  EXPECT_EQ(control.demand(), Demand::save);
  control.saved(0.1);
  EXPECT_EQ(control.demand(), Demand::go_on);
}

TEST(RunControl, TheLimitLeavesTimeForTwoCheckpoints) {
  RunTimes times = begun_ago(50);
  times.limit = 100;
  RunControl early(times, {});
  EXPECT_EQ(early.demand(), Demand::go_on);
  early.saved(26);  // 50 + 2 x 26 is more than 100
  EXPECT_EQ(early.demand(), Demand::save_and_stop);
  EXPECT_TRUE(early.limit_reached());
  early.watch_preload();
  EXPECT_TRUE(early.preload_stop());
}

}  // namespace railstrata
