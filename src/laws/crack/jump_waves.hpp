#pragma once
// The waves of a layered half-space under a jump of displacement at a depth, at one wave number.
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "halfspace/layered.hpp"

namespace railstrata {

/// A layer, or the part of one above or below the jump.
struct Slab {
  double top = 0, thickness = 0;  ///< m; 0: the substrate
  HalfSpaceMaterial material;
  Bond bond = {};  ///< of its bottom
  double kappa() const { return 3 - 4 * material.poisson; }
};

/// The slabs of a body, cut at a depth; jump: the one that begins there.
struct CutBody {
  std::vector<Slab> slabs;
  std::size_t jump = 0;
  std::size_t slab_at(double depth) const;
};
CutBody cut_at(const LayeredHalfSpace& body, double depth);

/// Stresses per jump (U, W) of one metre: columns; rows xx, zz, xz (of sin and cos of k x, layer_waves.hpp).
using JumpStress = Eigen::Matrix<double, 3, 2>;

class JumpWaves {
 public:
  JumpWaves(CutBody body, double k);
  /// slab: of the point; from the amplitudes of S, of T and of xx.
  JumpStress stress(std::size_t slab, double depth) const;

 private:
  Eigen::Matrix4d basis(std::size_t slab, double depth) const;
  std::vector<Slab> slabs_;
  double k_;
  Eigen::MatrixXd amplitude_;
};

/// Tractions across an interface per slip of it (lower less upper side) at one wave number, Pa/m: shear along the wave
/// vector and across it, by slip in that direction, and sigma_zz by slip along it, of U in u_x' = i U
/// (layer_waves.hpp).
struct SlipResponse {
  double along = 0, across = 0, normal = 0;
};
/// Of the interface below a layer, whose springs give besides.
SlipResponse slip_response(const LayeredHalfSpace& body, std::size_t layer, double k);

}  // namespace railstrata
