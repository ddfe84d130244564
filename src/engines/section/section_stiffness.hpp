#pragma once
// Stiffness of a section under displacements that are waves along the sweep.
//
// u_x = i U e^{ikx}, u_y = v e^{ikx}, u_z = w e^{ikx}: with isotropic materials the stiffness of (U, v, w) is real and
// symmetric, K(k) = K0 + k K1 + k² K2. Of a revolved body x = R theta with a radius R, and displacements are those
// along, across and towards the axle at each theta: strains have r = -z in place of R, and r/R weighs the area.
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "material/elastic.hpp"
#include "section/quadratic_section.hpp"

namespace railstrata {

/// Strains xx, yy, zz, yz, xz, xy of (U, v, w) at the nodes of an element, shears twice the tensor's: B0 + k B1.
struct PointStrains {
  Eigen::Matrix<double, 6, 24> b0 = Eigen::Matrix<double, 6, 24>::Zero(), b1 = b0;
  double weight = 0;  ///< of the area
};
/// At the element's coordinates a, b from -1 to 1. radius: as section_stiffness.
PointStrains point_strains(const std::array<Vec2, 8>& nodes, double a, double b, double radius);

struct SectionStiffness {
  /// Lower triangles of one pattern; index 3 n + direction of free nodes n. Per m along the sweep, Pa m^j.
  Eigen::SparseMatrix<double> k0, k1, k2;
  /// Centrifugal force of a revolved body, per m along the sweep and squared angular velocity, N s²/m.
  Eigen::VectorXd rotation;
  Eigen::SparseMatrix<double> at(double k) const;  ///< k in 1/m
};

/// Springs below a rail by its length, N/m²: pads, even over the underside of the foot, and below them a sleeper that
/// is rigid and sinks alone.
struct RailSupport {
  double pad = 0;                                                      ///< vertical
  double pad_across = 0;                                               ///< lateral, and along the rail
  double ballast = 0;                                                  ///< below the sleeper
  double vertical() const { return pad * ballast / (pad + ballast); }  ///< of both in series
};

/// radius: R of a revolved body, m; 0: extruded. materials: as the mesh numbers them. support: below a mesh on pads.
SectionStiffness section_stiffness(const QuadraticSection& mesh, const std::vector<Elastic>& materials, double radius,
                                   const RailSupport& support = {});

}  // namespace railstrata
