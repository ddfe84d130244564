#include "halfspace/layered.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "core/faults.hpp"
#include "halfspace/layer_waves.hpp"

namespace railstrata {
namespace {

const HalfSpaceMaterial kSteel{210e9, 0.3};

void expect_close(const CompliancePoint& a, const CompliancePoint& b, double relative) {
  EXPECT_NEAR(a.zz, b.zz, relative * b.zz);
  EXPECT_NEAR(a.rz, b.rz, relative * b.zz);
  EXPECT_NEAR(a.rr, b.rr, relative * b.zz);
  EXPECT_NEAR(a.tt, b.tt, relative * b.zz);
}

TEST(Layered, EqualMaterialsGiveTheHomogeneousClosedForm) {
  const CompliancePoint exact = homogeneous_compliance(kSteel)[0].c;
  for (double k : {1e-3, 1.0, 1e3, 1e7})
    expect_close(layered_compliance_at({{{1e-3, kSteel}, {5e-3, kSteel}}, kSteel}, k), exact, 1e-13);
}

TEST(Layered, ThinLimitIsTheSubstrateAndThickLimitTheLayer) {
  const HalfSpaceMaterial layer{4 * 210e9, 0.25};
  const LayeredHalfSpace body{{{1e-3, layer}}, kSteel};
  expect_close(layered_compliance_at(body, 1e-6), homogeneous_compliance(kSteel)[0].c, 1e-8);
  expect_close(layered_compliance_at(body, 1e5), homogeneous_compliance(layer)[0].c, 1e-12);
}

TEST(Layered, EightEqualSubLayersAreOneLayer) {
  const HalfSpaceMaterial coat{2.1e9, 0.45};
  LayeredHalfSpace one{{{2e-3, coat}}, kSteel}, eight{{}, kSteel};
  for (int i = 0; i < 8; ++i) eight.layers.push_back({0.25e-3, coat});
  for (double k = 1; k < 1e6; k *= 3)
    expect_close(layered_compliance_at(eight, k), layered_compliance_at(one, k), 1e-11);
}

// Incompressible layer on a rigid base: zz k = (sinh 2kh - 2kh)/(2G (cosh 2kh + 1 + 2 (kh)²)), the limit of
// [Johnson1985 sec. 5.8].
TEST(Layered, IncompressibleLayerOnANearlyRigidBaseMeetsItsClosedForm) {
  const HalfSpaceMaterial rubber{3e6, 0.5}, rigid{3e18, 0.3};
  const double h = 5e-3, G = rubber.shear();
  for (double kh : {0.3, 1.0, 2.5}) {
    const double exact = (std::sinh(2 * kh) - 2 * kh) / (std::cosh(2 * kh) + 1 + 2 * kh * kh) / (2 * G);
    EXPECT_NEAR(layered_compliance_at({{{h, rubber}}, rigid}, kh / h).zz / exact, 1, 1e-8) << kh;
  }
}

TEST(Layered, BettiReciprocityOfNormalAndTangentialCompliance) {
  const LayeredHalfSpace body{{{1e-3, {50e9, 0.1}}, {0.3e-3, {900e9, 0.2}}, {4e-3, {100e9, 0.49}}}, kSteel};
  for (double k : {10.0, 300.0, 3000.0}) {
    const WaveState s = LayerWaves(body, k).state(0, 0);
    const Eigen::Matrix2d u = s.topRows<2>(), t = s.bottomRows<2>();
    const Eigen::Matrix2d c =
        u * Eigen::Matrix2d{{t(1, 1), -t(0, 1)}, {-t(1, 0), t(0, 0)}} / (t(0, 0) * t(1, 1) - t(0, 1) * t(1, 0));
    EXPECT_NEAR(c(0, 1), c(1, 0), 1e-12 * std::abs(c(1, 1))) << k;
  }
}

TEST(Layered, StateIsContinuousAcrossInterfacesAndObeysEquilibriumByFiniteDifferences) {
  const LayeredHalfSpace body{{{1e-3, {50e9, 0.1}}, {0.3e-3, {900e9, 0.2}}, {4e-3, {100e9, 0.49}}}, kSteel};
  const double k = 700;
  const LayerWaves waves(body, k);
  double depth = 0;
  for (std::size_t l = 0; l < body.layers.size(); ++l) {
    depth += body.layers[l].thickness;
    const WaveState above = waves.state(l, depth), below = waves.state(l + 1, depth);
    const double scale = above.cwiseAbs().maxCoeff();
    EXPECT_LT((above.topRows<2>() - below.topRows<2>()).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((above - below).cwiseAbs().maxCoeff(), 1e-12 * scale);
    EXPECT_LT((waves.shear_state(l, depth) - waves.shear_state(l + 1, depth)).cwiseAbs().maxCoeff(), 1e-12 * scale);
    // dS/dz = k T: force balance across the layer's depth
    const double z = depth - 0.4 * body.layers[l].thickness, e = 1e-7;
    const WaveState slope = (waves.state(l, z + e) - waves.state(l, z - e)) / (2 * e);
    EXPECT_LT((slope.row(3) - k * waves.state(l, z).row(2)).cwiseAbs().maxCoeff(), 1e-6 * k * scale);
  }
}

void expect_images_meet_recursion(const LayeredHalfSpace& body, double h) {
  const SurfaceCompliance images = layered_compliance(body);
  for (double kh = 3e-5; kh < 50; kh *= 1.31) {
    CompliancePoint sum;
    for (const ComplianceImage& i : images) {
      const double e = std::exp(-kh / h * i.depth);
      sum = {sum.zz + e * i.c.zz, sum.rz + e * i.c.rz, sum.rr + e * i.c.rr, sum.tt + e * i.c.tt};
    }
    const CompliancePoint exact = layered_compliance_at(body, kh / h);
    EXPECT_NEAR(sum.zz, exact.zz, 1.1e-6 * exact.zz) << kh;
    EXPECT_NEAR(sum.rr, exact.rr, 1.1e-6 * exact.rr) << kh;
    EXPECT_NEAR(sum.tt, exact.tt, 1.1e-6 * exact.tt) << kh;
    EXPECT_NEAR(sum.rz, exact.rz, 1.1e-6 * std::sqrt(exact.rr * exact.zz)) << kh;
  }
}

TEST(Layered, ImagesMeetTheRecursionFor1MicrometreTo50MillimetresAndRatios001To100) {
  for (double h : {1e-6, 1e-3, 50e-3})
    for (double ratio : {0.01, 0.5, 4.0, 100.0}) expect_images_meet_recursion({{{h, {ratio * 210e9, 0.3}}}, kSteel}, h);
}

TEST(Layered, ImagesMeetTheRecursionForIncompressibleLayers) {
  for (double ratio : {0.01, 0.1, 10.0})
    for (double nu : {0.45, 0.5}) expect_images_meet_recursion({{{1e-3, {ratio * 210e9, nu}}}, kSteel}, 1e-3);
}

TEST(Layered, ImagesMeetAThreeLayerStackAndAGradedOne) {
  const LayeredHalfSpace stack{{{0.05e-3, {630e9, 0.25}}, {1e-3, {100e9, 0.4}}, {6e-3, {420e9, 0.3}}}, kSteel};
  EXPECT_NO_THROW(layered_compliance(stack));
  const LayeredHalfSpace graded{cut_into_layers({{0, {840e9, 0.3}}, {3e-3, {210e9, 0.3}}}, 0.05), kSteel};
  EXPECT_GT(graded.layers.size(), 20u);
  EXPECT_NO_THROW(layered_compliance(graded));
}

const std::vector<GradedPoint> kGraded{{0, {840e9, 0.3}}, {1e-3, {840e9, 0.3}}, {3e-3, {210e9, 0.3}}};

TEST(GradedLayer, EveryCutStaysWithinTheToleranceAndFollowsTheTable) {
  for (double tolerance : {0.3, 0.05}) {
    const LayeredHalfSpace body{cut_into_layers(kGraded, tolerance), kSteel};
    double top = 0;
    for (const HalfSpaceLayer& cut : body.layers) {
      const double upper = cut.local(0).young, lower = cut.local(cut.thickness).young;
      EXPECT_LE(upper / lower, 1 + tolerance + 1e-9) << top;
      EXPECT_NEAR(upper / (top < 1e-3 - 1e-9 ? 840e9 : 840e9 - 630e9 * (top - 1e-3) / 2e-3), 1, 1e-9) << top;
      EXPECT_NEAR(cut.material.young / (0.5 * (upper + lower)), 1, 1e-12);
      top += cut.thickness;
    }
    EXPECT_NEAR(top, 3e-3, 1e-15);
    ASSERT_EQ(layer_extents(body).size(), 1u) << "cuts are no layers";
    EXPECT_NEAR(layer_extents(body)[0].bottom, 3e-3, 1e-15);
  }
  EXPECT_THROW(cut_into_layers({{0, kSteel}}), CaseError);
  EXPECT_THROW(cut_into_layers({{1e-3, kSteel}, {2e-3, kSteel}}), CaseError);
  EXPECT_THROW(cut_into_layers({{0, kSteel}, {0, kSteel}}), CaseError);
}

// For waves long against a cut: the thickest of `coarse` is 0.17 mm.
TEST(GradedLayer, ComplianceErrsWithTheSquareOfTheTolerance) {
  const LayeredHalfSpace exact{cut_into_layers(kGraded, 0.001), kSteel}, coarse{cut_into_layers(kGraded, 0.1), kSteel},
      fine{cut_into_layers(kGraded, 0.05), kSteel};
  for (double k : {100.0, 500.0, 2000.0}) {
    const double zz = layered_compliance_at(exact, k).zz, error = layered_compliance_at(coarse, k).zz - zz,
                 finer = layered_compliance_at(fine, k).zz - zz;
    EXPECT_LT(std::abs(error / zz), 2e-3) << k;
    EXPECT_NEAR(error / finer, 4, 0.6) << k;
  }
}

TEST(GradedLayer, OfOneModulusIsAUniformLayer) {
  const HalfSpaceMaterial hard{400e9, 0.25};
  const LayeredHalfSpace graded{cut_into_layers({{0, hard}, {0.7e-3, hard}, {2e-3, hard}}), kSteel},
      uniform{{{2e-3, hard}}, kSteel};
  for (double k : {30.0, 1000.0, 9000.0})
    expect_close(layered_compliance_at(graded, k), layered_compliance_at(uniform, k), 1e-12);
}

/// E(z) = E0 exp(-a z) down to `depth`, then steel, at one wave number: the elasticity equations of layer_waves.hpp's
/// state integrated upwards by Runge and Kutta's rule from the homogeneous body below,
///   U' = T/G - k W,  W' = (S + lambda k U)/(lambda + 2 G),  T' = k ((lambda + 2 G) k U - lambda W'),  S' = k T.
CompliancePoint exponentially_graded_compliance(double young, double a, double depth, double poisson, double k) {
  using State = Eigen::Matrix<double, 4, 2>;
  const auto slope = [&](const State& y, double z) {
    const double E = young * std::exp(-a * z), G = E / (2 * (1 + poisson)),
                 lambda = 2 * G * poisson / (1 - 2 * poisson);
    State d;
    d.row(0) = k * (y.row(2) / G - y.row(1));
    d.row(1) = k * (y.row(3) + lambda * y.row(0)) / (lambda + 2 * G);
    d.row(2) = k * (lambda + 2 * G) * y.row(0) - lambda * d.row(1);
    d.row(3) = k * y.row(2);
    return d;
  };
  const CompliancePoint base = homogeneous_compliance(kSteel)[0].c;
  State y;
  y.topRows<2>() = -Eigen::Matrix2d{{base.rr, base.rz}, {base.rz, base.zz}};  // of unit tractions T/k, S/k
  y.bottomRows<2>().setIdentity();
  constexpr int kSteps = 4000;
  const double h = -depth / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const double z = depth + i * h;
    const State k1 = slope(y, z), k2 = slope(y + 0.5 * h * k1, z + 0.5 * h), k3 = slope(y + 0.5 * h * k2, z + 0.5 * h),
                k4 = slope(y + h * k3, z + h);
    y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  const Eigen::Matrix2d c = -y.topRows<2>() * y.bottomRows<2>().inverse();
  // Across the wave vector (G V')' = k^2 G V has the solutions exp(r z), r = (a -+ sqrt(a^2 + 4 k^2))/2; below V' = -k
  // V.
  const double root = std::sqrt(a * a + 4 * k * k), up = 0.5 * (a + root), down = 0.5 * (a - root),
               G = young / (2 * (1 + poisson)), g = kSteel.shear() / (G * std::exp(-a * depth));
  const double b = -std::exp((down - up) * depth) * (down + g * k) / (up + g * k);
  return {c(1, 1), c(0, 1), c(0, 0), -k * (1 + b) / (G * (down + up * b))};
}

// Cuts at equal steps of ln E: the table and its cuts err with the square of the step.
TEST(GradedLayer, MeetsTheEquationsOfAnExponentiallyGradedLayerWithSecondOrder) {
  const double thickness = 3e-3, a = std::log(4.0) / thickness;
  const auto stack = [&](int rows) {
    std::vector<GradedPoint> table;
    for (int i = 0; i <= rows; ++i)
      table.push_back({thickness * i / rows, {840e9 * std::exp(-a * thickness * i / rows), 0.25}});
    return LayeredHalfSpace{cut_into_layers(table, 0.3), kSteel};
  };
  const LayeredHalfSpace coarse = stack(40), fine = stack(80);
  ASSERT_EQ(fine.layers.size(), 80u) << "every row one cut";
  for (double k : {50.0, 400.0, 1500.0}) {
    const CompliancePoint exact = exponentially_graded_compliance(840e9, a, thickness, 0.25, k),
                          c = layered_compliance_at(coarse, k), f = layered_compliance_at(fine, k);
    expect_close(f, exact, 3e-4);
    for (double CompliancePoint::*part : {&CompliancePoint::zz, &CompliancePoint::rr, &CompliancePoint::tt})
      EXPECT_NEAR((c.*part - exact.*part) / (f.*part - exact.*part), 4, 0.1) << k;
  }
}

}  // namespace
}  // namespace railstrata
