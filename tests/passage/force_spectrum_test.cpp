#include "passage/passage.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reader/case_file.hpp"

namespace railstrata {
namespace {

// 100 km/h over 40 mm: 694 Hz
const CaseSpec kWaves = parse_case(
                            "[[irregularity]]\nkind = \"corrugation\"\nwavelength = \"40 mm\"\ndepth = "
                            "\"20 um\"\nat = \"500 mm\"\nfrom = \"80 mm\"\nto = \"1.1 m\"\n[run]\nrun_up = "
                            "\"60 mm\"\npositions = [\"1 m\"]\nwindow = \"0 mm\"\n",
                            "a.toml")
                            .spec;

/// 85 kN, 4 kN at 694 Hz and 2 kN of a slow wave that does not end whole.
std::vector<HistoryRow> history() {
  std::vector<HistoryRow> out;
  for (double x = 0; x <= 1; x += 0.5e-3) {
    HistoryRow row{};
    row.time = x / kWaves.drive.speed;
    row.position = x;
    const double turn = 2 * std::numbers::pi;
    row.forces.z = 85e3 + 4e3 * std::sin(turn * x / 0.04 + 0.3) + 2e3 * std::cos(turn * x / 0.6);
    out.push_back(row);
  }
  return out;
}

}  // namespace

TEST(ForceSpectrum, TheAmplitudeAtThePassingFrequency) {
  const auto line = passing_force(kWaves, history());
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->frequency, kWaves.drive.speed / 0.04, 1e-9);
  EXPECT_NEAR(line->wavelength, 0.04, 1e-12);
  EXPECT_NEAR(line->amplitude, 4e3, 0.02 * 4e3);
}

TEST(ForceSpectrum, HasItsPeakThere) {
  const std::vector<ForceLine> lines = force_spectrum(kWaves, history());
  ASSERT_FALSE(lines.empty());
  const auto most = std::max_element(lines.begin() + 8, lines.end(),
                                     [](const ForceLine& a, const ForceLine& b) { return a.amplitude < b.amplitude; });
  EXPECT_NEAR(most->frequency, kWaves.drive.speed / 0.04, lines[0].frequency);
  EXPECT_GT(most->amplitude, 0.95 * 4e3);
  EXPECT_LE(most->amplitude, 1.01 * 4e3);
  EXPECT_LE(lines.back().frequency, 5000);
}

TEST(ForceSpectrum, NothingOfARailThatIsTheSameAllAlong) {
  CaseSpec same = kWaves;
  same.irregularities.clear();
  EXPECT_TRUE(force_spectrum(same, history()).empty());
  EXPECT_FALSE(passing_force(same, history()));
}

}  // namespace railstrata
