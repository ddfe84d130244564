#include "damage/dang_van.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/parallel.hpp"
#include "tests/damage/hertz_stress.hpp"

namespace railstrata {
namespace {

constexpr double kC = 0.35;

/// One turn of a harmonic load, 72 samples: the extremes of sine and cosine are among them.
template <class Stress>
std::vector<Sym3> turn(Stress stress) {
  std::vector<Sym3> cycle;
  for (int i = 0; i < 72; ++i) cycle.push_back(stress(2 * std::numbers::pi * i / 72));
  return cycle;
}

TEST(DangVan, AlternatingTorsionIsItsAmplitude) {
  const auto cycle = turn([](double t) { return Sym3{.xz = 180e6 * std::sin(t)}; });
  EXPECT_NEAR(dang_van_stress(cycle, {}, kC).stress, 180e6, 1);
}

TEST(DangVan, AlternatingTensionIsHalfOfItAndItsHydrostaticShare) {
  const auto cycle = turn([](double t) { return Sym3{.yy = 300e6 * std::sin(t)}; });
  const DangVanStress s = dang_van_stress(cycle, {}, kC);
  EXPECT_NEAR(s.stress, 150e6 + kC * 100e6, 1);
  EXPECT_NEAR(s.amplitude, 150e6, 1);
  EXPECT_NEAR(s.hydrostatic, 100e6, 1);
}

TEST(DangVan, AMeanShearAddsNothingAMeanPressureInFull) {
  const auto plain = turn([](double t) { return Sym3{.xx = 300e6 * std::sin(t)}; });
  const auto sheared = turn([](double t) { return Sym3{.xx = 300e6 * std::sin(t), .xy = 90e6, .yz = -200e6}; });
  EXPECT_NEAR(dang_van_stress(sheared, {}, kC).stress, dang_van_stress(plain, {}, kC).stress, 1);
  const Sym3 pressure{-50e6, -50e6, -50e6};
  EXPECT_NEAR(dang_van_stress(plain, pressure, kC).stress, dang_van_stress(plain, {}, kC).stress - kC * 50e6, 1);
  const Sym3 layer{-300e6, -300e6, 0};
  EXPECT_NEAR(dang_van_stress(plain, layer, kC).stress, dang_van_stress(plain, {}, kC).stress - kC * 200e6, 1);
}

// Pulsating torsion 0 to tau: half of it. Shear that turns (circle of radius tau): tau at every time.
TEST(DangVan, PulsatingAndTurningShear) {
  const auto pulse = turn([](double t) { return Sym3{.xy = 200e6 * std::pow(std::sin(t / 2), 2)}; });
  EXPECT_NEAR(dang_van_stress(pulse, {}, kC).stress, 100e6, 1);
  const auto circle = turn([](double t) { return Sym3{.yz = 200e6 * std::sin(t), .xz = 70e6 + 200e6 * std::cos(t)}; });
  EXPECT_NEAR(dang_van_stress(circle, {}, kC).stress, 200e6, 1);
}

// Tension and torsion 90 degrees apart: tau_a = sqrt(s²/4 + t²) of that time.
TEST(DangVan, TensionAndTorsionOutOfPhase) {
  const double s = 300e6, t = 120e6;
  const auto cycle = turn([&](double a) { return Sym3{.xx = s * std::sin(a), .xy = t * std::cos(a)}; });
  double expected = 0;
  for (int i = 0; i < 72; ++i) {
    const double a = 2 * std::numbers::pi * i / 72;
    expected = std::max(expected, std::hypot(s / 2 * std::sin(a), t * std::cos(a)) + kC * s / 3 * std::sin(a));
  }
  EXPECT_NEAR(dang_van_stress(cycle, {}, kC).stress, expected, 1);
}

// A frictionless line contact: at 0.5 a orthogonal shear turns from -p0/4 to p0/4, and no residual stress lowers it.
TEST(DangVan, RollingLineContactHasAQuarterOfThePressure) {
  const auto h = testing::history_of(testing::LineLoad{}, testing::rolling_samples(0.02), {0}, {0.3, 0.5, 0.8});
  const std::vector<DangVanLimit> no_pressure(3, {0, 0.2});
  const DangVanSection s = dang_van(h, {}, no_pressure);
  EXPECT_NEAR(s.point[1].stress, 0.25, 0.25 * 0.002);
  EXPECT_LT(s.point[0].stress, 0.25);
  EXPECT_LT(s.point[2].stress, 0.25);
  EXPECT_EQ(s.row, 1);
  EXPECT_NEAR(s.utilisation, 1.25, 0.003);
  const std::vector<DangVanLimit> with_pressure(3, {0.3, 0.2});
  EXPECT_LT(dang_van(h, {}, with_pressure).point[1].stress, 0.25) << "the contact's pressure helps";
}

TEST(DangVan, TheWorstRowIsThatOfTheLargestUtilisation) {
  const auto h = testing::history_of(testing::LineLoad{}, testing::rolling_samples(0.1), {0, 1}, {0.3, 0.5, 0.8});
  const std::vector<DangVanLimit> weak_below{{0, 0.3}, {0, 0.3}, {0, 0.1}};
  const DangVanSection s = dang_van(h, {}, weak_below);
  EXPECT_EQ(s.row, 2);
  EXPECT_EQ(s.column, 0) << "of two that are alike the first";
}

// Pressure outweighs shear in every row: the worst utilisation is negative, and a row without a limit is not it.
TEST(DangVan, RowsWithoutALimitDoNotCount) {
  const auto h = testing::history_of(testing::LineLoad{}, {-1, 0, 1}, {0}, {0.3, 0.5});
  const std::vector<Sym3> pressed(2, {-9, -9, -9});
  const double none = std::numeric_limits<double>::infinity();
  const DangVanSection s = dang_van(h, pressed, std::vector<DangVanLimit>{{0.3, 1}, {0.3, none}});
  EXPECT_EQ(s.row, 0);
  EXPECT_LT(s.utilisation, 0);
  EXPECT_EQ(dang_van(h, pressed, std::vector<DangVanLimit>(2, {0.3, none})).row, std::nullopt);
}

TEST(DangVan, HasTheSameBitsForAnyThreads) {
  const auto h = testing::history_of(testing::HertzLoad{.friction = 0.2}, testing::rolling_samples(0.2),
                                     testing::steps(-1, 1, 0.25), testing::steps(0.1, 1, 0.1));
  const std::vector<DangVanLimit> limits(h.depth.size(), {0.33, 0.3});
  const int threads = max_threads();
  set_threads(1);
  const DangVanSection one = dang_van(h, {}, limits);
  set_threads(3);
  const DangVanSection three = dang_van(h, {}, limits);
  set_threads(threads);
  for (std::size_t i = 0; i < one.point.size(); ++i) EXPECT_EQ(one.point[i].stress, three.point[i].stress);
}

TEST(DangVan, AlternatingTensionLiesOnTheLimitThatFollowsFromIt) {
  const DangVanLimit l{3 * (250.0 / 400 - 0.5), 250e6};
  const auto tension = turn([](double t) { return Sym3{.xx = 400e6 * std::sin(t)}; });
  EXPECT_NEAR(dang_van_stress(tension, {}, l.c).stress, l.limit, 1);
}

TEST(DangVan, RowsThatDoNotFitAreRefused) {
  const auto h = testing::history_of(testing::LineLoad{}, {-1, 0, 1}, {0}, {0.3, 0.5});
  EXPECT_THROW(dang_van(h, {}, std::vector<DangVanLimit>(1, {0.3, 1})), std::invalid_argument);
  EXPECT_THROW(dang_van(h, {}, std::vector<DangVanLimit>(2, {0.3, 0})), std::invalid_argument);
  EXPECT_THROW(dang_van(h, std::vector<Sym3>(1), std::vector<DangVanLimit>(2, {0.3, 1})), std::invalid_argument);
}

}  // namespace
}  // namespace railstrata
