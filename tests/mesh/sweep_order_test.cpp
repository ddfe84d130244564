#include "mesh/sweep_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "mesh/bodies.hpp"
#include "tests/mesh/brick_mesh.hpp"

namespace railstrata {
namespace {

Section shuffled(Section section, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<int> number(section.nodes.size());
  std::iota(number.begin(), number.end(), 0);
  std::shuffle(number.begin(), number.end(), random);
  Section out = section;
  for (std::size_t n = 0; n < number.size(); ++n) out.nodes[number[n]] = section.nodes[n];
  for (auto& q : out.quads)
    for (int& n : q) n = number[n];
  std::shuffle(out.quads.begin(), out.quads.end(), random);
  return out;
}

}  // namespace

// Row by row of a grid of m x n quadrilaterals leaves m + 2 nodes open, corner by corner about twice as many, by chance
// nearly all.
TEST(SweepOrder, KeepsAFrontNarrowHoweverTheSectionIsNumbered) {
  const Section grid = mesh_brick(12, 40, 2, 1e-3, 1e-3, 1e-3).blocks[0].section;
  std::vector<int> rows(grid.quads.size());
  std::iota(rows.begin(), rows.end(), 0);
  EXPECT_EQ(widest_front(grid, rows), 14);
  EXPECT_EQ(sweep_order(grid), rows);
  for (unsigned seed : {1u, 2u, 3u}) {
    const Section section = shuffled(grid, seed);
    EXPECT_GT(widest_front(section, rows), 200) << seed;
    std::vector<int> order = sweep_order(section);
    EXPECT_LE(widest_front(section, order), 2 * 14) << seed;
    std::sort(order.begin(), order.end());
    EXPECT_EQ(order, rows) << seed;
  }
}

TEST(SweepOrder, GoesThroughPartsThatDoNotTouchOneAfterTheOther) {
  Section two = mesh_brick(3, 4, 2, 1e-3, 1e-3, 1e-3).blocks[0].section;
  const int nodes = static_cast<int>(two.nodes.size()), quads = static_cast<int>(two.quads.size());
  for (int n = 0; n < nodes; ++n) two.nodes.push_back(two.nodes[n]);
  for (int q = 0; q < quads; ++q) {
    auto other = two.quads[q];
    for (int& n : other) n += nodes;
    two.quads.push_back(other);
  }
  const std::vector<int> order = sweep_order(two);
  ASSERT_EQ(order.size(), two.quads.size());
  for (int k = 1; k < quads; ++k) EXPECT_EQ(order[k] < quads, order[0] < quads);
}

}  // namespace railstrata
