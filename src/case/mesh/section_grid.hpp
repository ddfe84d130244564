#pragma once
// Building blocks of plane sections: patches of quadrilaterals between four lines of nodes, and polylines.
#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh/swept.hpp"

namespace railstrata {

using NodeLine = std::vector<int>;  ///< indices of a section's nodes along a line

/// Appends points as nodes and returns their indices.
NodeLine add_nodes(Section& section, const std::vector<Vec2>& points);

/// Fills the patch between south and north (n + 1 nodes each, walked from west to east) and west and east (m + 1 nodes
/// each, from south to north) with n x m quadrilaterals of the matrix material; the corners are shared. Interior nodes
/// by transfinite interpolation (Gordon and Hall) with the arc-length parameters of the four lines. Quadrilaterals come
/// out anticlockwise whichever way the patch is turned. Returns the m + 1 rows of nodes, south first.
std::vector<NodeLine> add_patch(Section& section, const NodeLine& south, const NodeLine& north, const NodeLine& west,
                                const NodeLine& east);

/// Interior nodes of the straight line between two existing nodes at the given fractions (0 and 1 excluded), with both
/// ends.
NodeLine add_straight(Section& section, int from, int to, const std::vector<double>& fractions);
/// n intervals of equal length.
NodeLine add_straight(Section& section, int from, int to, int intervals);

/// n + 1 points at equal arc length along a polyline, its ends included.
std::vector<Vec2> resampled(const std::vector<Vec2>& polyline, int intervals);
double polyline_length(const std::vector<Vec2>& polyline);

/// Intervals of about `size` in `length`, at least so many.
inline int intervals_for(double length, double size, int least) {
  return std::max(least, static_cast<int>(std::lround(length / size)));
}

NodeLine reversed(NodeLine line);
NodeLine joined(NodeLine a, const NodeLine& b);  ///< b's first node, equal to a's last one, is dropped

/// Ties every slave node to the nearest place of the polyline of master nodes (weight clamped to the segment, snapped
/// to its ends within 1e-6).
void tie_to_line(SweptBody& body, int slave_block, const NodeLine& slaves, int master_block, const NodeLine& masters);

}  // namespace railstrata
