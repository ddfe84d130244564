#include "body/tile_cut.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <random>

namespace railstrata {
namespace {

long largest_part(const std::vector<long>& work, const std::vector<int>& part) {
  std::map<int, long> sums;
  for (std::size_t k = 0; k < work.size(); ++k) sums[part[k]] += work[k];
  long most = 0;
  for (const auto& [p, sum] : sums) most = std::max(most, sum);
  return most;
}

// Every way to cut a row into at most so many stretches.
long best_of_all(const std::vector<long>& work, std::size_t begin, int parts) {
  if (begin == work.size()) return 0;
  if (parts == 0) return std::numeric_limits<long>::max();
  long best = std::numeric_limits<long>::max(), sum = 0;
  for (std::size_t end = begin + 1; end <= work.size(); ++end) {
    sum += work[end - 1];
    best = std::min(best, std::max(sum, best_of_all(work, end, parts - 1)));
  }
  return best;
}

}  // namespace

TEST(TileCut, NoOtherCutIntoStretchesHasASmallerLargest) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<long> work(1 + random() % 9);
    for (long& w : work) w = 1 + static_cast<long>(random() % 100);
    const int parts = 1 + static_cast<int>(random() % 5);
    const std::vector<int> cut = cut_evenly(work, parts);
    ASSERT_EQ(cut.size(), work.size());
    EXPECT_EQ(cut.front(), 0);
    EXPECT_LT(cut.back(), parts);
    for (std::size_t k = 1; k < cut.size(); ++k) EXPECT_TRUE(cut[k] == cut[k - 1] || cut[k] == cut[k - 1] + 1);
    EXPECT_EQ(largest_part(work, cut), best_of_all(work, 0, parts));
  }
}

// Two blocks of 5 and 3 tiles; rank 1 has the last two of the first block and the first of the second.
TEST(TileCut, ChainsOfACutBodyCoverItsTilesInTheirOrder) {
  Tiling tiling;
  for (int t = 0; t < 8; ++t) tiling.tiles.push_back({t < 5 ? 0 : 1, 64 * (t < 5 ? t : t - 5), 0});
  tiling.first_tile = {0, 5, 8};
  const TileCut cut{1, {0, 0, 0, 1, 1, 1, 2, 2}};
  const std::vector<OwnedChain> owned = stretches(tiling, cut);
  ASSERT_EQ(owned.size(), 4u);
  EXPECT_EQ(owned[1].first_tile, 3);
  EXPECT_EQ(owned[1].end_tile, 5);
  EXPECT_EQ(owned[2].owner, 1);
  EXPECT_EQ(owned[3].end_tile, 8);
  for (int wanted : {1, 2, 100}) {
    int next = 0, own = 0;
    for (const Chain& c : chains(tiling, wanted, cut)) {
      EXPECT_EQ(c.first_tile, next);
      EXPECT_EQ(tiling.tiles[c.first_tile].block, tiling.tiles[c.end_tile - 1].block);
      for (int t = c.first_tile; t < c.end_tile; ++t)
        EXPECT_EQ(cut.owner[static_cast<std::size_t>(t)], cut.owner[static_cast<std::size_t>(c.first_tile)]);
      own += cut.is_own(c.first_tile);
      next = c.end_tile;
    }
    EXPECT_EQ(next, 8);
    EXPECT_GE(own, std::min(wanted, 3));
  }
}

}  // namespace railstrata
