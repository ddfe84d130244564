#include "app/control.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

#include "study/running_case.hpp"

namespace railstrata {
namespace {

TEST(Signals, TheFirstSignalAsksAndTheSecondEndsTheProgramWith130) {
  EXPECT_EXIT(  // in a process of its own: the handlers of a process are installed once
      {
        if (control_by_signals().stop) std::exit(3);
        std::raise(SIGTERM);
        if (!control_by_signals().stop) std::exit(1);
        std::raise(SIGINT);
        std::exit(2);
      },
      testing::ExitedWithCode(130), "");
}

TEST(Signals, InACaseOfAStudyTheSecondAsksTooAndEndsNothing) {
  EXPECT_EXIT(
      {
        ignore_second_signal_in_children();
        control_by_signals();
        std::raise(SIGTERM);
        std::raise(SIGINT);
        std::exit(control_by_signals().stop ? 3 : 1);
      },
      testing::ExitedWithCode(3), "");
}

TEST(Signals, SIGUSR1AsksForACheckpoint) {
  EXPECT_EXIT(
      {
        control_by_signals();
        std::raise(SIGUSR1);
        std::exit(control().save.exchange(false) && !control().save && !control().stop ? 3 : 1);
      },
      testing::ExitedWithCode(3), "");
}

}  // namespace
}  // namespace railstrata
