#include "calibrate/calibrate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/faults.hpp"
#include "material/elastic.hpp"
#include "material/material_path.hpp"
#include "material/steels.hpp"

namespace railstrata {
namespace {

constexpr double kMPa = 1e6;

PlasticParameters<double> known_law() { return {0, 300 * kMPa, 0, 0, {80000 * kMPa, 20000 * kMPa}, {900, 110}}; }

void expect_same(const PlasticParameters<double>& a, const PlasticParameters<double>& b, double tolerance) {
  EXPECT_NEAR(a.yield, b.yield, tolerance * b.yield);
  EXPECT_NEAR(a.saturation, b.saturation, tolerance * b.yield);
  for (int k = 0; k < kMostBackstresses; ++k) {
    const int other = a.recall[0] > a.recall[1] ? k : k < 2 ? 1 - k : k;  // in either order
    EXPECT_NEAR(a.modulus[k], b.modulus[other], tolerance * b.modulus[other]) << k;
    EXPECT_NEAR(a.recall[k], b.recall[other], tolerance * b.recall[other]) << k;
  }
}

TEST(Calibrate, AmplitudesOfAKnownLawGiveItBack) {
  std::vector<CurvePoint> points;
  for (double e = 2e-4; e < 0.02; e *= 1.3) points.push_back({e, amplitude_of(known_law(), e)});
  const HardeningFit fit = fit_amplitudes(points, 2);
  EXPECT_LT(fit.largest_error, 1e-4);
  expect_same(fit.law, known_law(), 0.02);
  EXPECT_EQ(fit_amplitudes(points, 0).backstresses, 2) << "as few as needed";
}

TEST(Calibrate, ScatterOfATestStaysAsError) {
  std::mt19937 random(1);
  std::normal_distribution<double> scatter(1, 0.01);
  std::vector<CurvePoint> points;
  for (double e = 2e-4; e < 0.02; e *= 1.1) points.push_back({e, scatter(random) * amplitude_of(known_law(), e)});
  const HardeningFit fit = fit_amplitudes(points, 2);
  EXPECT_NEAR(fit.error, 0.008, 0.003);
  for (const double e : {5e-4, 2e-3, 1e-2})
    EXPECT_NEAR(amplitude_of(fit.law, e), amplitude_of(known_law(), e), 0.02 * amplitude_of(known_law(), e));
}

/// The rising branch of a loop that the law itself has been driven around until it no longer changes.
TEST(Calibrate, ALoopDrivenThroughTheLawGivesItBack) {
  const Elastic e = elastic(210e9, 0.3, 7800);
  PlasticParameters<double> law = known_law();
  law.mu = e.mu;
  MaterialPath path;
  path.prescribed.fill(Prescribed::stress);
  path.prescribed[0] = Prescribed::strain;
  for (int half = 0; half < 30; ++half) path.points.push_back({half % 2 == 0 ? 0.01 : -0.01, 0, 0, 0, 0, 0});
  std::vector<CurvePoint> branch;
  int seen = 0;
  const auto look = [&](const MaterialState& s) {
    if (++seen > 28 * 400 && seen <= 29 * 400) branch.push_back({s.history[0], s.stress[0]});
  };
  drive_path({e.lambda, law}, path, 400, look);
  Loop loop;
  loop.amplitude = -branch.front().plastic_strain;
  for (const CurvePoint& point : branch)
    if (point.plastic_strain > -loop.amplitude + 1e-4) loop.points.push_back(point);
  EXPECT_NEAR(loop_stress(law, loop.amplitude, loop.amplitude), amplitude_of(law, loop.amplitude), 1);
  for (const CurvePoint& point : loop.points)
    ASSERT_NEAR(loop_stress(law, loop.amplitude, point.plastic_strain), point.stress, 2e-3 * 550 * kMPa);
  expect_same(fit_loop(loop, 2).law, law, 0.05);
}

TEST(Calibrate, AMonotonicCurveTellsTheIsotropicPart) {
  for (const double q : {80.0, -60.0}) {
    PlasticParameters<double> law = known_law();
    law.saturation = q * kMPa;
    law.rate = 15;
    std::vector<CurvePoint> amplitudes, tension;
    for (double e = 2e-4; e < 0.02; e *= 1.3) amplitudes.push_back({e, amplitude_of(law, e)});
    for (double e = 1e-3; e < 0.1; e *= 1.2) tension.push_back({e, monotonic_stress(law, e)});
    const HardeningFit fit = with_isotropic_part(fit_amplitudes(amplitudes, 2), tension);
    EXPECT_NEAR(fit.law.saturation, q * kMPa, 0.03 * std::abs(q) * kMPa);
    EXPECT_NEAR(fit.law.rate, 15, 0.5);
    EXPECT_NEAR(fit.law.yield, 300 * kMPa, 3 * kMPa);
    EXPECT_LT(fit.error, 1e-3);
  }
}

TEST(Calibrate, TooFewPointsAreRefused) {
  EXPECT_THROW(fit_amplitudes({{1e-3, 400e6}, {2e-3, 450e6}}, 2), std::invalid_argument);
  EXPECT_THROW(fit_amplitudes({{0, 400e6}, {2e-3, 450e6}, {3e-3, 460e6}}, 1), std::invalid_argument);
}

// [Waechter2016]; yield stress, four moduli [MPa], stress at a plastic amplitude of 0.2 %, of another program.
TEST(HardeningSets, SetsOfGradesAreTheFitOfTheCyclicCurve) {
  struct Row {
    const char* name;
    double k, at, yield, c[4];
  };
  for (const Row& row : {Row{"R220", 1533, 480, 230, {352805, 85526, 22542, 5251}},
                         {"R260", 1782, 558, 268, {410154, 99428, 26207, 6104}},
                         {"R350HT", 2470, 773, 371, {568285, 137762, 36310, 8458}},
                         {"R400HT", 2720, 851, 409, {625884, 151725, 39991, 9315}},
                         {"ER7", 1646, 515, 247, {378751, 91816, 24200, 5637}},
                         {"er8", 1737, 543, 261, {399655, 96883, 25536, 5948}}}) {
    const Steel& steel = hardening_set(row.name);
    const HardeningSet& set = steel.hardening;
    const double strength = cyclic_strength_coefficient(steel.tensile.low);
    EXPECT_NEAR(strength, row.k * kMPa, kMPa) << row.name;
    EXPECT_NEAR(set.law.yield, row.yield * kMPa, kMPa) << row.name;
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(set.law.modulus[k], row.c[k] * kMPa, 1e-3 * row.c[k] * kMPa) << row.name;
    EXPECT_EQ(set.certainty, Certainty::estimated);
    const double curve = strength * std::pow(0.002, kCyclicExponent);
    EXPECT_NEAR(curve, row.at * kMPa, kMPa);
    std::vector<CurvePoint> points;
    for (int i = 0; i < 60; ++i) {
      const double e = 1e-4 * std::pow(150, i / 59.0);
      points.push_back({e, strength * std::pow(e, kCyclicExponent)});
      EXPECT_NEAR(amplitude_of(set.law, e), points.back().stress, 5e-3 * points.back().stress) << row.name << " " << e;
    }
    const PlasticParameters<double> fit = fit_amplitudes(points, std::vector<double>{4000, 700, 120, 8}).law;
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(fit.modulus[k], set.law.modulus[k], 1e-4 * set.law.modulus[k]) << row.name;
  }
}

TEST(HardeningSets, EverySetSaysHowSureItIsAndAnUnknownNameTheNearest) {
  for (const std::string& name : hardening_set_names()) {
    const Steel& steel = hardening_set(name);
    EXPECT_FALSE(steel.hardening.source.empty() || steel.use.empty()) << name;
    EXPECT_GT(steel.hardening.law.yield + steel.hardening.law.saturation, 0) << name;
    EXPECT_GT(steel.hardening.law.modulus[0], 0) << name;
  }
  try {
    hardening_set("R350H");
    FAIL() << "no such set";
  } catch (const CaseError& e) {
    EXPECT_NE(std::string(e.what()).find("did you mean \"R350HT\""), std::string::npos) << e.what();
  }
}

// Points of the law itself; the grid of b is 2 % wide.
TEST(YieldStresses, OfALawGiveItsNumbersBack) {
  std::vector<CurvePoint> points;
  for (const double p : {0.0, 0.05, 0.1, 0.3, 0.6, 1.0, 2.0})
    points.push_back({p, 420e6 + 480e6 * (1 - std::exp(-3 * p))});
  const HardeningFit fit = fit_yield_stresses(points);
  EXPECT_NEAR(fit.law.rate, 3, 0.03);
  EXPECT_NEAR(fit.law.yield, 420e6, 2e6);
  EXPECT_NEAR(fit.law.yield + fit.law.saturation, 900e6, 2e6);
  EXPECT_LT(fit.error, 2e-3);
  points.resize(3);
  EXPECT_THROW(fit_yield_stresses(points), std::invalid_argument);
}

}  // namespace
}  // namespace railstrata
