#pragma once
// States below a section's surface under waves of line loads, at the middles of the elements of its band.
#include <Eigen/Core>
#include <vector>

#include "halfspace/hertz.hpp"
#include "mesh/swept.hpp"
#include "section/section_stiffness.hpp"

namespace railstrata {

/// Of an element of the band.
struct BandElement {
  double depth = 0, bottom = 0;  ///< m, of its middle and its lower side below the surface
  int layer = 0;                 ///< SweptBody::layer_of its material
  HalfSpaceMaterial material;
};

/// States (halfspace/interior.hpp) by forces at stations, both in the axes x, along the surface, into the body at their
/// own places. Row 6 (row * columns + column) + component: e_xx, e_yy, s_yz, s_zz are amplitudes of e^{ikx}, e_xy and
/// s_xz of i e^{ikx}. Column 3 m + direction at station m as in SectionCompliance.
struct SectionInterior {
  static constexpr int kComponents = 6, kStrains = 3;
  std::vector<Vec2> stations;         ///< m, in the section's plane
  std::vector<Vec2> columns;          ///< m, points of the surface above the middles of the elements
  std::vector<BandElement> elements;  ///< row * columns + column
  /// Pa, of a difference in full, which is from a block of this modulus, its strains over the modulus of each element;
  /// else 0.
  double block_young = 0;
  std::vector<double> k;            ///< 1/m, increasing
  std::vector<Eigen::MatrixXd> at;  ///< strains 1/(Pa m), tractions 1/m, of each k
};

/// body: whose quadratic section `mesh` is. A station at each corner of its columns. Wave numbers are solved in
/// parallel.
SectionInterior section_interior(const SweptBody& body, const QuadraticSection& mesh, const SectionStiffness& stiffness,
                                 const std::vector<Elastic>& materials, double radius, const std::vector<double>& k);

}  // namespace railstrata
