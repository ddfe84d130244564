#include "core/stop_request.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "core/faults.hpp"

namespace railstrata {
namespace {

TEST(StopRequest, StopsItsOwnThreadOnceItIsSet) {
  stop_if_wished();
  std::atomic<bool> flag{false};
  {
    const StopRequest wish(&flag);
    stop_if_wished();
    flag = true;
    EXPECT_THROW(stop_if_wished(), Interrupted);
    std::thread([] { EXPECT_NO_THROW(stop_if_wished()); }).join();
    const std::atomic<bool> never{false};
    const StopRequest inner(&never);
    EXPECT_NO_THROW(stop_if_wished());
  }
  EXPECT_NO_THROW(stop_if_wished());
}

TEST(StopRequest, WaitsForTheEndOfAParallelLoop) {
  const std::atomic<bool> flag{true};
  const StopRequest wish(&flag);
#pragma omp parallel for
  for (int i = 0; i < 8; ++i) EXPECT_NO_THROW(stop_if_wished());
  EXPECT_THROW(stop_if_wished(), Interrupted);
}

}  // namespace
}  // namespace railstrata
