// Layers that have come off: nodes that stand twice below them.
#include "mesh/split_interface.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/faults.hpp"
#include "geometry/profile_names.hpp"
#include "tests/mesh/mesh_checks.hpp"

namespace railstrata {
namespace {

using namespace mesh_checks;

SweptBody rail_of(const std::vector<LayerMesh>& layers, RailShape shape = RailShape::rail) {
  RailMeshSpec spec = rail_spec(0, layers);
  spec.shape = shape;
  return mesh_rail(builtin_profile(ProfileKind::rail, "CN60"), kTrack, spec, MeshSizes{2e-3, 24e-3, 8e-3, 3, 12e-3});
}

std::vector<LayerMesh> unbonded_layer(double width = 0.06) {
  std::vector<LayerMesh> out = one_layer(4e-3, width);
  out[0].unbonded = {{4e-3, 12e-3}};
  out[0].unbonded_friction = 0.2;
  return out;
}

TEST(SplitInterface, BondedLayersHaveNone) { EXPECT_TRUE(rail_of(one_layer(4e-3)).interfaces.empty()); }

TEST(SplitInterface, ElementsBelowTheLayerHaveNodesOfTheirOwnAtTheSamePlaces) {
  for (const RailShape shape : {RailShape::rail, RailShape::block}) {
    const SweptBody body = rail_of(unbonded_layer(), shape), whole = rail_of(one_layer(4e-3), shape);
    ASSERT_EQ(body.interfaces.size(), 1u);
    const SplitInterface& interface = body.interfaces[0];
    const ContactBand& band = body.contact;
    const Section& section = body.blocks[band.block].section;
    EXPECT_NEAR(band.depth[interface.row], 4e-3, 1e-12);
    EXPECT_EQ(interface.first_column, 1) << "the band's edge stays single";
    EXPECT_EQ(interface.below.size(), static_cast<std::size_t>(band.columns - 1));
    EXPECT_EQ(interface.open[0].to, 12e-3);
    EXPECT_EQ(interface.friction, 0.2);
    EXPECT_EQ(section.nodes.size(), whole.blocks[band.block].section.nodes.size() + interface.below.size());
    EXPECT_NEAR(volume(body), volume(whole), 1e-12 * volume(whole));
    std::set<int> above_quads, below_quads;
    for (int q = 0; q < band.rows * band.columns; ++q)
      for (int node : section.quads[q]) (q / band.columns < interface.row ? above_quads : below_quads).insert(node);
    each_pair(interface, band, [&](int above, int below) {
      EXPECT_EQ(norm(section.nodes[above] - section.nodes[below]), 0);
      EXPECT_TRUE(above_quads.count(above) == 1 && below_quads.count(above) == 0) << above;
      EXPECT_TRUE(above_quads.count(below) == 0 && below_quads.count(below) == 1) << below;
    });
  }
}

TEST(SplitInterface, ANarrowLayerKeepsItsEdges) {
  const SweptBody body = rail_of(unbonded_layer(0.012));
  const SplitInterface& interface = body.interfaces.at(0);
  const Section& section = body.blocks[body.contact.block].section;
  EXPECT_EQ(interface.below.size(), 5u) << "six columns of 2 mm";
  for (int node : interface.below) EXPECT_LT(std::abs(section.nodes[node].y), 6e-3 - 1e-6);
}

TEST(SplitInterface, BondedAgainItHasATieForEveryPair) {
  const SweptBody body = rail_of(unbonded_layer()), tied = bonded(body);
  EXPECT_TRUE(tied.interfaces.empty());
  EXPECT_EQ(tied.ties.size(), body.ties.size() + nodes_below(body).size());
  EXPECT_EQ(tied.ties.back().slave_node, nodes_below(body).back());
}

TEST(SplitInterface, ALayerWithoutFineRowsOrColumnsIsRefused) {
  const auto refusal = [](const std::vector<LayerMesh>& layers) {
    try {
      rail_of(layers);
    } catch (const CaseError& e) {
      return std::string(e.what());
    }
    return std::string("taken");
  };
  EXPECT_NE(refusal(unbonded_layer(0.001)).find("fewer than two of the mesh's fine columns"), std::string::npos)
      << refusal(unbonded_layer(0.001));
}

}  // namespace
}  // namespace railstrata
