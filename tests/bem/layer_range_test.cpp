// The ends of the range of a layer's thickness, modulus and Poisson's ratio, where closed forms hold: a sphere on a
// rail with a layer much thinner or much thicker than the patch is Hertz's contact with the substrate or the layer.
#include <gtest/gtest.h>

#include <cmath>

#include "half_space_pair.hpp"
#include "halfspace/layered.hpp"

namespace railstrata {
namespace {

constexpr double kThinnest = 10e-6, kThickest = 50e-3, kCurvature = 1.2, kLoad = 85e3;

/// Largest pressure over Hertz's for a rail that is all of `material`.
double pressure_over_hertz(const LayeredHalfSpace& rail, const HalfSpaceMaterial& material) {
  const HertzContact h = hertz_contact(kCurvature, kCurvature, contact_modulus(kSteel, material), kLoad);
  const PatchGrid g = centred_grid(26, 26, h.a / 20, h.a / 20);
  const InfluenceOperator op(combined_compliance(homogeneous_compliance(kSteel), layered_compliance(rail)), g.nx, g.ny,
                             g.dx, g.dy);
  return peak(solve_normal(op, g, quadratic_gap(g, kCurvature, kCurvature), {.load = kLoad, .approach = {}}).pressure) /
         h.p0;
}

double of_layer(double thickness, const HalfSpaceMaterial& layer, const HalfSpaceMaterial& reference) {
  return pressure_over_hertz({{{thickness, layer}}, kSteel}, reference);
}

constexpr double kGrid = 2e-3;  // of p0, at 20 cells a semi-axis: the rail without a layer has it too

// What a layer of 10 um changes is of first order in its thickness over the patch's, h/a = 0.002 here, times the ratio
// of moduli: within 1 % at 2 and 1/2, and half as much as 20 um change.
TEST(LayerRange, ALayerOfTenMicrometresTendsToTheRailWithoutOne) {
  const double bare = pressure_over_hertz({{}, kSteel}, kSteel);
  EXPECT_NEAR(bare, 1, kGrid);
  for (const double ratio : {0.5, 2.0}) {
    const HalfSpaceMaterial layer{ratio * kSteel.young, 0.3};
    const double thin = of_layer(kThinnest, layer, kSteel) - bare,
                 twice = of_layer(2 * kThinnest, layer, kSteel) - bare;
    EXPECT_LT(std::abs(thin), 0.01) << ratio;
    EXPECT_NEAR(twice / thin, 2, 0.1) << ratio;
  }
}

// A layer of 50 mm, ten times the semi-axis: what lies below it bends the surface under the patch by the third power of
// a/h.
TEST(LayerRange, ALayerOfFiftyMillimetresIsTheBodyForEveryRatioAndPoissonsRatio) {
  for (const double ratio : {0.25, 1.0, 4.0, 100.0})
    for (const double nu : {0.0, 0.3, 0.495, 0.499}) {
      const HalfSpaceMaterial layer{ratio * kSteel.young, nu};
      EXPECT_NEAR(of_layer(kThickest, layer, layer), 1, 0.005) << ratio << ' ' << nu;
    }
}

// Nothing singular happens between 0.495 and 0.499: the difference of the answers is that of 1 - nu^2 and a little.
TEST(LayerRange, PoissonsRatioOf0499IsNearThatOf0495AtEveryThickness) {
  for (const double thickness : {kThinnest, 0.2e-3, 2e-3, kThickest})
    for (const double ratio : {0.01, 0.5, 2.0, 100.0}) {
      const double a = of_layer(thickness, {ratio * kSteel.young, 0.499}, kSteel),
                   b = of_layer(thickness, {ratio * kSteel.young, 0.495}, kSteel);
      EXPECT_NEAR(a / b, 1, 0.03) << thickness << ' ' << ratio;
    }
}

}  // namespace
}  // namespace railstrata
