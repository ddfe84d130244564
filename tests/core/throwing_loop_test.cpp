#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "core/parallel.hpp"

namespace railstrata {
namespace {

TEST(ForEachThatThrows, MakesAllCallsAndThrowsTheFirstFaultByIndex) {
  const int before = max_threads();
  for (const int threads : {1, 2, 5}) {
    set_threads(threads);
    std::vector<int> calls(100, 0);
    std::string thrown;
    try {
      for_each_that_throws(calls.size(), [&](std::size_t i) {
        ++calls[i];
        if (i % 40 == 17) throw std::runtime_error(std::to_string(i));
      });
    } catch (const std::runtime_error& e) {
      thrown = e.what();
    }
    EXPECT_EQ(thrown, "17");
    EXPECT_EQ(calls, std::vector<int>(100, 1)) << threads;
    EXPECT_NO_THROW(for_each_that_throws(0, [](std::size_t) { throw std::runtime_error("none"); }));
  }
  set_threads(before);
}

}  // namespace
}  // namespace railstrata
