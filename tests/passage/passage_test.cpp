#include "passage/passage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/fem/small_rolling.hpp"

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

CaseSpec wheel_on_steel(double young) {
  CaseSpec spec = fem_checks::small_case();
  spec.run.window = 0;
  spec.rail_material.young = young;
  spec.rail_material.strength.yield_strength = 600e6;
  spec.rail_material.strength.fatigue.limit = 200e6;
  spec.rail_material.strength.fatigue.dang_van = 0.3;
  spec.rail_material.strength.fatigue.fatemi_socie = 1;
  return spec;
}

/// Followed at one place, within a stretch of these factors all along.
BodyFatigue fatigue_in_a_stretch(CaseSpec spec, double young, double strength) {
  spec.stretches.push_back({BodyId::rail, {{-1, young, strength}, {0.014, young, strength}, {1, young, strength}}, {}});
  const RollingSystem system(build_model(spec, {}));
  return passage_fatigue(system, run_rolling(system, {})).at(0);
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

TEST(Passage, AStretchOfHalfTheStrengthHasHalfTheLimitAndHalfTheYieldStress) {
  const BodyFatigue strong = fatigue_in_a_stretch(wheel_on_steel(210e9), 1, 1),
                    weak = fatigue_in_a_stretch(wheel_on_steel(210e9), 1, 0.5);
  EXPECT_GT(strong.dang_van->value, 0.1);
  EXPECT_NEAR(weak.dang_van->value / strong.dang_van->value, 2, 1e-9);
  EXPECT_GT(weak.fatemi_socie->value, strong.fatemi_socie->value);
  EXPECT_NEAR(weak.smith_watson_topper->value / strong.smith_watson_topper->value, 1, 1e-9);
}

TEST(Passage, AStretchOfHalfTheModulusHasTheStrainsOfAMaterialThatHasIt) {
  const BodyFatigue stretch = fatigue_in_a_stretch(wheel_on_steel(210e9), 0.5, 1),
                    material = fatigue_in_a_stretch(wheel_on_steel(105e9), 1, 1);
  EXPECT_NEAR(stretch.fatemi_socie->value / material.fatemi_socie->value, 1, 0.01);  // with strains of 210 GPa: 0.5
}

}  // namespace railstrata
