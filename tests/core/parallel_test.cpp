#include "core/parallel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace railstrata {
namespace {

// Runs with a number of threads and sets the old one again.
class Threads {
 public:
  explicit Threads(int n) : before_(max_threads()) { set_threads(n); }
  ~Threads() { set_threads(before_); }

 private:
  int before_;
};

TEST(ForEach, CallsEveryIndexOnceHoweverTheWorkIsShared) {
  for (const bool uneven : {false, true})
    for (const int threads : {1, 3}) {
      const Threads some(threads);
      std::vector<int> calls(1000, 0);
      for_each(
          1000, [&](std::ptrdiff_t i) { ++calls[static_cast<std::size_t>(i)]; }, uneven);
      EXPECT_EQ(calls, std::vector<int>(1000, 1)) << uneven << ' ' << threads;
      for_each(
          0, [&](std::ptrdiff_t) { FAIL(); }, uneven);
    }
}

TEST(OrderedSum, HasTheSameBitsForAnyNumberOfThreads) {
  const std::ptrdiff_t n = 100'003;
  const auto kernel = [](std::ptrdiff_t begin, std::ptrdiff_t end) {
    double sum = 0;
    for (std::ptrdiff_t i = begin; i < end; ++i) sum += std::sin(static_cast<double>(i)) / static_cast<double>(i + 1);
    return sum;
  };
  double one = 0;
  {
    const Threads single(1);
    one = ordered_sum(n, kernel);
  }
  for (const int threads : {2, 3, 7}) {
    const Threads some(threads);
    EXPECT_EQ(ordered_sum(n, kernel), one) << threads;
  }
  // sum of sin(i)/(i + 1), rounded differently: n additions of terms below 1
  EXPECT_NEAR(one, kernel(0, n), 1e-16 * n);
  EXPECT_EQ(ordered_sum(0, kernel), 0);
}

}  // namespace
}  // namespace railstrata
