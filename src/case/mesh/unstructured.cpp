#include "mesh/unstructured.hpp"

#include "mesh/quality.hpp"

namespace railstrata {

namespace {

void append_block(HexMesh& mesh, const SweptBody& body, int index) {
  const Block& block = body.blocks[index];
  const auto first = static_cast<long long>(mesh.points.size()),
             per_station = static_cast<long long>(block.section.nodes.size());
  for (double t : block.stations.at)
    for (Vec2 p : block.section.nodes) mesh.points.push_back(swept_point(body.kind, body.origin, p, t));

  const int quads = static_cast<int>(block.section.quads.size());
  for (int j = 0; j < block.stations.elements(); ++j) {
    const long long here = first + j * per_station, there = first + (j + 1) % block.stations.nodes() * per_station;
    for (int q = 0; q < quads; ++q) {
      const std::array<int, 4>& n = block.section.quads[q];
      mesh.cells.push_back(
          {here + n[0], here + n[1], here + n[2], here + n[3], there + n[0], there + n[1], there + n[2], there + n[3]});
      mesh.material.push_back(block.material(q, j));
      mesh.block.push_back(index);
      mesh.scaled_jacobian.push_back(static_cast<float>(scaled_jacobian(element_corners(body, block, q, j))));
    }
  }
}

}  // namespace

HexMesh unstructured(const SweptBody& body) {
  HexMesh mesh;
  mesh.points.reserve(body.nodes());
  mesh.cells.reserve(body.elements());
  for (std::size_t b = 0; b < body.blocks.size(); ++b) append_block(mesh, body, static_cast<int>(b));
  return mesh;
}

}  // namespace railstrata
