#include "app/signals.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

#include "study/child_process.hpp"

namespace railstrata {
namespace {

TEST(Signals, TheFirstSignalAsksAndTheSecondEndsTheProgramWith130) {
  EXPECT_EXIT(  // in a process of its own: the handlers of a process are installed once
      {
        if (stop_flag()) std::exit(3);
        std::raise(SIGTERM);
        if (!stop_flag()) std::exit(1);
        std::raise(SIGINT);
        std::exit(2);
      },
      testing::ExitedWithCode(130), "");
}

TEST(Signals, InACaseOfAStudyTheSecondAsksTooAndEndsNothing) {
  EXPECT_EXIT(
      {
        ignore_second_signal_in_children();
        static_cast<void>(stop_flag());
        std::raise(SIGTERM);
        std::raise(SIGINT);
        std::exit(stop_flag() ? 3 : 1);
      },
      testing::ExitedWithCode(3), "");
}

TEST(Signals, SIGUSR1AsksForACheckpoint) {
  EXPECT_EXIT(
      {
        static_cast<void>(stop_flag());
        std::raise(SIGUSR1);
        std::exit(save_flag().exchange(false) && !save_flag() && !stop_flag() ? 3 : 1);
      },
      testing::ExitedWithCode(3), "");
}

}  // namespace
}  // namespace railstrata
