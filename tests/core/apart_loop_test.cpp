
#include <gtest/gtest.h>

#include <vector>

#include "core/parallel.hpp"

namespace railstrata {
namespace {

TEST(ForEachApart, CallsEveryIndexOnceOnAnyNumberOfThreads) {
  const int before = max_threads();
  for (const int threads : {1, 2, 5, 70}) {
    set_threads(threads);
    for (const int n : {0, 1, 3, 1000}) {
      std::vector<int> calls(static_cast<std::size_t>(n), 0);
      for_each_apart(n, [&](std::ptrdiff_t i) { ++calls[static_cast<std::size_t>(i)]; });
      EXPECT_EQ(calls, std::vector<int>(static_cast<std::size_t>(n), 1)) << threads << ' ' << n;
    }
  }
  set_threads(before);
}

}  // namespace
}  // namespace railstrata
