#pragma once
// Quality of the elements of a swept mesh. Elements of one quadrilateral with the same station spacing are congruent,
// so only the distinct ones are measured.
#include "mesh/swept.hpp"

namespace railstrata {

struct BlockQuality {
  std::string block;
  long elements = 0;
  double scaled_jacobian_min =
      0;  ///< smallest over the 8 corners: determinant of the unit edge vectors; 1 for a brick, <= 0 inverted
  double aspect_max = 0;  ///< longest edge / shortest edge
  double edge_min = 0;    ///< m
  Vec3 worst_at;          ///< centre of the element of the smallest scaled Jacobian, model frame
};

/// Smallest determinant of the three unit edge vectors at the eight corners.
double scaled_jacobian(const std::array<Vec3, 8>& corners);

std::vector<BlockQuality> measure_quality(const SweptBody& body);

/// The eight corners of the element of quadrilateral q between stations j and j+1 (modulo the number of stations when
/// closed), model frame: 0–3 the quadrilateral's corners at station j, 4–7 the same at station j+1 (VTK order for
/// right-handed sections).
std::array<Vec3, 8> element_corners(const SweptBody& body, const Block& block, int quad, int station);

}  // namespace railstrata
