#include "mesh/grading.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace railstrata {
namespace {

double worst_ratio(const std::vector<double>& spacings) {
  double worst = 1;
  for (std::size_t i = 1; i < spacings.size(); ++i)
    worst = std::max({worst, spacings[i] / spacings[i - 1], spacings[i - 1] / spacings[i]});
  return worst;
}

std::vector<double> differences(const std::vector<double>& points) {
  std::vector<double> out;
  for (std::size_t i = 1; i < points.size(); ++i) out.push_back(points[i] - points[i - 1]);
  return out;
}

TEST(GradedPoints, UniformSizeGivesEqualIntervals) {
  const std::vector<double> d = differences(graded_points(-1, 2, [](double) { return 0.25; }));
  ASSERT_EQ(d.size(), 12u);
  for (double x : d) EXPECT_NEAR(x, 0.25, 1e-12);
}

TEST(GradedPoints, LinearSizeGivesTheGeometricSeriesOfItsSlope) {
  const double slope = 0.3;
  const std::vector<double> d = differences(graded_points(0, 20, [&](double x) { return 1 + slope * x; }));
  for (std::size_t i = 1; i < d.size(); ++i) EXPECT_NEAR(d[i] / d[i - 1], d[1] / d[0], 2e-3);
  EXPECT_LT(d[1] / d[0], std::exp(slope) * 1.02);
}

TEST(GrowingSpacings, FillTheLengthWithNeighboursWithinTheRatioForAnyLength) {
  for (double length = 3; length < 300; length *= 1.037) {
    const std::vector<double> d = growing_spacings(length, 3, 1.3, 12);
    EXPECT_NEAR(std::accumulate(d.begin(), d.end(), 0.0), length, 1e-9);
    EXPECT_LE(*std::max_element(d.begin(), d.end()), 12 * (1 + 1e-9));
    EXPECT_LE(worst_ratio(d), 2.0) << length;
    EXPECT_TRUE(length < 60 || worst_ratio(d) <= 1.3 + 1e-9) << length;
  }
}

TEST(SnapInterior, MovesTheNearestPointAndKeepsEndsAndOrder) {
  std::vector<double> p{0, 1, 2.4, 4.3, 7};
  ASSERT_TRUE(snap_interior(p, 3.0));
  EXPECT_EQ(p[2], 3.0);
  EXPECT_EQ(p.front(), 0);
  EXPECT_EQ(p.back(), 7);
  EXPECT_TRUE(std::is_sorted(p.begin(), p.end()));
  EXPECT_FALSE(snap_interior(p, 0.1));
}

TEST(ExtrudedStations, CoarseOnesAreFineOnesAndTheFineRangeCoversTheOneAskedFor) {
  const StationPair s = extruded_stations(-0.016, 0.3305, 1e-3, 3, 0.12, 12e-3);
  EXPECT_DOUBLE_EQ(s.fine_begin, -0.016);
  EXPECT_GE(s.fine_end, 0.3305);
  EXPECT_LT(s.fine_end, 0.3335);
  EXPECT_TRUE(std::includes(s.fine.begin(), s.fine.end(), s.coarse.begin(), s.coarse.end()));
  EXPECT_NEAR(s.fine.back() - s.fine_end, 0.12, 1e-9);
  EXPECT_NEAR(s.fine_begin - s.fine.front(), 0.12, 1e-9);
  for (std::size_t i = 0; i + 1 < s.fine.size(); ++i) {
    const bool inside = s.fine[i] >= s.fine_begin && s.fine[i + 1] <= s.fine_end;
    EXPECT_TRUE(!inside || std::abs(s.fine[i + 1] - s.fine[i] - 1e-3) < 1e-12) << i;
  }
  EXPECT_LE(worst_ratio(differences(s.coarse)), 1.3 + 1e-9);
}

TEST(RingStations, CloseTheRingOnceWithinTheGrowth) {
  const StationPair s = ring_stations(-0.037, 0.77, 1e-3 / 0.43, 3, 18e-3 / 0.43);
  std::vector<double> closed = s.coarse;
  closed.push_back(s.coarse.front() + 2 * std::numbers::pi);
  EXPECT_TRUE(std::is_sorted(closed.begin(), closed.end()));
  EXPECT_LE(worst_ratio(differences(closed)), 1.3 + 1e-9);
  EXPECT_TRUE(std::includes(s.fine.begin(), s.fine.end(), s.coarse.begin(), s.coarse.end()));
}

TEST(RingStations, AreEqualAllRoundWhereTheRangeIsNearlyATurnOrLonger) {
  constexpr double kTurn = 2 * std::numbers::pi, kStep = 1e-3 / 0.43;
  for (double length : {kTurn - 11 * kStep, kTurn, 1.3 * kTurn, 7.4 * kTurn}) {
    const StationPair s = ring_stations(-0.037, -0.037 + length, kStep, 3, 18e-3 / 0.43);
    EXPECT_EQ(s.fine.size(), 3 * s.coarse.size());
    EXPECT_NEAR(kTurn / (kStep * static_cast<double>(s.fine.size())), 1, 1e-3);
    EXPECT_EQ(s.fine.front(), -0.037);
    EXPECT_DOUBLE_EQ(s.fine_end - s.fine_begin, kTurn);
    std::vector<double> closed = s.fine;
    closed.push_back(s.fine.front() + kTurn);
    EXPECT_LT(worst_ratio(differences(closed)), 1 + 1e-9);
    EXPECT_TRUE(std::includes(s.fine.begin(), s.fine.end(), s.coarse.begin(), s.coarse.end()));
  }
}

TEST(RingStations, KeepAGapWhereFourCoarseStepsAreLeft) {
  constexpr double kStep = 1e-3 / 0.43, kLeft = 2 * std::numbers::pi - 12.5 * kStep;
  const StationPair s = ring_stations(-0.037, -0.037 + kLeft, kStep, 3, 18e-3 / 0.43);
  EXPECT_LT(s.fine_end, s.fine_begin + 2 * std::numbers::pi);
  std::vector<double> closed = s.fine;
  closed.push_back(s.fine.front() + 2 * std::numbers::pi);
  EXPECT_TRUE(std::is_sorted(closed.begin(), closed.end()));
  EXPECT_LE(worst_ratio(differences(s.coarse)), 2.0);
}

TEST(Thinned, KeepsEndsAndStaysBelowTheLargestSpacing) {
  const StationPair s = extruded_stations(0, 0.3, 1e-3, 3, 0.12, 12e-3);
  const std::vector<double> few = thinned(s.coarse, 12e-3);
  EXPECT_TRUE(std::includes(s.coarse.begin(), s.coarse.end(), few.begin(), few.end()));
  EXPECT_EQ(few.front(), s.coarse.front());
  EXPECT_EQ(few.back(), s.coarse.back());
  for (double d : differences(few)) EXPECT_LE(d, 12e-3 * (1 + 1e-9));
  EXPECT_LT(few.size(), s.coarse.size() / 2);
}

}  // namespace
}  // namespace railstrata
