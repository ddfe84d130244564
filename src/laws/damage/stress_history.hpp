#pragma once
// The stress cycle of one passage of the wheel at every point of a section across a body.
//
// Steady rolling: the stress at a point fixed in the rail over time is the stress along x at one instant. So a section
// (y, depth) with samples along x is all that shakedown and fatigue need. Axes: x rolling, y lateral in the contact
// plane, z into the body; tension positive.
#include <cstddef>
#include <vector>

#include "core/vec.hpp"

namespace railstrata {

/// Depths in ascending order, the first 0 (the surface). At an interface between materials there are two rows of one
/// depth, the upper one with the stresses and the zone of the layer above.
struct StressHistory {
  std::vector<double> x;      ///< m, samples of the cycle, ascending
  std::vector<double> y;      ///< m, ascending
  std::vector<double> depth;  ///< m, per row
  std::vector<int> zone;      ///< per row; 0: the matrix, then the layers from the surface down
  std::vector<Sym3> stress;   ///< Pa, elastic, of the contact alone; see at()
  int columns() const { return static_cast<int>(y.size()); }
  int rows() const { return static_cast<int>(depth.size()); }
  int samples() const { return static_cast<int>(x.size()); }
  /// The samples of a point stand next to each other.
  const Sym3* cycle(int row, int column) const {
    return stress.data() + (static_cast<std::size_t>(row) * y.size() + column) * x.size();
  }
  Sym3* cycle(int row, int column) {
    return stress.data() + (static_cast<std::size_t>(row) * y.size() + column) * x.size();
  }
};

}  // namespace railstrata
