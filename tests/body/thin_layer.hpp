#pragma once
// Bodies with a thin stiff layer, and what the tests of time steps do with them.
#include "tests/body/free_matrix.hpp"
#include "tests/body/sample_bodies.hpp"
#include "tests/mesh/brick_mesh.hpp"

namespace railstrata::fem_checks {

/// A brick on its base whose rows from the surface down have the given heights; the first `layered` rows are of
/// materials[1].
inline SweptBody layered_brick(int columns, int stations, double dx, double dy, const std::vector<double>& heights,
                               int layered) {
  const int rows = static_cast<int>(heights.size());
  SweptBody body = mesh_brick(columns, rows, stations, dx, dy, 1.0);
  Section& s = body.blocks[0].section;
  std::vector<double> depth{0.0};
  for (double h : heights) depth.push_back(depth.back() + h);
  for (Vec2& p : s.nodes) p.z = -depth[static_cast<std::size_t>(std::lround(-p.z))];
  for (std::size_t q = 0; q < s.quads.size(); ++q) {
    double z = 0;
    for (int n : s.quads[q]) z += 0.25 * s.nodes[n].z;
    s.quad_material[q] = -z < depth[layered] ? 1 : 0;
  }
  body.materials = {"matrix", "layer"};
  return body;
}

inline const std::vector<double> kHeights{1e-4, 1e-4, 2e-4, 4e-4, 8e-4, 1e-3};
inline const std::vector<Elastic> kStiffOnSteel{kSteel, elastic(4 * kYoung, 0.3, 7800)};
inline const double kWanted = 1e-3 / std::sqrt(kSteel.p_wave_modulus() / kSteel.density);

inline Body thin_layer() { return {layered_brick(1, 3, 1e-3, 1e-3, kHeights, 2), kStiffOnSteel, {}}; }

inline Field scattered_forces(const Body& body, double size) {
  Field f = body.layout.field();
  std::size_t k = 0;
  for (std::ptrdiff_t i : free_indices(body)) f[i] = size * scatter(k++);
  return f;
}

}  // namespace railstrata::fem_checks
