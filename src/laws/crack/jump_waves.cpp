#include "crack/jump_waves.hpp"

#include <Eigen/LU>
#include <cmath>
#include <utility>

#include "halfspace/layer_waves.hpp"

namespace railstrata {

std::size_t CutBody::slab_at(double depth) const {
  std::size_t s = slabs.size() - 1;
  while (s > 0 && depth <= slabs[s].top) --s;
  return s;
}

CutBody cut_at(const LayeredHalfSpace& body, double depth) {
  CutBody out;
  double top = 0;
  const auto add = [&](double thickness, const HalfSpaceMaterial& material, const Bond& bond, bool last) {
    const double bottom = top + thickness;
    if (depth >= top && (last || depth < bottom) && out.jump == 0 && depth > 0) {
      if (depth > top) out.slabs.push_back({top, depth - top, material});
      out.jump = out.slabs.size();
      out.slabs.push_back({depth, last ? 0 : bottom - depth, material, bond});
    } else {
      out.slabs.push_back({top, last ? 0 : thickness, material, bond});
    }
    top = bottom;
  };
  for (const HalfSpaceLayer& layer : body.layers) add(layer.thickness, layer.material, layer.bond, false);
  add(0, body.substrate, {}, true);
  return out;
}

JumpWaves::JumpWaves(CutBody body, double k) : slabs_(std::move(body.slabs)), k_(k) {
  const auto n = static_cast<Eigen::Index>(slabs_.size()), size = 4 * n - 2;
  const double G = slabs_.front().material.shear();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  Eigen::MatrixXd jumps = Eigen::MatrixXd::Zero(size, 2);
  matrix.block(0, 0, 2, 4) = basis(0, slabs_[0].top).bottomRows(2) / G;
  for (Eigen::Index s = 1; s < n; ++s) {
    const Eigen::Index row = 4 * s - 2, width = s + 1 < n ? 4 : 2;
    const auto slab = static_cast<std::size_t>(s);
    matrix.block(row, 4 * s, 4, width) = basis(slab, slabs_[slab].top).leftCols(width);
    matrix.block(row, 4 * s - 4, 4, 4) = -basis(slab - 1, slabs_[slab].top);
    // what springs give, as in layer_waves.cpp
    const Bond& bond = slabs_[slab - 1].bond;
    const double held[2] = {1 / (1 + bond.shear * k * G), 1 / (1 + bond.normal * k * G)};
    for (Eigen::Index r = 0; r < 2; ++r) {
      matrix.row(row + r) *= held[r];
      matrix.block(row + r, 4 * s - 4, 1, 4) += (1 - held[r]) / G * matrix.block(row + r + 2, 4 * s - 4, 1, 4);
    }
    matrix.block(row + 2, 4 * s - 4, 2, 4 + width) /= G;
    if (slab == body.jump) jumps.block(row, 0, 2, 2).setIdentity();
  }
  amplitude_ = matrix.partialPivLu().solve(jumps);
}

JumpStress JumpWaves::stress(std::size_t slab, double depth) const {
  const Eigen::Index width = slab + 1 < slabs_.size() ? 4 : 2;
  const Eigen::Matrix<double, 4, 2> state =
      basis(slab, depth).leftCols(width) * amplitude_.middleRows(4 * static_cast<Eigen::Index>(slab), width);
  const HalfSpaceMaterial& m = slabs_[slab].material;
  const double nu = m.poisson, plane = m.young / (1 - nu * nu);
  JumpStress out;  // xx = -E/(1 - ν²) k U + ν/(1 - ν) S
  out.row(0) = k_ * (-plane * state.row(0) + nu / (1 - nu) * state.row(3));
  out.row(1) = k_ * state.row(3);
  out.row(2) = k_ * state.row(2);
  return out;
}

Eigen::Matrix4d JumpWaves::basis(std::size_t slab, double depth) const {
  const Slab& s = slabs_[slab];
  const double kz = k_ * (depth - s.top), k_eta = k_ * s.thickness - kz;
  Eigen::Matrix4d out = Eigen::Matrix4d::Zero();
  out.leftCols<2>() = std::exp(-kz) * layer_wave::decaying(s.material.shear(), s.kappa(), kz);
  if (s.thickness > 0)
    out.rightCols<2>() = std::exp(-k_eta) * layer_wave::growing(s.material.shear(), s.kappa(), k_eta);
  return out;
}

SlipResponse slip_response(const LayeredHalfSpace& body, std::size_t layer, double k) {
  LayeredHalfSpace bonded = body;
  const Bond bond = std::exchange(bonded.layers[layer].bond, {});
  double depth = 0, above = 0;  // the latter: shear across over k and displacement, of the upper side
  for (std::size_t l = 0; l <= layer; ++l) {
    const HalfSpaceLayer& part = bonded.layers[l];
    const double G = part.material.shear(), wave = std::tanh(k * part.thickness);
    above = (above + G * wave) / (1 + above / G * wave);
    above /= 1 + part.bond.shear * k * above;
    depth += part.thickness;
  }
  const auto under = bonded.layers.begin() + static_cast<std::ptrdiff_t>(layer) + 1;
  const ShearState lower = LayerWaves({{under, bonded.layers.end()}, body.substrate}, k).shear_state(0, 0);
  const CutBody cut = cut_at(bonded, depth);
  const JumpStress jump = JumpWaves(cut, k).stress(cut.jump, depth);
  Eigen::Matrix2d stiff;  // shear and normal traction by jumps; with springs these are slip + c traction
  stiff << jump.row(2), jump.row(1);
  const Eigen::Matrix2d given =
      Eigen::Matrix2d::Identity() - stiff * Eigen::Vector2d(bond.shear, bond.normal).asDiagonal();
  const Eigen::Vector2d slip = given.partialPivLu().solve(stiff.col(0));
  return {slip[0], -k / (1 / above - lower[0] / lower[1] + bond.shear * k), slip[1]};
}

}  // namespace railstrata
