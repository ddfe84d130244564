// A line contact of Hertz's pressure over a crack.
#include "crack/crack_passage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "crack/crack_growth.hpp"

namespace railstrata {
namespace {

using std::numbers::pi;

constexpr double kHalf = 6e-3, kPressure = 1200e6;
const LayeredHalfSpace kSteel{{}, {210e9, 0.3}};

/// McEwen's stresses of p0 sqrt(1 - x²/a²) and of a traction on the rail along -x, `share` times as large.
/// [Johnson1985]
Sym3 line_contact(double x, double z, double share) {
  const double a = kHalf, A = a * a - x * x + z * z, B = std::sqrt(A * A + 4 * x * x * z * z);
  const double m = std::sqrt(0.5 * (B + A)), n = std::copysign(std::sqrt(std::max(0.0, 0.5 * (B - A))), x),
               d = m * m + n * n, p = kPressure / a, q = -share * p;
  const double pressed = -p * (m * (1 + (z * z + n * n) / d) - 2 * z), sheared = -p * n * (m * m - z * z) / d;
  return {.xx = pressed + q * (n * (2 - (z * z - m * m) / d) - 2 * x),
          .zz = -p * m * (1 - (z * z + n * n) / d) + q / p * sheared,
          .xz = sheared + q / p * pressed};
}

StressHistory line_history(double share) {
  StressHistory out;
  for (int i = -200; i <= 200; ++i) out.x.push_back(i * kHalf / 50);
  out.y = {0};
  for (double z = 0; z < 8e-3; z += z < 1e-3 ? 0.02e-3 : 0.1e-3) out.depth.push_back(z);
  out.zone.assign(out.depth.size(), 0);
  for (const double z : out.depth)
    for (const double x : out.x) out.stress.push_back(line_contact(x, std::max(z, 1e-9), share));
  return out;
}

CrackLine edge(double depth, double degrees = 25) {
  const double angle = degrees * pi / 180;
  return {.kind = CrackKind::mouth, .angle = angle, .length = depth / std::sin(angle)};
}

CrackPassage passage(double depth, double share, const PassageOptions& options, double azimuth = 0) {
  return pass_over(edge(depth), kSteel, {line_history(share), 0, azimuth, {}}, options);
}

/// The faces stick everywhere under much friction: the crack is not there.
TEST(CrackPassage, StuckFacesLeaveNoShear) {
  const CrackPassage found = passage(1e-3, 0, {.friction = 50, .most_passes = 2});
  EXPECT_LT(range_of(found.end).II, 0.5e6);
}

TEST(CrackPassage, FrictionOfTheFacesTakesShearAway) {
  double last = 1e300;
  for (const double friction : {0.0, 0.1, 0.2, 0.4}) {
    const CrackPassage found = passage(1.27e-3, 0.2, {.friction = friction});
    EXPECT_TRUE(found.settled) << friction;
    EXPECT_LT(range_of(found.end).II, last);
    last = range_of(found.end).II;
  }
}

TEST(CrackPassage, PlacesAndPointsConverge) {
  const StressIntensity fine = range_of(passage(1.27e-3, 0.2, {.points = 48, .places = 960}).end),
                        usual = range_of(passage(1.27e-3, 0.2, {}).end);
  EXPECT_NEAR(usual.II, fine.II, 0.01 * fine.II);
  EXPECT_NEAR(usual.I, fine.I, 0.02 * fine.II);
}

/// Rolling that goes the other way with the traction turned over is the mirror image.
TEST(CrackPassage, DirectionOfTheCrackMirrorsTheTraction) {
  StressHistory mirrored = line_history(-0.2);
  const StressHistory given = line_history(0.2);
  for (int r = 0; r < given.rows(); ++r)
    for (int s = 0; s < given.samples(); ++s) {
      const Sym3 a = given.cycle(r, 0)[given.samples() - 1 - s], b = mirrored.cycle(r, 0)[s];
      ASSERT_NEAR(a.xx, b.xx, 1e-3);
      ASSERT_NEAR(a.xz, -b.xz, 1e-3);
    }
  // without friction of the faces nothing remembers, so the order of the places does not matter
  const CrackPassage forward = passage(1e-3, 0.2, {.friction = 0}), backward = passage(1e-3, -0.2, {.friction = 0}, pi);
  EXPECT_NEAR(range_of(forward.end).II, range_of(backward.end).II, 2e-3 * range_of(forward.end).II);
}

TEST(CrackPassage, ATrappedFluidOpensTheCrack) {
  const StressIntensity dry = range_of(passage(2e-3, -0.1, {.friction = 0.1}).end),
                        mouth = range_of(passage(2e-3, -0.1, {.friction = 0.1, .fluid = CrackFluid::mouth}).end);
  EXPECT_GT(mouth.I, 2 * dry.I);
  const CrackPassage trapped = passage(2e-3, -0.1, {.friction = 0.1, .fluid = CrackFluid::trapped, .places = 80});
  for (const double pressure : trapped.fluid) EXPECT_GE(pressure, 0);
}

TEST(CrackPassage, AKinkUnderTensionAndUnderShear) {
  const Kink opened = worst_kink({{}, {10e6, 0}}), sheared = worst_kink({{}, {0, 10e6}});
  EXPECT_NEAR(opened.range, 10e6, 1);
  EXPECT_NEAR(opened.angle, 0, 1e-12);
  EXPECT_NEAR(sheared.range, 11.55e6, 0.01e6);  // 2/sqrt(3) at -70.5 degrees
  EXPECT_NEAR(sheared.angle, -70.5 * pi / 180, 0.01);
}

TEST(CrackGrowth, LawsMeetTheirSources) {
  EXPECT_NEAR(growth_rate(GrowthLaw::paris, {10e6, 0}, 0), 17e-9, 1e-12);
  EXPECT_NEAR(growth_rate(GrowthLaw::paris, {13.5e6, 0}, 0), 55e-9, 1e-12);
  EXPECT_NEAR(growth_rate(GrowthLaw::shear, {0, 20e6}, 0), 0.000614e-9 * std::pow(20, 3.21), 1e-15);
  EXPECT_EQ(growth_rate(GrowthLaw::shear, {3.9e6, 0}, 4e6), 0);
}

TEST(CrackGrowth, FrontsOfTheirLimits) {
  const FrontFactors straight = front_factors(1e6, 0.3), circle = front_factors(1, 0.3),
                     near = front_factors(1.0002, 0.3);
  EXPECT_NEAR(straight.II, 1, 1e-5);
  EXPECT_NEAR(straight.I, 1.13 / 1.1215, 1e-5);
  EXPECT_NEAR(circle.II, 4 / (pi * 1.7), 1e-12);
  EXPECT_NEAR(near.II, circle.II, 1e-3);
}

}  // namespace
}  // namespace railstrata
