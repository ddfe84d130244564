#include "single_track/spline_basis.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace railstrata {
namespace {

const std::vector<double> kKnots = {0, 0.1, 0.3, 0.6, 0.6, 1, 1.5, 1.7, 2};

double sum(const SplineTerms& terms, const std::vector<double>& factors, double SplineTerm::*what) {
  double s = 0;
  for (const SplineTerm& t : terms) s += factors[t.unknown] * (t.*what);
  return s;
}

TEST(SplineBasis, AddsUpToOneAndIsItsDerivatives) {
  for (const SplineEnd end : {SplineEnd::open, SplineEnd::mirrored}) {
    const SplineBasis basis(kKnots, end, end);
    const auto unknowns = basis.unknowns(false, 0, 0);
    std::vector<double> ones(unknowns.count, 1.), waves;
    for (int i = 0; i < unknowns.count; ++i) waves.push_back(std::sin(1 + 2. * i));
    for (const double t : {0.02, 0.25, 0.59, 0.61, 1.2, 1.95}) {
      EXPECT_NEAR(sum(basis.at(t, true, unknowns), ones, &SplineTerm::value), 1, 1e-14);
      EXPECT_NEAR(sum(basis.at(t, true, unknowns), ones, &SplineTerm::slope), 0, 1e-12);
      const double h = 1e-5;
      const auto value = [&](double at) { return sum(basis.at(at, true, unknowns), waves, &SplineTerm::value); };
      const auto slope = [&](double at) { return sum(basis.at(at, true, unknowns), waves, &SplineTerm::slope); };
      EXPECT_NEAR(slope(t), (value(t + h) - value(t - h)) / (2 * h), 1e-6);
      EXPECT_NEAR(sum(basis.at(t, true, unknowns), waves, &SplineTerm::curvature),
                  (slope(t + h) - slope(t - h)) / (2 * h), 1e-4);
    }
  }
}

TEST(SplineBasis, OnlyCurvatureJumpsAtADoubleKnot) {
  const SplineBasis basis(kKnots, SplineEnd::open, SplineEnd::open);
  const auto unknowns = basis.unknowns(false, 0, 0);
  std::vector<double> waves;
  for (int i = 0; i < unknowns.count; ++i) waves.push_back(std::sin(1 + 2. * i));
  const auto jump = [&](double t, double SplineTerm::*what) {
    return sum(basis.at(t, true, unknowns), waves, what) - sum(basis.at(t, false, unknowns), waves, what);
  };
  EXPECT_NEAR(jump(0.6, &SplineTerm::value), 0, 1e-13);
  EXPECT_NEAR(jump(0.6, &SplineTerm::slope), 0, 1e-12);
  EXPECT_GT(std::abs(jump(0.6, &SplineTerm::curvature)), 1);
  EXPECT_NEAR(jump(0.3, &SplineTerm::curvature), 0, 1e-11);
}

TEST(SplineBasis, KeepsTheConditionsOfItsEnds) {
  const SplineBasis open(kKnots, SplineEnd::open, SplineEnd::open),
      mirrored(kKnots, SplineEnd::mirrored, SplineEnd::mirrored);
  const auto clamped = open.unknowns(false, 2, 1), even = mirrored.unknowns(false, 2, 2),
             odd = mirrored.unknowns(true, 2, 2);
  for (const SplineTerm& t : open.at(0, true, clamped)) EXPECT_EQ(std::abs(t.value) + std::abs(t.slope), 0);
  for (const SplineTerm& t : open.at(2, false, clamped)) EXPECT_EQ(t.value, 0);
  for (const double end : {0., 2.}) {
    for (const SplineTerm& t : mirrored.at(end, end == 0, even)) EXPECT_NEAR(t.slope, 0, 1e-13);
    for (const SplineTerm& t : mirrored.at(end, end == 0, odd))
      EXPECT_NEAR(std::abs(t.value) + 1e-3 * std::abs(t.curvature), 0, 1e-13);
  }
  EXPECT_EQ(even.count, odd.count + 2);
}

}  // namespace
}  // namespace railstrata
