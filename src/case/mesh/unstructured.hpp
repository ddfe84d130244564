#pragma once
// A swept body written out as a plain list of hexahedra, for files and pictures.
#include <array>
#include <vector>

#include "mesh/swept.hpp"

namespace railstrata {

struct HexMesh {
  std::vector<Vec3> points;  ///< model frame, m; blocks one after the other, nodes of one station together
  std::vector<std::array<long long, 8>> cells;  ///< corners in VTK's order (VTK_HEXAHEDRON)
  std::vector<int> material, block;             ///< per cell: indices into SweptBody::materials and SweptBody::blocks
  std::vector<float> scaled_jacobian;           ///< per cell, as in quality.hpp
};

/// Blocks keep their own points: where they are tied, points coincide or hang. Cells are ordered by block, station,
/// quadrilateral.
HexMesh unstructured(const SweptBody& body);

}  // namespace railstrata
