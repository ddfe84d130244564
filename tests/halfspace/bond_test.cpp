// Interfaces that give: springs between the layers, their limits (bonded, smooth, two bodies), a plate on springs.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "halfspace/circular_pressure.hpp"
#include "halfspace/layer_waves.hpp"
#include "halfspace/layered.hpp"

namespace railstrata {
namespace {

const HalfSpaceMaterial kSteel{210e9, 0.3}, kClad{280e9, 0.25};
constexpr double kH = 3e-3, kInfinite = std::numeric_limits<double>::infinity();
constexpr Bond kSmooth{0, kInfinite}, kLoose{kInfinite, kInfinite}, kSprings{1 / 2e12, 1 / 5e11};

LayeredHalfSpace clad(const Bond& bond, const HalfSpaceMaterial& layer = kClad,
                      const HalfSpaceMaterial& base = kSteel) {
  return {{{.thickness = kH, .material = layer, .bond = bond}}, base};
}

void expect_close(const CompliancePoint& a, const CompliancePoint& b, double relative) {
  EXPECT_NEAR(a.zz, b.zz, relative * b.zz);
  EXPECT_NEAR(a.rz, b.rz, relative * b.zz);
  EXPECT_NEAR(a.rr, b.rr, relative * b.rr);
  EXPECT_NEAR(a.tt, b.tt, relative * b.tt);
}

TEST(Bond, StiffSpringsAreBonded) {
  for (const double kh : {0.03, 0.5, 4.0})
    expect_close(layered_compliance_at(clad({1e-20, 1e-20}), kh / kH), layered_compliance_at(clad({}), kh / kH), 1e-6);
}

// Loads on one face are the sum of those even and odd about the plate's middle, alpha = k h/2.
TEST(Bond, ZeroSpringsLeaveAFreePlateInClosedFormAndTheBaseUnloaded) {
  for (const Bond& bond : {Bond{1e6, 1e6}, kLoose})
    for (const double kh : {0.2, 1.0, 5.0}) {
      const double k = kh / kH, G = kClad.shear(), c = (1 - kClad.poisson) / (2 * G);
      const double sh = std::sinh(kh / 2), ch = std::cosh(kh / 2), even = std::sinh(kh) + kh, odd = std::sinh(kh) - kh;
      const CompliancePoint plate = layered_compliance_at(clad(bond), k);
      EXPECT_NEAR(plate.zz / (c * (2 * sh * sh / even + 2 * ch * ch / odd)), 1, 1e-6) << kh;
      EXPECT_NEAR(plate.rr / (c * (2 * ch * ch / even + 2 * sh * sh / odd)), 1, 1e-6) << kh;
      EXPECT_NEAR(plate.tt * G * std::tanh(kh), 1, 1e-6) << kh;
      const LayerWaves waves(clad(bond), k);
      const WaveState below = waves.state(1, kH) * waves.state(0, 0).bottomRows<2>().inverse();
      EXPECT_LT(below.topRows<2>().cwiseAbs().maxCoeff(), 1e-6 * plate.zz);
      EXPECT_LT(below.bottomRows<2>().cwiseAbs().maxCoeff(), 1e-6);
      EXPECT_LT(std::abs(waves.shear_state(1, kH)[1] / waves.shear_state(0, 0)[1]), 1e-6);
    }
}

TEST(Bond, TractionsMeetAndDisplacementsJumpByTractionOverStiffness) {
  const double k = 900;
  const LayeredHalfSpace body{{{.thickness = 1e-3, .material = {420e9, 0.2}, .bond = kSmooth},
                               {.thickness = 2e-3, .material = kClad, .bond = kSprings}},
                              kSteel};
  const LayerWaves waves(body, k);
  double depth = 0;
  for (std::size_t l = 0; l < 2; ++l) {
    depth += body.layers[l].thickness;
    const WaveState above = waves.state(l, depth), below = waves.state(l + 1, depth);
    const ShearState across = waves.shear_state(l, depth), across_below = waves.shear_state(l + 1, depth);
    const double stress = waves.state(0, 0).bottomRows<2>().cwiseAbs().maxCoeff();
    EXPECT_LT((above - below).bottomRows<2>().cwiseAbs().maxCoeff(), 1e-12 * stress);
    EXPECT_NEAR(across[1], across_below[1], 1e-12 * std::abs(waves.shear_state(0, 0)[1]));
    const Bond& bond = body.layers[l].bond;
    const WaveState jump = below - above;
    EXPECT_LT((jump.row(1) - bond.normal * k * above.row(3)).cwiseAbs().maxCoeff(), 1e-12);
    if (l == 0) {
      EXPECT_LT(above.row(2).cwiseAbs().maxCoeff(), 1e-12 * stress) << "smooth";
      EXPECT_LT(std::abs(across[1]), 1e-12 * std::abs(waves.shear_state(0, 0)[1])) << "smooth";
      EXPECT_GT(jump.row(0).cwiseAbs().maxCoeff(), 1e-3) << "and slips";
    } else {
      EXPECT_LT((jump.row(0) - bond.shear * k * above.row(2)).cwiseAbs().maxCoeff(), 1e-12);
      EXPECT_NEAR(across_below[0] - across[0], bond.shear * k * across[1], 1e-12);
    }
  }
}

// W = p/(D k^4 + k_n), to (k h)^2; the base is rigid and smooth, the springs much softer than the plate's thickness.
TEST(Bond, AThinPlateOnSpringsBendsAsKirchhoffsOnWinklersBed) {
  const double stiffness = 1e8, D = kClad.young * kH * kH * kH / (12 * (1 - kClad.poisson * kClad.poisson));
  for (const double kh : {0.01, 0.03, 0.1}) {
    const double k = kh / kH;
    const CompliancePoint c = layered_compliance_at(clad({1 / stiffness, kInfinite}, kClad, {1e22, 0.3}), k);
    EXPECT_NEAR(c.zz / k * (D * std::pow(k, 4) + stiffness), 1, 0.7 * kh * kh) << kh;
  }
}

TEST(Bond, BettiReciprocityHolds) {
  const LayeredHalfSpace body{{{.thickness = 1e-3, .material = {50e9, 0.1}, .bond = kSprings},
                               {.thickness = 0.3e-3, .material = {900e9, 0.2}, .bond = kSmooth},
                               {.thickness = 4e-3, .material = {100e9, 0.4}}},
                              kSteel};
  for (const double k : {10.0, 300.0, 3000.0}) {
    const WaveState s = LayerWaves(body, k).state(0, 0);
    const Eigen::Matrix2d c = -s.topRows<2>() * s.bottomRows<2>().inverse();
    EXPECT_NEAR(c(0, 1), c(1, 0), 1e-10 * std::abs(c(1, 1))) << k;
  }
}

TEST(Bond, AnInterfaceBetweenEqualMaterialsCountsIfItGives) {
  const LayeredHalfSpace body = clad(kSmooth, kSteel);
  EXPECT_GT(layered_compliance(body).size(), 1u);
  EXPECT_EQ(layered_compliance(clad({}, kSteel)).size(), 1u);
  const LayeredHalfSpace cut{
      {{.thickness = 1e-3, .material = kSteel}, {.thickness = 2e-3, .material = kSteel, .bond = kSmooth}}, kSteel};
  EXPECT_EQ(layered_compliance(cut).size(), layered_compliance(body).size());
}

/// Largest deviation of the images' sum relative to the compliances themselves, from a wave number on.
double deviation_of_images(const LayeredHalfSpace& body, double from) {
  const SurfaceCompliance images = layered_compliance(body);
  double worst = 0;
  for (double k = from; k < 50 / body.layers[0].thickness; k *= 1.31) {
    CompliancePoint sum;
    for (const ComplianceImage& i : images) {
      const double e = std::exp(-k * i.depth);
      sum = {sum.zz + e * i.c.zz, sum.rz + e * i.c.rz, sum.rr + e * i.c.rr, sum.tt + e * i.c.tt};
    }
    const CompliancePoint c = layered_compliance_at(body, k);
    worst = std::max({worst, std::abs(sum.zz / c.zz - 1), std::abs(sum.rr / c.rr - 1), std::abs(sum.tt / c.tt - 1),
                      std::abs(sum.rz - c.rz) / std::sqrt(c.rr * c.zz)});
  }
  return worst;
}

// A smooth layer is held over 1 m: it differs by some (k 1 m)^-2.
TEST(Bond, ImagesMeetTheRecursionForStiffAndSoftSprings) {
  constexpr double kLongest = 0.01, kHeld = 300;  // 1/m
  for (const double h : {20e-6, 3e-3, 50e-3})
    for (const double ratio : {0.01, 100.0}) {
      LayeredHalfSpace body = clad({}, {ratio * 210e9, 0.3});
      body.layers[0].thickness = h;
      const auto deviation = [&](const Bond& bond, double from) {
        body.layers[0].bond = bond;
        return deviation_of_images(body, from);
      };
      const double soft = h / (0.1 * body.layers[0].material.young);
      for (const Bond& bond : {Bond{soft, 0}, Bond{soft, 1e-10}, Bond{0, 1e-10}})
        EXPECT_LT(deviation(bond, kLongest), 1.1e-6) << h << ' ' << ratio << ' ' << bond.normal << ' ' << bond.shear;
      EXPECT_LT(deviation(kSmooth, kHeld), 10 / (kHeld * kHeld)) << h << ' ' << ratio << ": smooth";
      EXPECT_LT(deviation({1e-10, 1e-10}, kLongest), 1.1e-4) << h << ' ' << ratio << ": softest";
    }
}

// A three-layer road under a circle: loosening the interface below the asphalt raises its strain at the bottom, takes
// the shear away, and leaves the pressure below nearly as large.
TEST(CircularPressureOnSlippingLayers, LieBetweenBondedAndSmooth) {
  LayeredHalfSpace road{{{7.5e-3, {3000e9, 0.3}}, {30e-3, {200e9, 0.35}}}, {40e9, 0.4}};
  const std::vector<PressedCircle> circle{{0, 0, 7.5e-3, 1e6}};
  const auto below = [&](const Bond& bond, double x) {
    road.layers[0].bond = bond;
    return below_circles(road, circle, {x, 0, 7.5e-3}).stress;
  };
  const Sym3 bonded = below({}, 0), springs = below({0, 1 / 2e13}, 0), smooth = below(kSmooth, 0);
  EXPECT_LT(bonded.xx, springs.xx);
  EXPECT_LT(springs.xx, smooth.xx);
  EXPECT_NEAR(below({0, 1e-22}, 0).xx / bonded.xx, 1, 1e-6);
  EXPECT_NEAR(below({0, 1e-5}, 0).xx / smooth.xx, 1, 1e-4);
  EXPECT_GT(std::abs(below({}, 5e-3).xz), 0.01e6);
  EXPECT_LT(std::abs(below(kSmooth, 5e-3).xz), 1e-6 * 1e6);
}

}  // namespace
}  // namespace railstrata
