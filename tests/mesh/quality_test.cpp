#include "mesh/quality.hpp"
#include "geometry/profile_names.hpp"

#include <gtest/gtest.h>

#include "mesh/unstructured.hpp"
#include "mesh_checks.hpp"
#include "tests/mesh/brick_mesh.hpp"

namespace railstrata {
namespace {

using namespace mesh_checks;

TEST(MeshBrick, HasTheVolumeCountsAndContactBandOfItsGrid) {
  const SweptBody body = mesh_brick(4, 3, 5, 2e-3, 1e-3, 0.5e-3);
  EXPECT_EQ(body.elements(), 60);
  EXPECT_EQ(body.nodes(), 5 * 4 * 6);
  EXPECT_NEAR(volume(body), 60 * 1e-9, 1e-18);
  EXPECT_EQ(body.prescribed.size(), 5u);
  for (SectionNode n : body.prescribed) EXPECT_DOUBLE_EQ(body.blocks[0].section.nodes[n.node].z, -1.5e-3);
  for (int c = 0; c <= 4; ++c) EXPECT_DOUBLE_EQ(body.blocks[0].section.nodes[c].z, 0.0);
}

TEST(MeasureQuality, IsOneForCubesAndTheSineOfTheAngleForSheared) {
  SweptBody body = mesh_brick(2, 2, 2, 1e-3, 1e-3, 1e-3);
  EXPECT_NEAR(measure_quality(body)[0].scaled_jacobian_min, 1.0, 1e-12);
  EXPECT_NEAR(measure_quality(body)[0].aspect_max, 1.0, 1e-12);
  for (Vec2& p : body.blocks[0].section.nodes) p.y += p.z;
  EXPECT_NEAR(measure_quality(body)[0].scaled_jacobian_min, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(measure_quality(body)[0].aspect_max, std::sqrt(2.0), 1e-12);
}

TEST(QuadArea, IsThatOfAnyQuadrilateralBySignOfItsTurn) {
  const Section s{{{0, 0}, {2, 0}, {2, 1}, {0, 1}, {0.5, 0.25}}, {}, {}};
  EXPECT_DOUBLE_EQ(quad_area(s, {0, 1, 2, 3}), 2.0);
  EXPECT_DOUBLE_EQ(quad_area(s, {3, 2, 1, 0}), -2.0);
  EXPECT_DOUBLE_EQ(quad_area(s, {4, 1, 2, 3}), 1.5) << "the corner at 0.5, 0.25 takes half a unit away";
}

TEST(MeasureQuality, SeesAnInvertedElementAndSaysWhere) {
  SweptBody body = mesh_brick(3, 3, 2, 1e-3, 1e-3, 1e-3);
  body.blocks[0].section.nodes[5] = {2.2e-3, -1e-3};
  const BlockQuality q = measure_quality(body)[0];
  EXPECT_LT(q.scaled_jacobian_min, 0);
  EXPECT_NEAR(q.worst_at.z, -1e-3, 0.6e-3);
}

TEST(MeasureQuality, OfClassesEqualsThatOfEveryElement) {
  const SweptBody body = mesh_wheel(builtin_profile(ProfileKind::wheel, "LMA"), 0.43, {0.1, 0.2, 0.43}, wheel_spec(),
                                    {2e-3, 24e-3, 8e-3, 3, 12e-3});
  const HexMesh all = unstructured(body);
  std::vector<float> least(body.blocks.size(), 2.0F);
  for (std::size_t c = 0; c < all.cells.size(); ++c)
    least[all.block[c]] = std::min(least[all.block[c]], all.scaled_jacobian[c]);
  const std::vector<BlockQuality> classes = measure_quality(body);
  for (std::size_t b = 0; b < least.size(); ++b)
    EXPECT_NEAR(classes[b].scaled_jacobian_min, least[b], 1e-6) << classes[b].block;
}

TEST(Unstructured, HasEveryElementOnceWithTheBodysVolume) {
  const SweptBody body = mesh_rail(builtin_profile(ProfileKind::rail, "CN60"), kTrack, rail_spec(0, one_layer(2e-3)),
                                   {2e-3, 24e-3, 8e-3, 3, 12e-3});
  const HexMesh all = unstructured(body);
  ASSERT_EQ(static_cast<long>(all.cells.size()), body.elements());
  ASSERT_EQ(static_cast<long>(all.points.size()), body.nodes());
  double sum = 0;
  for (const auto& cell : all.cells) {
    std::array<Vec3, 8> x;
    for (int i = 0; i < 8; ++i) x[i] = all.points[cell[i]];
    sum += volume(x);
  }
  EXPECT_NEAR(sum, volume(body), 1e-12 * sum);
  EXPECT_EQ(*std::max_element(all.material.begin(), all.material.end()), 1);
}

}  // namespace
}  // namespace railstrata
