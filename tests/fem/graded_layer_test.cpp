// A graded layer in the mesh: a row of elements has the mean modulus over its height.
#include <gtest/gtest.h>

#include <cmath>

#include "small_rolling.hpp"
#include "tests/body/sample_bodies.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

CaseSpec graded_case(const std::vector<ModulusPoint>& table, int elements) {
  CaseSpec spec = small_case();
  LayerSpec layer;
  layer.young_table = table;
  layer.thickness = table.back().depth;
  layer.elements = elements;
  spec.layers = {layer};
  return spec;
}

double young_of(const Elastic& m) { return young(m); }

}  // namespace

TEST(GradedLayerInTheMesh, OfOneModulusIsTheUniformLayer) {
  CaseSpec uniform = small_case();
  uniform.layers.resize(1);
  uniform.layers[0].thickness = 2e-3;
  uniform.layers[0].elements = 1;  // one row: the coarser rows of the sides are the same too
  uniform.layers[0].material.young = 420e9;
  const RollingSystem a = small_system(uniform),
                      b = small_system(graded_case({{0, 420e9}, {0.5e-3, 420e9}, {2e-3, 420e9}}, 1));
  Field u = a.rail().layout.field(), fa = u, fb = b.rail().layout.field();
  ASSERT_EQ(fa.size(), fb.size());
  for (std::size_t k = 0; k < u.size(); ++k) u[k] = 1e-6 * scatter(k);
  linear_force(a.rail(), u, fa);
  linear_force(b.rail(), u, fb);
  double largest = 0, difference = 0;
  for (std::size_t k = 0; k < fa.size(); ++k) {
    largest = std::max(largest, std::abs(fa[k]));
    difference = std::max(difference, std::abs(fa[k] - fb[k]));
  }
  EXPECT_LT(difference, 1e-12 * largest);
}

TEST(GradedLayerInTheMesh, RowsHaveTheTablesMeans) {
  const Model m = build_model(graded_case({{0, 600e9}, {1e-3, 400e9}, {2e-3, 200e9}}, 4), ".");
  ASSERT_EQ(m.rail_materials.size(), 5u);
  for (int row = 0; row < 4; ++row) EXPECT_NEAR(young_of(m.rail_materials[row + 1]), 550e9 - row * 100e9, 1) << row;
  EXPECT_NEAR(young_of(m.rail_at_surface[1]), 600e9, 1);
  EXPECT_EQ(m.rail.material_layer, (std::vector<int>{0, 1, 1, 1, 1}));
  EXPECT_EQ(m.wheel_materials.size(), 1u);
}

// A column under end loads: the rows' compliance sum h/E against the integral of dz/E(z), t ln(E1/E0)/(E1 - E0) for a
// linear modulus.
TEST(GradedLayerInTheMesh, ComplianceOfAColumnConvergesWithTheSquareOfTheRows) {
  const double t = 3e-3, top = 840e9, bottom = 210e9, exact = t * std::log(top / bottom) / (top - bottom);
  const auto error = [&](int rows) {
    const Model m = build_model(graded_case({{0, top}, {t, bottom}}, rows), ".");
    double sum = 0;
    for (int r = 0; r < rows; ++r)
      sum +=
          (m.rail.contact.depth[r + 1] - m.rail.contact.depth[r]) /
          young_of(
              m.rail_materials[m.rail.blocks[m.rail.contact.block].section.quad_material[r * m.rail.contact.columns]]);
    return sum / exact - 1;
  };
  EXPECT_LT(std::abs(error(8)), 5e-3);
  EXPECT_NEAR(error(8) / error(16), 4, 0.1);
}

}  // namespace railstrata
