// Contact on, and stresses below, a layer whose interface gives.
#include <gtest/gtest.h>

#include <limits>

#include "bem/case_patch.hpp"
#include "bem/subsurface.hpp"
#include "half_space_pair.hpp"
#include "halfspace/circular_pressure.hpp"
#include "halfspace/layered.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {
namespace {

constexpr double kThick = 3e-3, kCurvature = 1.2, kLoad = 85e3;
constexpr Bond kSmooth{0, std::numeric_limits<double>::infinity()}, kSprings{1 / 2e13, 1 / 5e12};

LayeredHalfSpace clad(const Bond& bond) {
  return {{{.thickness = kThick, .material = {420e9, 0.3}, .bond = bond}}, kSteel};
}

double largest_pressure(const Bond& bond, int cells) {
  const HertzContact h = hertz_contact(kCurvature, kCurvature, contact_modulus(kSteel, kSteel), kLoad);
  const PatchGrid g = grid_around(1.05 * h.a, 1.05 * h.a, h.a / cells, h.a / cells);
  const InfluenceOperator op(combined_compliance(homogeneous_compliance(kSteel), layered_compliance(clad(bond))), g.nx,
                             g.ny, g.dx, g.dy);
  return peak(solve_normal(op, g, quadratic_gap(g, kCurvature, kCurvature), {.load = kLoad, .approach = {}}).pressure);
}

TEST(BondContact, PressureLiesBetweenBondedAndSmooth) {
  const double bonded = largest_pressure({}, 12), smooth = largest_pressure(kSmooth, 12);
  EXPECT_LT(smooth, 0.99 * bonded);
  EXPECT_NEAR(largest_pressure({1e-22, 1e-22}, 12) / bonded, 1, 1e-6);
  double last = bonded;
  for (const double stiffness : {3e14, 3e13, 3e12}) {
    const double here = largest_pressure({0, 1 / stiffness}, 12);
    EXPECT_LT(here, last);
    EXPECT_GT(here, smooth);
    last = here;
  }
}

TEST(BondContact, PressureOnSpringsConvergesInCells) {
  const double finest = largest_pressure(kSprings, 40);
  EXPECT_NEAR(largest_pressure(kSprings, 10) / finest, 1, 0.02);
  EXPECT_NEAR(largest_pressure(kSprings, 20) / finest, 1, 0.005);
}

TEST(BondContact, ComesFromTheKeysOfALayerWithTheLastCutOfAGradedOne) {
  CaseSpec spec;
  spec.layers.resize(2);
  spec.layers[0].interface_normal_stiffness = 2e13;
  spec.layers[0].interface_shear_stiffness = 0;
  spec.layers[1].young_table = {{0, 420e9}, {2e-3, 210e9}};
  spec.layers[1].interface_shear_stiffness = 5e12;
  const std::vector<HalfSpaceLayer> layers = layered_body(spec, BodyId::rail).layers;
  ASSERT_GT(layers.size(), 3u);
  EXPECT_EQ(layers[0].bond, (Bond{1 / 2e13, kSmooth.shear}));
  EXPECT_FALSE(layers[1].bond.gives());
  EXPECT_EQ(layers.back().bond, (Bond{0, 1 / 5e12}));
}

/// A disc of uniform pressure in square cells, as below_circles has it round.
struct Disc {
  static constexpr double kRadius = 4e-3, kPressure = 1e9;
  PatchGrid grid = centred_grid(40, 40, 0.125e-3, 0.125e-3);
  Plane p = Plane(grid.size()), none = Plane(grid.size());
  Disc() {
    for (std::size_t k = 0; k < grid.size(); ++k) {
      constexpr int kParts = 16;
      for (int i = 0; i < kParts * kParts; ++i) {
        const double x = grid.x_of(k) + ((i % kParts + 0.5) / kParts - 0.5) * grid.dx,
                     y = grid.y_of(k) + ((i / kParts + 0.5) / kParts - 0.5) * grid.dy;
        if (x * x + y * y < kRadius * kRadius) p[k] += kPressure / (kParts * kParts);
      }
    }
  }
};

// An independent integral: Hankel's, without a grid, without periods.
TEST(BondStresses, UnderADiscMeetTheIntegralOverWaveNumbers) {
  const Disc disc;
  const std::vector<PressedCircle> circle{{0, 0, Disc::kRadius, Disc::kPressure}};
  for (const Bond& bond : {Bond{}, kSmooth, kSprings, Bond{1 / 1e12, 1 / 1e12}}) {
    const LayeredHalfSpace body = clad(bond);
    const Subsurface inside(body, disc.grid, disc.p, disc.none, disc.none);
    for (const double depth : {1e-3, kThick, 4.5e-3}) {
      const StatePlane plane = inside.plane(depth);
      for (const int cell : {0, 16, 32}) {
        const std::size_t k = disc.grid.index(40 + cell, 40);
        const Sym3 s = inside.stress(plane, k),
                   exact = below_circles(body, circle, {disc.grid.x_of(k), 0, depth}).stress;
        for (const double Sym3::*part : {&Sym3::xx, &Sym3::yy, &Sym3::zz, &Sym3::xz})
          EXPECT_NEAR(s.*part, exact.*part, 3e-3 * Disc::kPressure)
              << bond.normal << ' ' << bond.shear << " depth " << depth << " cell " << cell;
      }
    }
  }
}

TEST(BondStresses, BothSidesOfAnInterfaceHaveTheirOwnStrains) {
  const Disc disc;
  const LayeredHalfSpace body = clad(kSmooth);
  const Subsurface inside(body, disc.grid, disc.p, disc.none, disc.none);
  const StatePlane at = inside.plane(kThick), below = inside.plane(kThick * (1 + 1e-9));
  ASSERT_TRUE(at.lower);
  EXPECT_FALSE(inside.plane(0.5 * kThick).lower);
  for (const int cell : {0, 16, 32}) {
    const std::size_t k = disc.grid.index(40 + cell, 40);
    const Sym3 upper = inside.stress(at, k), lower = inside.stress(at, k, true), next = inside.stress(below, k);
    EXPECT_NEAR(lower.xx, next.xx, 1e-5 * Disc::kPressure);
    EXPECT_NEAR(lower.zz, upper.zz, 1e-9 * Disc::kPressure);
    EXPECT_NEAR(upper.xz, 0, 5e-5 * Disc::kPressure) << "smooth, but for the interpolation between wave numbers";
    EXPECT_NEAR(lower.xz, upper.xz, 1e-9 * Disc::kPressure);
    EXPECT_GT(std::abs(upper.xx - 2 * lower.xx), 0.05 * Disc::kPressure) << "the strains jump";
  }
}

}  // namespace
}  // namespace railstrata
