#include "judge/passage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace railstrata {
namespace {

constexpr double kStep = 1e-5, kMean = 85e3, kSwing = 40e3, kFrequency = 100;

/// F = F0 - A cos(2 pi f t): smallest at 0, largest at 5 ms.
std::vector<HistoryRow> swinging(double duration) {
  std::vector<HistoryRow> out;
  for (double t = 0; t < duration; t += kStep) {
    HistoryRow row{};
    row.time = t;
    row.forces.z = kMean - kSwing * std::cos(2 * std::numbers::pi * kFrequency * t);
    out.push_back(row);
  }
  return out;
}

}  // namespace

// Closed form: the mean of a cosine over 2 ms about its top is A sin(pi f T)/(pi f T).
TEST(Passage, TheSecondPeakIsTheLargestMeanOfTwoMilliseconds) {
  const double half = std::numbers::pi * kFrequency * 2e-3;
  EXPECT_NEAR(second_peak(swinging(8e-3), 1e-3), kMean + kSwing * std::sin(half) / half, 1e-3 * kSwing);
}

TEST(Passage, AForceThatStillRisesOrFallsAllTheWayHasNoSecondPeak) {
  EXPECT_TRUE(std::isnan(second_peak(swinging(5.5e-3), 1e-3)));
  EXPECT_TRUE(std::isnan(second_peak(swinging(9e-3), 5e-3)));
  EXPECT_TRUE(std::isnan(second_peak(swinging(2e-3), 1e-3)));
}

}  // namespace railstrata
