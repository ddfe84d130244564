#pragma once
// Influence of the real bodies' sections less that of the half-spaces: between rows of cells, smooth along and across.
//
// With displacements (U, u_y, u_n) and tractions (Q, q_y, p) of the wave k, u_x = i U e^{ikx}, the difference of a
// body is a real symmetric matrix D(k) between stations across the surface. Less D at the largest k, the mesh's own
// local error,
//   u(x) = 1/pi Re ∫ D(k) τ(k) e^{ikx} dk,   τ(k) = sum over the cells of force e^{-ikx},
// by a fixed quadrature in k: no periods, no images.
#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "bem/patch_grid.hpp"
#include "bem/plane_algebra.hpp"
#include "bem/section_remainder.hpp"

namespace railstrata {

/// A body in the contact plane.
struct PlacedRemainder {
  std::vector<RemainderShare> kept;
  SectionPlane plane;
};

class RowsDifference {
 public:
  /// Planes of a direction: x, y, normal; null: none.
  using In = std::array<const double*, 3>;
  using Out = std::array<double*, 3>;

  RowsDifference(const PlacedRemainder& rail, const PlacedRemainder& wheel, const PatchGrid& grid);

  /// Adds displacements by tractions: signs as InfluenceOperator's. rows: of the outputs along x. Without the motion of
  /// the bodies as a whole, which is that in the middle by the load there: an approach and a shift stay those of
  /// half-spaces.
  void add(const In& in, const Out& out, int rows) const;
  /// The wheel's own displacement into it by p, with the approach of the whole.
  void add_of_wheel(const double* p, double* u_n, int rows) const {
    add(wheel_, {nullptr, nullptr, p}, {nullptr, nullptr, u_n}, rows);
  }
  /// Displacement of the wheel's rows towards the axle by a squared angular velocity, m s².
  const Eigen::VectorXd& by_rotation() const { return by_rotation_; }
  double stretch_by_load() const { return stretch_by_load_; }  ///< SectionRemainder's, of the rail
  /// Rows first_y to first_y + ny of the grid.
  std::shared_ptr<const RowsDifference> part(int first_y, int nx, int ny) const;

 private:
  using Kernel = std::vector<Eigen::MatrixXd>;  ///< of each wave number; index direction * n + station
  /// A kernel with what its stations and waves ask for.
  struct Part {
    bool in_full = false;
    Eigen::MatrixXd shares;                           ///< stations x rows: of a row's force
    Eigen::MatrixXd of_rows;                          ///< transposed: of a row's displacement
    Eigen::MatrixXd along;                            ///< cells along x x cosines and negative sines of the waves
    std::shared_ptr<const Kernel> kernel;             ///< with the weights of the quadrature and of a cell
    Eigen::Matrix3d rigid = Eigen::Matrix3d::Zero();  ///< m/N, motion of the body as a whole by forces
  };
  /// lowest: wave number, 1/m
  static Part part_of(const PlacedRemainder& placed, const PatchGrid& grid, double lowest);
  static void keep_stations(Part& part);  ///< that have shares of its rows
  void add(const Part& part, const In& in, const Out& out, int rows) const;

  int nx_, ny_;
  double cell_area_;
  std::vector<Part> pair_;  ///< of both bodies, or of each
  Part wheel_;
  Eigen::VectorXd by_rotation_;
  double stretch_by_load_ = 0;
  Eigen::Matrix3d rigid_;  ///< of both
};

}  // namespace railstrata
