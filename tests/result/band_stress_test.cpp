#include "result/band_stress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bem/solve_bem.hpp"
#include "material/elastic.hpp"
#include "tests/mesh/brick_mesh.hpp"
#include "tests/result/crossed_cylinders.hpp"

namespace railstrata {
namespace {

/// Elements of 1 mm, `rows` of them of which the first `layer_rows` are a layer, with the stress of each given by
/// stress(row, x, y, depth).
template <class Stress>
BandStress sampled_band(SweptBody& brick, int layer_rows, Stress&& stress) {
  brick.materials = {"matrix", "layer"};
  const int columns = brick.contact.columns, rows = brick.contact.rows, stations = brick.blocks[0].stations.elements();
  for (int r = 0; r < layer_rows; ++r)
    for (int c = 0; c < columns; ++c) brick.blocks[0].section.quad_material[r * columns + c] = 1;
  BandSample sample;
  sample.columns = columns;
  sample.rows = rows;
  sample.stations = stations;
  for (int s = 0; s <= stations; ++s) sample.along.push_back(1e-3 * (s - 0.5 * stations));
  sample.stress.resize(static_cast<std::size_t>(columns) * rows * stations);
  BandStress band = band_stress(brick, sample, 0.5e-3 * columns);
  for (int s = 0; s < stations; ++s)
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c)
        band.sample.stress[band.index(c, r, s)] =
            stress(r, band.x(s), band.centre_y[c] - band.contact_y, band.centre_depth[r]);
  return band;
}

}  // namespace

TEST(StressAtDepth, IsThatOfOneMaterialAndExactForTheParabolaOfFourRowsAndTheLineOfTwo) {
  SweptBody brick = mesh_brick(1, 6, 1, 1e-3, 1e-3, 1e-3);
  const auto line = [](double z) { return 5 + 3e3 * z; };
  const auto parabola = [](double z) { return 1 - 2e3 * z + 4e5 * z * z; };
  const BandStress band = sampled_band(brick, 2, [&](int row, double, double, double z) {
    return Sym3{row < 2 ? line(z) : parabola(z), 0, 0, 0, 0, 0};
  });
  EXPECT_NEAR(stress_at_interface(band, 0, 2, 0, false).xx, line(2e-3), 1e-9);
  EXPECT_NEAR(stress_at_interface(band, 0, 2, 0, true).xx, parabola(2e-3), 1e-9);
  EXPECT_NEAR(stress_at_depth(band, 0, 5, 0, 6e-3).xx, parabola(6e-3), 1e-9);
  EXPECT_NEAR(stress_at_depth(band, 0, 4, 0, 4.2e-3).xx, parabola(4.2e-3), 1e-9);
  EXPECT_EQ(stress_at_depth(band, 0, 4, 0, band.centre_depth[4]).xx, parabola(band.centre_depth[4]));
}

TEST(StressAtDepth, OfALayerOfOneRowIsThatOfItsElement) {
  SweptBody brick = mesh_brick(1, 3, 1, 1e-3, 1e-3, 1e-3);
  const BandStress band =
      sampled_band(brick, 1, [](int row, double, double, double) { return Sym3{1.0 + row, 0, 0, 0, 0, 0}; });
  EXPECT_EQ(stress_at_interface(band, 0, 1, 0, false).xx, 1);
  EXPECT_NEAR(stress_at_interface(band, 0, 1, 0, true).xx, 1.5, 1e-12);
}

// Half-spaces on the mesh's own points: what the elements would say if their stresses were exact. A straight line
// through the two nearest centres is 5 % low.
TEST(StressAtDepth, AtTheBorderOfAThickStiffLayerIsWithinThreePerCentOfHalfSpaces) {
  CaseSpec spec = post_checks::crossed_cylinders();
  spec.layers.resize(1);
  spec.layers[0].thickness = 6e-3;
  spec.layers[0].material.young = 840e9;
  const BemResult r = solve_bem(spec, place(spec, {}), {});
  const Subsurface interior = rail_interior(r);
  SweptBody brick = mesh_brick(7, 10, 7, 1e-3, 1e-3, 1e-3);
  const BandStress band = sampled_band(brick, 6, [&](int, double x, double y, double z) {
    return interior.at({{x, y, z}}, false)[0].stress;
  });
  double largest = 0, line = 0, exact = 0;
  for (int s = 0; s < 7; ++s)
    for (int c = 0; c < 7; ++c) {
      const Sym3 near = band.at(c, 5, s), next = band.at(c, 4, s);
      largest = std::max(largest, von_mises(stress_at_interface(band, c, 6, s, false)));
      line = std::max(line, von_mises(near + 0.5 * (near - next)));
      exact = std::max(exact,
                       von_mises(interior.at({{band.x(s), band.centre_y[c] - band.contact_y, 6e-3}}, false)[0].stress));
    }
  EXPECT_LT(line / exact, 0.96);
  EXPECT_NEAR(largest / exact, 1, 0.03);
}

}  // namespace railstrata
