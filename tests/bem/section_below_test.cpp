// States below the contact of sections, against what closed forms have.
#include "bem/section_below.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bem/solve_bem.hpp"

namespace railstrata {
namespace {

constexpr double kHeight = 40e-3;  // m, of a slab on a rigid base
constexpr double kRadius = 200;    // m, of a disc that is straight

/// A slab below a plane: the block of a rail, or the ring of a large disc.
CaseSpec slab_case() {
  CaseSpec spec;
  spec.geometry.rail_profile = spec.geometry.wheel_profile = "flat:W=300 mm";
  spec.geometry.rail_shape = RailShape::block;
  spec.geometry.block_width = 0.24;
  spec.geometry.block_height = kHeight;
  spec.geometry.cant = 0;
  spec.geometry.wheel_shape = WheelShape::disc;
  spec.geometry.wheel_radius = kRadius;
  spec.geometry.wheel_section.rim_thickness = 0.98 * kHeight;
  spec.geometry.wheel_section.hub_radius = kRadius - 0.99 * kHeight;
  spec.geometry.wheel_section.bore_radius = kRadius - kHeight;
  return spec;
}

/// Loads on a disc of 5 mm, none of them even.
PlaneLoads loads_on(const PatchGrid& grid) {
  PlaneLoads out{Plane(grid.size()), Plane(grid.size()), Plane(grid.size())};
  for (std::size_t k = 0; k < grid.size(); ++k) {
    const double x = grid.x_of(k), y = grid.y_of(k), inside = 1 - (x * x + y * y) / 25e-6;
    if (inside <= 0) continue;
    out.p[k] = 1e9 * std::sqrt(inside);
    out.q_x[k] = 3e8 * std::sqrt(inside) * (1 + 100 * x);
    out.q_y[k] = 2e8 * std::sqrt(inside) * (1 - 60 * y);
  }
  return out;
}

Subsurface below(const LayeredHalfSpace& body, const PatchGrid& grid) {
  PlaneLoads loads = loads_on(grid);
  return {body, grid, std::move(loads.p), std::move(loads.q_x), std::move(loads.q_y), 12};
}

class SectionBelowTest : public testing::TestWithParam<BodyId> {};

TEST_P(SectionBelowTest, OfASlabIsThatOfALayerOnARigidBase) {
  const CaseSpec spec = slab_case();
  const Placement placement = place(spec, ".");
  const PatchGrid grid = centred_grid(28, 28, 0.5e-3, 0.5e-3);
  const HalfSpaceMaterial steel{spec.rail_material.young, spec.rail_material.poisson};
  const auto slab_on = [&](double ratio) {
    return below({{{.thickness = kHeight, .material = steel}}, {ratio * steel.young, steel.poisson}}, grid);
  };
  SectionStore store;
  Subsurface section = below({{}, steel}, grid);
  section.stand_on(std::make_unique<const SectionBelow>(
      std::make_shared<const LoadedSection>(LoadedSection{store.below(spec, placement, GetParam(), {{}, steel}, grid),
                                                          {GetParam() == BodyId::rail ? Vec2{} : Vec2{0, -kRadius}, 0},
                                                          grid,
                                                          loads_on(grid)}),
      grid));
  const Subsurface exact = slab_on(1e6), alike = slab_on(1 + 1e-9), half_space = below({{}, steel}, grid);
  for (const double depth : {2e-3, 5e-3, 9e-3}) {
    const StatePlane of_section = section.plane(depth), of_half_space = half_space.plane(depth),
                     of_slab = exact.plane(depth), of_alike = alike.plane(depth);
    for (const auto state : {&StatePlane::e_xx, &StatePlane::e_yy, &StatePlane::e_xy, &StatePlane::s_xz,
                             &StatePlane::s_yz, &StatePlane::s_zz}) {
      double worst = 0, difference = 0, size = 0;
      for (std::size_t k = 0; k < grid.size(); ++k) {
        const double found = (of_section.*state)[k] - (of_half_space.*state)[k],
                     wanted = (of_slab.*state)[k] - (of_alike.*state)[k];
        worst = std::max(worst, std::abs(found - wanted));
        difference = std::max(difference, std::abs(wanted));
        size = std::max(size, std::abs((of_slab.*state)[k]));
      }
      EXPECT_LT(worst, 0.01 * difference + 3e-5 * size) << "at " << depth;
    }
  }
}

TEST(SectionBelow, OfANarrowLayerIsThatOfTheLayerInItsMiddleAndOfSteelBeside) {
  CaseSpec spec = slab_case();
  spec.geometry.block_height = 0.2;
  LayerSpec layer;
  layer.thickness = 3e-3;
  layer.material.young *= 4;
  layer.width = 18e-3;
  spec.layers = {layer};
  const Placement placement = place(spec, ".");
  const PatchGrid grid = centred_grid(14, 14, 0.5e-3, 0.5e-3);
  const HalfSpaceMaterial steel{spec.rail_material.young, spec.rail_material.poisson},
      clad{4 * steel.young, steel.poisson};
  const LayeredHalfSpace body{{{.thickness = layer.thickness, .material = clad}}, steel};
  SectionStore store;
  Subsurface section = below(body, grid);
  section.stand_on(std::make_unique<const SectionBelow>(
      std::make_shared<const LoadedSection>(
          LoadedSection{store.below(spec, placement, BodyId::rail, body, grid), {Vec2{}, 0}, grid, loads_on(grid)}),
      grid));
  const Subsurface endless = below(body, grid);
  const std::size_t middle = grid.index(14, 14);
  for (const double depth : {0.5e-3, 1e-3, 2e-3, 3e-3, 4e-3, 6e-3}) {
    const StatePlane found = section.plane(depth), wanted = endless.plane(depth);
    EXPECT_NEAR(found.e_xx[middle], wanted.e_xx[middle], 1e-5) << depth << ": of 7e-4, with what its sides change";
    EXPECT_NEAR(found.s_zz[middle], wanted.s_zz[middle], 5e6) << depth << ": of 1000 MPa";
    EXPECT_NEAR(found.s_xz[middle], wanted.s_xz[middle], 2e6) << depth << ": of 300 MPa";
  }
  EXPECT_EQ(section.layers_of_rows(1e-3, false)[14], 1);
  EXPECT_EQ(section.layers_of_rows(4e-3, false)[14], 0);
  EXPECT_NEAR(section.material_at(8.5e-3, 1e-3, false).young, clad.young, 1e-3 * clad.young);
  EXPECT_NEAR(section.material_at(9.5e-3, 1e-3, false).young, steel.young, 1e-3 * steel.young);
  EXPECT_NEAR(section.material_at(0, layer.thickness, false).young, clad.young, 1e-3 * clad.young);
  EXPECT_NEAR(section.material_at(0, layer.thickness, true).young, steel.young, 1e-3 * steel.young);
}

INSTANTIATE_TEST_SUITE_P(Bodies, SectionBelowTest, testing::Values(BodyId::rail, BodyId::wheel));

}  // namespace
}  // namespace railstrata
