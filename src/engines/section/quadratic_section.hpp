#pragma once
// The section of a swept body in eight-node quadrilaterals: those of its mesh with nodes at the middles of their sides.
#include <array>
#include <utility>
#include <vector>

#include "mesh/swept.hpp"

namespace railstrata {

/// A node's displacement as a sum over free nodes: itself; those that carry a hanging node; nothing where it is held.
using NodeShares = std::vector<std::pair<int, double>>;

/// Shape functions on a side of three nodes, w from 0 at its beginning to 1.
inline std::array<double, 3> shape_on_side(double w) {
  return {(1 - w) * (1 - 2 * w), 4 * w * (1 - w), w * (2 * w - 1)};
}

struct QuadraticSection {
  std::vector<Vec2> nodes;                   ///< m
  std::vector<std::array<int, 8>> elements;  ///< corners anticlockwise seen from +x, then the middles of their sides
  std::vector<int> material;                 ///< of each element, into SweptBody::materials
  std::vector<NodeShares> shares;            ///< of each node, by free node
  int free_nodes = 0;
  std::vector<int> surface;                 ///< nodes of the band's running surface: corner, middle, corner, …
  std::vector<double> s;                    ///< m, their arc lengths
  std::vector<std::array<int, 3>> on_pads;  ///< sides of elements that rest on pads: corner, middle, corner
};

/// Blocks are joined by their ties; prescribed nodes are held. Hanging nodes follow the quadratic sides of the elements
/// that carry them.
QuadraticSection quadratic_section(const SweptBody& body);

}  // namespace railstrata
