#include "halfspace/layer_waves.hpp"

#include <Eigen/LU>
#include <cmath>

namespace railstrata {

namespace layer_wave {

WaveState decaying(double G, double kappa, double kz) {
  WaveState w;
  w << 1, -kz, -1, kappa + kz, -2 * G, G * (kappa - 1 + 2 * kz), 2 * G, -G * (kappa + 1 + 2 * kz);
  return w;
}

WaveState growing(double G, double kappa, double k_eta) {
  WaveState w = decaying(G, kappa, k_eta);
  w.row(1) *= -1;
  w.row(2) *= -1;
  return w;
}

}  // namespace layer_wave

using namespace layer_wave;

LayerWaves::LayerWaves(const LayeredHalfSpace& body, double k) : k_(k) {
  double top = 0;
  const auto add = [&](double thickness, const HalfSpaceMaterial& m) {
    parts_.push_back(
        {top, thickness, m.shear(), 3 - 4 * m.poisson, Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Identity(), 0, 1});
    top += thickness;
  };
  for (const HalfSpaceLayer& layer : body.layers) add(layer.thickness, layer.material);
  add(0, body.substrate);

  // From the substrate up: the field at the top of what lies below, per unit decaying wave there, fixes the reflection
  // at the bottom of the layer above.
  std::vector<Eigen::Matrix2d> transmitted(parts_.size());
  std::vector<double> shear_transmitted(parts_.size());
  for (std::size_t l = parts_.size() - 1; l-- > 0;) {
    Part& p = parts_[l];
    const WaveState below = state(l + 1, parts_[l + 1].top);
    const double decay = std::exp(-k * p.thickness), unit = 1 / p.shear;
    Eigen::Matrix4d match;
    match << growing(p.shear, p.kappa, 0), -below;
    Eigen::Matrix<double, 4, 2> incoming = -decay * decaying(p.shear, p.kappa, k * p.thickness);
    // the lower side's displacement less what the springs give; both over 1 + c k G, which stays finite
    const Bond& bond = body.layers[l].bond;
    const double held[2] = {1 / (1 + bond.shear * k * p.shear), 1 / (1 + bond.normal * k * p.shear)};
    for (int r = 0; r < 2; ++r) {
      match.row(r) *= held[r];
      incoming.row(r) *= held[r];
      match.block<1, 2>(r, 2) += (1 - held[r]) * unit * below.row(r + 2);
    }
    match.bottomRows<2>() *= unit;
    incoming.bottomRows<2>() *= unit;
    const Eigen::Matrix<double, 4, 2> out = match.partialPivLu().solve(incoming);
    p.reflection = out.topRows<2>();
    transmitted[l + 1] = out.bottomRows<2>();

    const ShearState shear_below = shear_state(l + 1, parts_[l + 1].top);
    const double under_springs = shear_below[0] - bond.shear * k * shear_below[1];
    const double impedance = -shear_below[1] / (under_springs * p.shear);  // of what lies below, over this layer's
    p.shear_reflection = decay * (1 - impedance) / (1 + impedance);
    shear_transmitted[l + 1] = (decay + p.shear_reflection) / under_springs;
  }
  for (std::size_t l = 1; l < parts_.size(); ++l) {
    parts_[l].amplitude = transmitted[l] * parts_[l - 1].amplitude;
    parts_[l].shear_amplitude = shear_transmitted[l] * parts_[l - 1].shear_amplitude;
  }
}

std::size_t LayerWaves::layer_at(double depth, bool below_interface) const {
  std::size_t l = 0;
  while (l + 1 < parts_.size() && (below_interface ? depth >= parts_[l + 1].top : depth > parts_[l + 1].top)) ++l;
  return l;
}

WaveState LayerWaves::state(double depth) const { return state(layer_at(depth), depth); }
ShearState LayerWaves::shear_state(double depth) const { return shear_state(layer_at(depth), depth); }

WaveState LayerWaves::state(std::size_t layer, double depth) const {
  const Part& p = parts_[layer];
  const double kz = k_ * (depth - p.top);
  WaveState w = std::exp(-kz) * decaying(p.shear, p.kappa, kz);
  if (p.thickness > 0) {
    const double k_eta = k_ * p.thickness - kz;
    w += std::exp(-k_eta) * growing(p.shear, p.kappa, k_eta) * p.reflection;
  }
  return w * p.amplitude;
}

ShearState LayerWaves::shear_state(std::size_t layer, double depth) const {
  const Part& p = parts_[layer];
  const double kz = k_ * (depth - p.top), down = std::exp(-kz);
  const double up = p.thickness > 0 ? std::exp(kz - k_ * p.thickness) * p.shear_reflection : 0.0;
  return p.shear_amplitude * ShearState(down + up, p.shear * (up - down));
}

}  // namespace railstrata
