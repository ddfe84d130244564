// A life must not depend on what is only method.
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "clock/clock.hpp"
#include "reader/case_file.hpp"

namespace railstrata {
namespace {

constexpr const char* kCase =
    "[geometry]\nrail_profile = \"arc:R=300 mm\"\nwheel_profile = \"arc:R=-500 mm\"\ncant = 0\n"
    "[vehicle]\nwheel_load = \"120 kN\"\n[material.rail]\ngrade = \"R260\"\nhardening = \"R260\"\n"
    "[drive]\nspeed = \"20 m/s\"\ntraction_coefficient = 0.1\nfriction_coefficient = 0.35\n"
    "[passes]\nductility = 0.5\n";
constexpr const char* kLoads =
    "[[load]]\nname = \"a\"\npassages = 600\nwheel_load = \"120 kN\"\n"
    "[[load]]\nname = \"b\"\npassages = 400\nwheel_load = \"90 kN\"\nlateral_shift = \"3 mm\"\n";

ClockOptions usual() {
  ClockOptions out;
  out.bem.cell = 0.5e-3;
  out.horizon = 3e9;
  return out;
}

/// Gross traffic [MGT] until the first failure.
double life(const ClockOptions& options, const std::string& more = "") {
  const ClockResult result = run_clock(parse_case(std::string(kCase) + more + kLoads, "a.toml").spec, {}, options);
  const LifeRow* first = shortest(result.lives);
  return first ? first->mgt.best : std::numeric_limits<double>::infinity();
}

struct Change {
  const char* name;
  void (*make)(ClockOptions&);
};

TEST(SlowClock, ALifeHardlyDependsOnTheNumbersOfTheMethod) {
  const double one = life(usual());
  ASSERT_TRUE(one > 0.1 && one < 2.5) << one;
  for (const Change& change : {Change{"columns", [](ClockOptions& o) { o.apart = 0.25e-3; }},
                               Change{"first row", [](ClockOptions& o) { o.first_row = 0.05e-3; }},
                               Change{"steps of the metal", [](ClockOptions& o) { o.growth = 2; }},
                               Change{"settling", [](ClockOptions& o) { o.settle.tolerance = 0.01; }},
                               Change{"stretches", [](ClockOptions& o) { o.change = 0.1; }},
                               Change{"steps of wear", [](ClockOptions& o) { o.max_wear = 0.005e-3; }},
                               Change{"coarse cells", [](ClockOptions& o) { o.bem.cell = 1e-3; }},
                               Change{"fine cells", [](ClockOptions& o) { o.bem.cell = 0.25e-3; }}}) {
    ClockOptions options = usual();
    change.make(options);
    EXPECT_NEAR(life(options) / one, 1, 0.1) << change.name;
  }
  EXPECT_NEAR(life(usual(), "window = 8\n") / one, 1, 0.1) << "window";
  EXPECT_NEAR(life(usual(), "patch_cells = 8\n") / one, 1, 0.1) << "stations";
  EXPECT_NEAR(life(usual(), "patch_cells = 12\n") / one, 1, 0.1) << "stations";
}

}  // namespace
}  // namespace railstrata
