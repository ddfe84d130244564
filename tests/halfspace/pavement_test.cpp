// Stresses and displacements inside layered half-spaces under circular loads, against two programs for pavements:
// ELLEA1 (two circles) and KENPAVE (one), as published with the open-source programs ALVA and PyMastic.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/vec.hpp"
#include "halfspace/interior.hpp"
#include "halfspace/layer_waves.hpp"

namespace railstrata {
namespace {

/// Unit pressure on a circle of radius a, integrated over wave numbers (Hankel); what the waves of a wave number make
/// at the distance r and a depth.
struct Circle {
  double a, r;
  double radial = 0, hoop = 0, axial = 0, sinks = 0;

  Circle(const LayeredHalfSpace& body, double radius, double distance, double depth) : a(radius), r(distance) {
    constexpr int kSteps = 40'000;
    const double step = 40 / depth / kSteps;
    InteriorState state;
    for (int i = 0; i < kSteps; ++i) add((i + 0.5) * step, step, body, depth, state);
    const std::size_t layer = LayerWaves(body, 1).layer_at(depth);
    const Sym3 s = stress_of(state, layer < body.layers.size() ? body.layers[layer].material : body.substrate);
    radial = s.xx;
    hoop = s.yy;
    axial = state.s_zz;
  }

 private:
  void add(double k, double step, const LayeredHalfSpace& body, double depth, InteriorState& sum) {
    const LayerWaves waves(body, k);
    const WaveState top = waves.state(0);
    const Eigen::Vector2d amplitude = top.bottomRows<2>().fullPivLu().solve(Eigen::Vector2d(0, -1 / k));
    const Eigen::Vector4d at = waves.state(depth) * amplitude;  // U, W, T/k, S/k of unit pressure
    const double weight = a * ::j1(k * a) * step, J0 = ::j0(k * r), over_r = r > 0 ? ::j1(k * r) / r : 0.5 * k;
    sum.e_xx -= weight * at[0] * (k * J0 - over_r);
    sum.e_yy -= weight * at[0] * over_r;
    sum.s_zz += weight * at[3] * k * J0;
    sinks += weight * at[1] * J0;
  }
};

TEST(Pavement, TwoCirclesOnThreeLayersMeetEllea) {
  const LayeredHalfSpace body{{{0.150, {3000e6, 0.30}}, {0.600, {200e6, 0.35}}}, {40e6, 0.40}};
  struct Row {
    double depth, s_x, s_y, s_z, u_z;  // mm; MPa, compression positive; mm
  };
  // Its own integration: ours does not change by 1e-5 with eight times the wave numbers.
  for (const Row& row : std::vector<Row>{{50, 1.1197, 1.1293, 0.8758, 1.9202},
                                         {100, -0.5021, -0.1813, 0.5674, 1.9121},
                                         {150, -2.2806, -1.4829, 0.3726, 1.8936},
                                         {200, 0.0101, 0.0456, 0.3148, 1.8148},
                                         {500, -0.0450, -0.0394, 0.1055, 1.5112},
                                         {750, -0.1144, -0.1102, 0.0419, 1.3645},
                                         {1000, -0.0009, -0.0006, 0.0284, 1.1442}}) {
    const Circle one(body, 0.150, 0.150, 1e-3 * row.depth);  // in the middle of two, along y
    const double both = 2 * 1.1;
    EXPECT_NEAR(-both * one.hoop, row.s_x, 3e-4 * std::max(1.0, std::abs(row.s_x))) << row.depth;
    EXPECT_NEAR(-both * one.radial, row.s_y, 3e-4) << row.depth;
    EXPECT_NEAR(-both * one.axial, row.s_z, 3e-4) << row.depth;
    EXPECT_NEAR(both * 1e6 * one.sinks * 1e3, row.u_z, 3e-4) << row.depth;
  }
}

// In inches and psi.
TEST(Pavement, CircleOnThreeLayersMeetsKenpave) {
  const LayeredHalfSpace body{{{6, {500e3, 0.35}}, {10, {40e3, 0.40}}}, {10e3, 0.45}};
  struct Row {
    double depth, s_z, s_r;  // compression positive
  };
  for (const Row& row : std::vector<Row>{{3, 67.411, 25.997},
                                         {6, 24.051, -166.448},
                                         {7, 20.789, -0.699},
                                         {16, 5.722, -11.87},
                                         {17, 5.354, 0.372},
                                         {29, 2.844, 0.156}}) {
    const Circle circle(body, 5.99, 0, row.depth);
    EXPECT_NEAR(-100 * circle.axial, row.s_z, 0.03) << row.depth;
    EXPECT_NEAR(-100 * circle.radial, row.s_r, 0.1) << row.depth;
    EXPECT_NEAR(circle.hoop, circle.radial, 1e-12) << row.depth;
  }
}

}  // namespace
}  // namespace railstrata
