#include "crack/layered_dislocation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "crack/gauss.hpp"
#include "crack/jump_waves.hpp"

namespace railstrata {
namespace {

bool one_material(const LayeredHalfSpace& body) {
  return std::all_of(body.layers.begin(), body.layers.end(), [&](const HalfSpaceLayer& layer) {
    return layer.material == body.substrate && !layer.bond.gives();
  });
}

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
      for (const GaussPoint& g : kGauss8) {
        const double k = low + (high - low) * g.node, weight = (high - low) * g.weight / std::numbers::pi;
        const JumpWaves waves(layered, k);
        std::vector<JumpWaves> of_metals;
        for (const CutBody& metal : alone) of_metals.emplace_back(metal, k);
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
