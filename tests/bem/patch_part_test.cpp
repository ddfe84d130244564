#include "bem/patch_part.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bem/influence_operator.hpp"

namespace railstrata {
namespace {

PatchGrid grid() { return {20, 18, 1e-3, 1e-3, -9.5e-3, -8.5e-3}; }

Plane patch() {
  Plane out(grid().size(), 0.0);
  for (int i = 6; i <= 11; ++i)
    for (int j = 5; j <= 10; ++j) out[grid().index(i, j)] = 1 + 0.1 * i - 0.03 * j;
  return out;
}

}  // namespace

TEST(PatchPart, HoldsThePatchAndARing) {
  const auto part = part_with(grid(), patch(), 2);
  ASSERT_TRUE(part);
  EXPECT_EQ(part->first_x, 4);
  EXPECT_EQ(part->first_y, 3);
  EXPECT_EQ(part->nx, 10);
  EXPECT_EQ(part->ny, 10);
  EXPECT_NEAR(part->grid().x(2), grid().x(6), 1e-18);
  EXPECT_NEAR(part->grid().y(0), grid().y(3), 1e-18);
  EXPECT_EQ(part->put(part->take(patch())), patch());
  EXPECT_TRUE(part->take(Plane{}).empty());
}

TEST(PatchPart, MayBeTight) {
  const auto part = tight_part_with(grid(), patch());
  ASSERT_TRUE(part);
  EXPECT_EQ(part->first_x, 5);
  EXPECT_EQ(part->first_y, 5);
  EXPECT_EQ(part->nx, 8);
  EXPECT_EQ(part->ny, 6);
  EXPECT_FALSE(tight_part_with(grid(), Plane(grid().size(), 1.0)));
  EXPECT_FALSE(tight_part_with(grid(), Plane(grid().size(), 0.0)));
  EXPECT_FALSE(tight_part_with(line_grid(10, 1e-3, 0.02), Plane(21, 1.0)));
}

TEST(PatchPart, IsNoneWhereItSavesLittleOrNothingPresses) {
  EXPECT_FALSE(part_with(grid(), Plane(grid().size(), 1.0), 2));
  EXPECT_FALSE(part_with(grid(), Plane(grid().size(), 0.0), 2));
  EXPECT_FALSE(part_with(line_grid(10, 1e-3, 0.02), Plane(21, 1.0), 2));
}

TEST(PatchPart, OfAnOperatorGivesTheDisplacementsOfTheWhole) {
  const SurfaceCompliance steel = homogeneous_compliance({});
  const InfluenceOperator whole(combined_compliance(steel, steel), grid().nx, grid().ny, 1e-3, 1e-3, 1e-15);
  const auto part = part_with(grid(), patch(), 2);
  ASSERT_TRUE(part);
  const auto own = whole.part(part->nx, part->ny, part->first_y);
  EXPECT_EQ(own, whole.part(part->nx, part->ny, part->first_y)) << "kept";
  Plane qx = patch(), qy = patch(), ux(grid().size()), uy(grid().size());
  for (double& q : qy) q *= -0.4;
  whole.tangential(qx.data(), qy.data(), ux.data(), uy.data(), grid().nx);
  const Plane px = part->take(qx), py = part->take(qy);
  Plane vx(px.size()), vy(px.size());
  own->tangential(px.data(), py.data(), vx.data(), vy.data(), part->nx);
  const Plane expected = part->take(ux);
  const double largest = *std::max_element(expected.begin(), expected.end());
  for (std::size_t k = 0; k < vx.size(); ++k) EXPECT_NEAR(vx[k], expected[k], 1e-13 * largest);
}

}  // namespace railstrata
