#include "app/processors.hpp"

#include <gtest/gtest.h>
#include <sched.h>

#include <cstdlib>
#include <string>

namespace railstrata {

TEST(Processors, OneCoreIsLeftWhenTheProcessMayRunOnOneProcessorOnly) {
  cpu_set_t all, one;
  ASSERT_EQ(sched_getaffinity(0, sizeof all, &all), 0);
  const int before = physical_cores();
  EXPECT_GE(before, 1);
  EXPECT_LE(before, CPU_COUNT(&all));
  int first = 0;
  while (!CPU_ISSET(first, &all)) ++first;
  CPU_ZERO(&one);
  CPU_SET(first, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  const int left = physical_cores();
  const std::string crowded = oversubscription(2);
  sched_setaffinity(0, sizeof all, &all);
  EXPECT_EQ(left, 1);
  EXPECT_NE(crowded.find("2 threads share 1 processor:"), std::string::npos) << crowded;
}

TEST(Processors, MoreThreadsThanProcessorsAreNamedWithTheRemedy) {
  EXPECT_NE(oversubscription(100000).find("--threads"), std::string::npos);
}

}  // namespace railstrata
