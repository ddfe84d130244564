
#include <gtest/gtest.h>

#include <vector>

#include "core/parallel.hpp"

namespace railstrata {
namespace {

TEST(StagedLoop, EndsAStageBeforeTheNextBeginsForAnyNumberOfThreads) {
  constexpr int kStages = 5;
  const int before = max_threads();
  for (const int threads : {1, 2, 5}) {
    set_threads(threads);
    const auto count = [](int stage) { return stage == 2 ? std::ptrdiff_t{0} : std::ptrdiff_t{7 * (stage + 1)}; };
    std::vector<std::vector<int>> calls(kStages, std::vector<int>(7 * kStages, 0));
    std::vector<char> early(7 * kStages, 0);
    for_each_in_stages(kStages, count, [&](int stage, std::ptrdiff_t i) {
      ++calls[static_cast<std::size_t>(stage)][static_cast<std::size_t>(i)];
      for (int s = 0; s < stage; ++s)
        for (std::ptrdiff_t k = 0; k < count(s); ++k)
          if (calls[static_cast<std::size_t>(s)][static_cast<std::size_t>(k)] != 1)
            early[static_cast<std::size_t>(i)] = 1;
    });
    EXPECT_EQ(early, std::vector<char>(7 * kStages, 0)) << threads;
    for (int s = 0; s < kStages; ++s)
      for (std::ptrdiff_t i = 0; i < 7 * kStages; ++i)
        EXPECT_EQ(calls[static_cast<std::size_t>(s)][static_cast<std::size_t>(i)], i < count(s) ? 1 : 0)
            << threads << ' ' << s << ' ' << i;
  }
  set_threads(before);
}

}  // namespace
}  // namespace railstrata
