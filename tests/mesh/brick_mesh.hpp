#pragma once
#include "mesh/swept.hpp"

namespace railstrata {

/// A plain brick: columns x rows x stations elements of size dx, dy, dz, one block, contact band on top (z = 0), base
/// fixed.
inline SweptBody mesh_brick(int columns, int rows, int stations, double dx, double dy, double dz) {
  SweptBody body;
  body.name = "brick";
  body.materials = {"matrix"};

  Block block{"brick", {}, {}};
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= columns; ++c) block.section.nodes.push_back({c * dy, -r * dz});
  const int stride = columns + 1;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const int top = r * stride + c, below = top + stride;
      block.section.quads.push_back({below, below + 1, top + 1, top});
    }
  block.section.quad_material.assign(block.section.quads.size(), 0);
  for (int j = 0; j <= stations; ++j) block.stations.at.push_back(j * dx);

  body.contact = {0, columns, rows, {}, {}, 0.0, stations * dx};
  for (int c = 0; c <= columns; ++c) body.contact.s.push_back(c * dy);
  for (int r = 0; r <= rows; ++r) body.contact.depth.push_back(r * dz);
  for (int c = 0; c <= columns; ++c) body.prescribed.push_back({0, rows * stride + c});
  body.blocks.push_back(std::move(block));
  return body;
}

}  // namespace railstrata
