#include "mesh/layer_stacks.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/profile_names.hpp"
#include "tests/mesh/mesh_checks.hpp"

namespace railstrata {
namespace {

using namespace mesh_checks;

SweptBody rail_of(const std::vector<LayerMesh>& layers, const std::vector<double>& planes = {}) {
  RailMeshSpec spec = rail_spec(0, layers);
  spec.planes = planes;
  return mesh_rail(builtin_profile(ProfileKind::rail, "CN60"), kTrack, spec, MeshSizes{1e-3, 24e-3, 8e-3, 3, 12e-3});
}

std::vector<LayerMesh> stretch(double from, double to) {
  std::vector<LayerMesh> out = one_layer(3e-3);
  out[0].from = from;
  out[0].to = to;
  return out;
}

TEST(LayerStacks, ALayerThatEndsBeyondTheModelIsTheEndlessOne) {
  const SweptBody endless = rail_of(one_layer(3e-3)), beyond = rail_of(stretch(-1, 1), {-1, 1});
  for (std::size_t b = 0; b < endless.blocks.size(); ++b) {
    EXPECT_TRUE(beyond.blocks[b].along.empty());
    EXPECT_EQ(beyond.blocks[b].stations.at, endless.blocks[b].stations.at);
    EXPECT_EQ(beyond.blocks[b].section.quad_material, endless.blocks[b].section.quad_material);
  }
}

TEST(LayerStacks, ElementsAreOfTheLayerBetweenItsEndsAndNodePlanesStandThere) {
  const double from = 3.4e-3, to = 12.7e-3;
  const SweptBody body = rail_of(stretch(from, to), {from, to}), endless = rail_of(one_layer(3e-3));
  for (std::size_t b : {0u, 1u, 2u}) {
    const Block& block = body.blocks[b];
    const std::vector<double>& at = block.stations.at;
    EXPECT_NE(std::find(at.begin(), at.end(), from), at.end()) << block.name;
    EXPECT_NE(std::find(at.begin(), at.end(), to), at.end()) << block.name;
    ASSERT_EQ(block.sets(), 2) << block.name;
    for (int e = 0; e < block.stations.elements(); ++e) {
      const bool inside = at[e] >= from && at[e + 1] <= to;
      EXPECT_GT(at[e + 1], at[e]);
      for (std::size_t q = 0; q < block.section.quads.size(); ++q)
        ASSERT_EQ(block.material(static_cast<int>(q), e), inside ? endless.blocks[b].section.quad_material[q] : 0)
            << block.name << " " << e;
    }
  }
}

TEST(LayerStacks, WhereALayerIsNotTheNextOneReachesUpIntoItsPlace) {
  std::vector<LayerMesh> layers{{"upper", 1e-3, 0.060, 0}, {"lower", 2e-3, 0.060, 0}};
  layers[0].to = 6e-3;
  const std::vector<LayerMesh> slabs = slabs_of(layers);
  ASSERT_EQ(slabs.size(), 2u);
  EXPECT_NEAR(slabs[1].thickness, 2e-3, 1e-12);
  const SweptBody body = rail_of(layers, {6e-3});
  const Block& cap = body.blocks[0];
  const ContactBand& band = body.contact;
  const int middle = band.columns / 2, last = cap.stations.elements() - 1;
  for (int r = 0; r < band.rows; ++r) {
    const double depth = 0.5 * (band.depth[r] + band.depth[r + 1]);
    const int quad = r * band.columns + middle;
    EXPECT_EQ(cap.material(quad, 0), depth < 1e-3 ? 1 : depth < 3e-3 ? 2 : 0) << depth;
    EXPECT_EQ(cap.material(quad, last), depth < 3e-3 ? 2 : 0) << depth;
  }
}

}  // namespace
}  // namespace railstrata
