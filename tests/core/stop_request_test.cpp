#include "core/stop_request.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "core/faults.hpp"

namespace railstrata {
namespace {

TEST(StopRequest, StopsItsOwnThreadOnceItIsSet) {
  stop_if_requested();
  std::atomic<bool> flag{false};
  {
    const StopRequest stop(&flag);
    stop_if_requested();
    flag = true;
    EXPECT_THROW(stop_if_requested(), Interrupted);
    std::thread([] { EXPECT_NO_THROW(stop_if_requested()); }).join();
    const std::atomic<bool> never{false};
    const StopRequest inner(&never);
    EXPECT_NO_THROW(stop_if_requested());
  }
  EXPECT_NO_THROW(stop_if_requested());
}

TEST(StopRequest, WaitsForTheEndOfAParallelLoop) {
  const std::atomic<bool> flag{true};
  const StopRequest stop(&flag);
#pragma omp parallel for
  for (int i = 0; i < 8; ++i) EXPECT_NO_THROW(stop_if_requested());
  EXPECT_THROW(stop_if_requested(), Interrupted);
}

}  // namespace
}  // namespace railstrata
