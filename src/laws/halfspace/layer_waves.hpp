#pragma once
// The waves of a layered half-space at one wave number: the part of layered.hpp that surface compliances and interior
// stresses share.
#include <Eigen/Core>
#include <vector>

#include "halfspace/layered.hpp"

namespace railstrata {

/// State (U, W, T/k, S/k) at a depth, for fields u_x' = i U e^{ikx'}, u_z = W e^{ikx'}, sigma_x'z = i T e^{ikx'},
/// sigma_zz = S e^{ikx'}; x' along the wave vector, z into the body. Columns: per unit amplitude of the two surface
/// waves.
using WaveState = Eigen::Matrix<double, 4, 2>;
/// State (V, Q/k) of the shear wave across x': u_y' = V e^{ikx'}, sigma_y'z = Q e^{ikx'}.
using ShearState = Eigen::Vector2d;

namespace layer_wave {
/// Decaying waves at k z below a layer's top, without their factor exp(-kz); kappa = 3 - 4 nu.
WaveState decaying(double G, double kappa, double kz);
/// Growing waves at k eta above a layer's bottom, without exp(-k eta): the mirror image.
WaveState growing(double G, double kappa, double k_eta);
}  // namespace layer_wave

class LayerWaves {
 public:
  LayerWaves(const LayeredHalfSpace& body, double k);
  WaveState state(double depth) const;
  ShearState shear_state(double depth) const;
  /// Layer index containing the depth; layers.size() is the substrate. An interface belongs to the layer above,
  /// or below if asked.
  std::size_t layer_at(double depth, bool below_interface = false) const;
  WaveState state(std::size_t layer, double depth) const;
  ShearState shear_state(std::size_t layer, double depth) const;

 private:
  struct Part {
    double top, thickness, shear, kappa;    // thickness 0: the substrate
    Eigen::Matrix2d reflection, amplitude;  // growing from decaying waves; decaying waves from those of the surface
    double shear_reflection, shear_amplitude;
  };
  double k_;
  std::vector<Part> parts_;
};

}  // namespace railstrata
