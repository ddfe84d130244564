// The approach given instead of the load: the same state from the other input, and Hertz's.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "ask/answer.hpp"
#include "bem/creep_curve.hpp"
#include "core/faults.hpp"
#include "reader/case_file.hpp"

namespace railstrata {
namespace {

const std::string kCircle =
    "[geometry]\nrail_profile = \"arc:R=840 mm\"\nwheel_profile = \"arc:R=840 mm\"\nwheel_radius = \"420 mm\"\n"
    "wheel_shape = \"disc\"\nbore_radius = \"20 mm\"\ncant = 0.0\n";

const std::string kEuropean =
    "[geometry]\nrail_profile = \"UIC60\"\nwheel_profile = \"S1002\"\nlateral_shift = \"3 mm\"\n";

Answer solved(const std::string& text, double cell, const std::vector<std::string>& overrides = {}) {
  const LoadedCase loaded = parse_case(text, "a.toml", overrides);
  BemOptions options;
  options.cell = cell;
  return ask(loaded.spec, place(loaded.spec, {}), kContactAlone, {.bem = options});
}

// tests/data/reference/half_space.csv, circ: approach 0.08987738 mm under 84954.6 N by Hertz.
TEST(GivenApproach, LoadAndPatchAreHertzs) {
  const ContactSummary c = solved(kCircle + "[vehicle]\napproach = \"0.08987738 mm\"\n", 0.125e-3).summary.contact;
  EXPECT_NEAR(c.F_z / 84954.6, 1, 1e-3);
  EXPECT_NEAR(c.patch.p_max / 1074.5548e6, 1, 1e-3);
  EXPECT_NEAR(0.5 * c.patch.length / 6.143981e-3, 1, 5e-3);
  EXPECT_DOUBLE_EQ(c.approach, 0.08987738e-3);
}

TEST(GivenApproach, AndLoadAreTwoWaysOfSayingOneState) {
  for (const std::string& driven :
       {std::string("[drive]\ntraction_coefficient = 0.25\nlateral_traction_coefficient = 0.1\n"),
        std::string("[drive]\ncreepage = -0.001\nlateral_creepage = 0.0005\n")})
    for (const std::string& geometry : {std::string("[geometry]\nlateral_shift = \"6 mm\"\n"), kEuropean, kCircle}) {
      const std::string layer = "[[layer]]\nyoung_ratio = 3\n";
      const Answer by_load = solved(geometry + driven + layer, 0.5e-3);
      const ContactSummary &a = by_load.summary.contact,
                           b = solved(geometry + driven + layer, 0.5e-3,
                                      {fmt::format("vehicle.approach={:.15g} m", a.approach)})
                                   .summary.contact;
      EXPECT_NEAR(b.F_z / a.F_z, 1, 5e-5);
      EXPECT_NEAR(b.F_x / a.F_x, 1, 1e-4);
      EXPECT_NEAR(b.lateral_force / a.lateral_force, 1, 1e-4);
      EXPECT_NEAR(b.creepage_x / a.creepage_x, 1, 2e-4);
      EXPECT_NEAR(b.patch.p_max / a.patch.p_max, 1, 1e-4);
    }
}

TEST(GivenApproach, IsNotHeldAgainstAWeight) {
  const Answer s = solved(kCircle + "[vehicle]\napproach = \"0.05 mm\"\n", 0.5e-3);
  for (const Check& c : s.summary.checks) {
    EXPECT_NE(c.name, "F_z_relative_to_weight");
    EXPECT_TRUE(c.ok) << c.name;
  }
}

TEST(GivenApproach, HasACreepCurve) {
  const LoadedCase by_approach = parse_case(kCircle + "[vehicle]\napproach = \"0.08987738 mm\"\n", "a.toml"),
                   by_load = parse_case(kCircle + "[vehicle]\nwheel_load = \"84954.6 N\"\n", "a.toml");
  BemOptions options;
  options.cell = 0.5e-3;
  const auto curve = [&](const LoadedCase& loaded) {
    return creep_curve(loaded.spec, place(loaded.spec, {}), VariedCreepage::longitudinal, {-1e-3}, options).front();
  };
  EXPECT_NEAR(curve(by_approach).full / curve(by_load).full, 1, 2e-3);
  EXPECT_NEAR(curve(by_approach).linear / curve(by_load).linear, 1, 2e-3);
}

}  // namespace
}  // namespace railstrata
