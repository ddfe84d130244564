#include "crack/layered_dislocation.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "halfspace/layer_waves.hpp"

namespace railstrata {
namespace {

/// A layer, or the part of one above or below the dislocation.
struct Slab {
  double top = 0, thickness = 0;  ///< m; 0: the substrate
  HalfSpaceMaterial material;
  double kappa() const { return 3 - 4 * material.poisson; }
};

/// Stresses per jump (U, W) of one metre: columns; rows xx, zz, xz (of sin and cos of k x as below).
using JumpStress = Eigen::Matrix<double, 3, 2>;

/// The waves of all slabs under a jump at the top of one of them.
class JumpWaves {
 public:
  JumpWaves(std::vector<Slab> slabs, std::size_t jump, double k) : slabs_(std::move(slabs)), k_(k) {
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
      matrix.block(row + 2, 4 * s - 4, 2, 4 + width) /= G;
      if (slab == jump) jumps.block(row, 0, 2, 2).setIdentity();
    }
    amplitude_ = matrix.partialPivLu().solve(jumps);
  }

  /// slab: of the point; amplitudes of S, of T and of xx.
  JumpStress stress(std::size_t slab, double depth) const {
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

 private:
  Eigen::Matrix4d basis(std::size_t slab, double depth) const {
    const Slab& s = slabs_[slab];
    const double kz = k_ * (depth - s.top), k_eta = k_ * s.thickness - kz;
    Eigen::Matrix4d out = Eigen::Matrix4d::Zero();
    out.leftCols<2>() = std::exp(-kz) * layer_wave::decaying(s.material.shear(), s.kappa(), kz);
    if (s.thickness > 0)
      out.rightCols<2>() = std::exp(-k_eta) * layer_wave::growing(s.material.shear(), s.kappa(), k_eta);
    return out;
  }
  std::vector<Slab> slabs_;
  double k_;
  Eigen::MatrixXd amplitude_;
};

/// The slabs of a body, cut at a depth; jump: the one that begins there.
struct CutBody {
  std::vector<Slab> slabs;
  std::size_t jump = 0;
  std::size_t slab_at(double depth) const {
    std::size_t s = slabs.size() - 1;
    while (s > 0 && depth <= slabs[s].top) --s;
    return s;
  }
};
CutBody cut_at(const LayeredHalfSpace& body, double depth) {
  CutBody out;
  double top = 0;
  const auto add = [&](double thickness, const HalfSpaceMaterial& material, bool last) {
    const double bottom = top + thickness;
    if (depth >= top && (last || depth < bottom) && out.jump == 0 && depth > 0) {
      if (depth > top) out.slabs.push_back({top, depth - top, material});
      out.jump = out.slabs.size();
      out.slabs.push_back({depth, last ? 0 : bottom - depth, material});
    } else {
      out.slabs.push_back({top, last ? 0 : thickness, material});
    }
    top = bottom;
  };
  for (const HalfSpaceLayer& layer : body.layers) add(layer.thickness, layer.material, false);
  add(0, body.substrate, true);
  return out;
}

bool one_material(const LayeredHalfSpace& body) {
  return std::all_of(body.layers.begin(), body.layers.end(),
                     [&](const HalfSpaceLayer& layer) { return layer.material == body.substrate; });
}

/// Gauss and Legendre's rule of eight points on 0 to 1.
constexpr double kNodes[] = {0.01985507175123188, 0.10166676129318664, 0.2372337950418355, 0.4082826787521751,
                             0.5917173212478249,  0.7627662049581645,  0.8983332387068134, 0.9801449282487681},
                 kWeights[] = {0.05061426814518813, 0.11119051722668724, 0.15685332293894363, 0.18134189168918100,
                               0.18134189168918100, 0.15685332293894363, 0.11119051722668724, 0.05061426814518813};

}  // namespace

Eigen::MatrixXd layers_traction(const LayeredHalfSpace& body, double angle, const std::vector<CrackPoint>& at,
                                const std::vector<CrackPoint>& from, double finest) {
  if (one_material(body)) return {};
  const auto n = static_cast<Eigen::Index>(at.size()), nodes = static_cast<Eigen::Index>(from.size());
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(2 * n, 2 * nodes);
  double reach = 0;
  for (const HalfSpaceLayer& layer : body.layers) reach += layer.thickness;
  for (const CrackPoint& p : at) reach = std::max({reach, std::abs(p.x), p.z});
  const double last = 8 / finest;
  const double across = angle + std::numbers::pi / 2;
  // one half-plane of each metal in which stress is asked
  std::vector<HalfSpaceMaterial> metals;
  std::vector<std::size_t> metal_of;
  for (const CrackPoint& p : at) {
    const HalfSpaceMaterial metal = material_at(body, p.z);
    const auto known = std::find(metals.begin(), metals.end(), metal);
    metal_of.push_back(static_cast<std::size_t>(known - metals.begin()));
    if (known == metals.end()) metals.push_back(metal);
  }
  for (Eigen::Index j = 0; j < nodes; ++j) {
    const CrackPoint& source = from[static_cast<std::size_t>(j)];
    const CutBody layered = cut_at(body, source.z);
    std::vector<CutBody> alone;
    for (const HalfSpaceMaterial& metal : metals) alone.push_back(cut_at({{}, metal}, source.z));
    std::vector<PlaneStress> of_x(at.size()), of_z(at.size());
    for (double low = 0, high = 0.25 / reach; low < last; low = high, high *= 2)
      for (int g = 0; g < 8; ++g) {
        const double k = low + (high - low) * kNodes[g], weight = (high - low) * kWeights[g] / std::numbers::pi;
        const JumpWaves waves(layered.slabs, layered.jump, k);
        std::vector<JumpWaves> of_metals;
        for (const CutBody& metal : alone) of_metals.emplace_back(metal.slabs, metal.jump, k);
        for (std::size_t i = 0; i < at.size(); ++i) {
          const JumpStress s = waves.stress(layered.slab_at(at[i].z), at[i].z) -
                               of_metals[metal_of[i]].stress(alone[metal_of[i]].slab_at(at[i].z), at[i].z);
          // of the side above: -b_x H(x) = i U e^{ikx}, U = b_x/k; -b_z H(x): W = i b_z/k
          const double c = weight / k * std::cos(k * (at[i].x - source.x)),
                       d = weight / k * std::sin(k * (at[i].x - source.x));
          of_x[i].xx += c * s(0, 0);
          of_x[i].zz += c * s(1, 0);
          of_x[i].xz -= d * s(2, 0);
          of_z[i].xx -= d * s(0, 1);
          of_z[i].zz -= d * s(1, 1);
          of_z[i].xz -= c * s(2, 1);
        }
      }
    for (Eigen::Index i = 0; i < n; ++i) {
      const PlaneStress &x = of_x[static_cast<std::size_t>(i)], &z = of_z[static_cast<std::size_t>(i)];
      const LineTraction tx = traction_on(x, angle), tz = traction_on(z, angle);
      const auto put = [&](Eigen::Index column, double direction) {
        const double bx = std::cos(direction), bz = std::sin(direction);
        out(i, column) = bx * tx.normal + bz * tz.normal;
        out(n + i, column) = bx * tx.shear + bz * tz.shear;
      };
      put(j, across);
      put(nodes + j, angle);
    }
  }
  return out;
}

}  // namespace railstrata
