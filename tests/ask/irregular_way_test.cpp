// Half-spaces that roll over heights of the rail and of the wheel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "ask/answer.hpp"
#include "core/faults.hpp"
#include "reader/case_file.hpp"

namespace railstrata {
namespace {

/// A cylinder of 430 mm on a crown of 300 mm, and real pairs, steel on steel.
const std::string kCrown =
    "rail_profile = \"arc:R=300 mm\"\nwheel_profile = \"flat\"\nwheel_radius = \"430 mm\"\n"
    "wheel_shape = \"disc\"\nbore_radius = \"20 mm\"\ncant = 0.0\n";
const std::string kWays[] = {kCrown, "rail_profile = \"CN60\"\nwheel_profile = \"LMA\"\n",
                             "rail_profile = \"UIC60\"\nwheel_profile = \"S1002\"\nlateral_shift = \"2 mm\"\n"};

/// Under 85 kN; real pairs with hardly any friction, whose lateral part bears a share of the load and has a direction.
std::string pressed(const std::string& geometry, const std::string& more) {
  return "[geometry]\n" + geometry +
         "[vehicle]\nwheel_mass = \"1 kg\"\nwheel_load = \"85 kN\"\n[drive]\ntraction_coefficient = 0.0\n" +
         (geometry == kCrown ? "" : "friction_coefficient = 1e-9\n") + more;
}
std::string crown(const std::string& more) { return pressed(kCrown, more); }

std::vector<TransientRow> roll(const std::string& more, double cell = 0.5e-3, const std::string& geometry = kCrown) {
  const std::string rolling = "[transient]\nkind = \"rolling\"\ndistance = \"40 mm\"\n";
  const CaseSpec spec = parse_case(pressed(geometry, rolling + more), "a.toml").spec;
  BemOptions options;
  options.cell = cell;
  return solve_contact(spec, place(spec, {}), {.bem = options}).history;
}

const std::string kHollow = "[[irregularity]]\nat = \"20 mm\"\nlength = \"20 mm\"\ndepth = \"0.2 mm\"\n";

/// Independent half-spaces, conjugate gradients on a grid of 0.25 and 0.5 mm: good to 0.3 % and 0.1 um.
struct Reference {
  double before, p_max, lowering;  ///< mm before the middle, MPa, um
};
constexpr Reference kOfHollow[] = {{15, 1200, 94.8}, {12, 1507, 98.5},   {10, 1737, 105.0}, {8, 1888, 115.5},
                                   {3, 2033, 164.4}, {1.5, 1900, 173.9}, {0, 1602, 175.5}};

TEST(IrregularWay, AHollowIsBridgedAsIndependentHalfSpacesHaveIt) {
  const std::vector<TransientRow> rows = roll(kHollow);
  ASSERT_EQ(rows.size(), 81u);
  for (const Reference& r : kOfHollow)
    for (const int side : {-1, 1}) {
      const TransientRow& row = rows[static_cast<std::size_t>(40 + std::lround(2 * side * r.before))];
      const double tolerance = r.before >= 8 && r.before <= 12 ? 0.02 : 0.01;
      EXPECT_NEAR(row.p_max, 1e6 * r.p_max, tolerance * 1e6 * r.p_max) << side * r.before;
      EXPECT_NEAR(row.approach, 1e-6 * r.lowering, 0.3e-6) << side * r.before;
    }
}

// Equal materials: the pressure knows nothing of friction, which alone has a direction.
TEST(IrregularWay, BeforeAndBehindTheMiddleAreAlike) {
  for (const std::string& geometry : kWays) {
    const std::vector<TransientRow> rows = roll(kHollow, 1e-3, geometry);
    for (std::size_t k = 0; k < 20; ++k) {
      EXPECT_NEAR(rows[k].p_max, rows[40 - k].p_max, 1e-6 * rows[k].p_max) << geometry << k;
      EXPECT_NEAR(rows[k].approach, rows[40 - k].approach, 1e-6 * rows[k].approach) << geometry << k;
    }
  }
}

TEST(IrregularWay, OverItsMiddleThePatchIsTwo) {
  const CaseSpec spec = parse_case(crown("[run]\nrolling = false\n[[irregularity]]\nat = \"0 mm\"\nlength = \"20 mm\"\n"
                                         "depth = \"0.2 mm\"\n"),
                                   "a.toml")
                            .spec;
  BemOptions options;
  options.cell = 0.5e-3;
  const Answer s = solve_contact(spec, place(spec, {}), {.bem = options});
  const ContactField& f = s.result.field;
  int begins = 0, cells = 0;
  double before = 0;
  for (int i = 0; i < f.stations; ++i) {
    const double p = f.p[static_cast<std::size_t>(i * f.columns + f.columns / 2)];
    begins += p > 0 && !(before > 0);
    cells += p > 0;
    before = p;
  }
  EXPECT_EQ(begins, 2);
  EXPECT_NEAR(0.5 * cells, 2 * 5.2, 1.0) << "of 5.2 mm each, a cell for each of two";
  EXPECT_NEAR(s.result.approach, 175.5e-6, 0.3e-6) << "at rest as on the way";
}

// A wheel that rolls onto a rail that lies higher meets, backwards, what one meets that rolls off it.
TEST(IrregularWay, AStepUpIsAStepDownBackwards) {
  for (const std::string& geometry : kWays) {
    const auto over = [&](const char* height) {
      return roll(
          std::string("[[irregularity]]\nkind = \"step\"\nat = \"20 mm\"\nlength = \"10 mm\"\nheight = ") + height,
          1e-3, geometry);
    };
    const std::vector<TransientRow> up = over("\"0.1 mm\"\n"), down = over("\"-0.1 mm\"\n");
    ASSERT_EQ(up.size(), 41u);
    for (std::size_t k = 0; k < up.size(); ++k) {
      EXPECT_NEAR(up[k].p_max, down[40 - k].p_max, 1e-6 * up[k].p_max) << geometry << k;
      EXPECT_NEAR(up[k].approach, down[40 - k].approach - 0.1e-3, 1e-9) << geometry << k << ": what goes up comes down";
    }
    EXPECT_GT(up[20].p_max, 1.3 * up.front().p_max) << geometry;
  }
}

// The wheel's arc meets the rail's way.
TEST(IrregularWay, OnTheWheelItIsTheSameAsOnTheRail) {
  for (const std::string& geometry : kWays) {
    const std::vector<TransientRow> rail = roll(kHollow, 1e-3, geometry),
                                    wheel = roll(kHollow + "on = \"wheel\"\n", 1e-3, geometry);
    ASSERT_EQ(rail.size(), wheel.size());
    for (std::size_t k = 0; k < rail.size(); ++k)
      EXPECT_NEAR(rail[k].p_max, wheel[k].p_max, 1e-9 * rail[k].p_max) << geometry << k;
  }
}

TEST(IrregularWay, CorrugationMovesTheWheelByLessThanItsHeight) {
  const std::vector<TransientRow> rows =
      roll("[[irregularity]]\nkind = \"corrugation\"\nat = \"20 mm\"\nwavelength = \"40 mm\"\ndepth = \"20 um\"\n");
  EXPECT_NEAR(rows[40].p_max, 1234.8e6, 0.01 * 1234.8e6) << "crest";
  EXPECT_NEAR(rows[40].approach, 86.16e-6, 0.3e-6);
  EXPECT_NEAR(rows[0].p_max, 1157.9e6, 0.01 * 1157.9e6) << "trough";
  EXPECT_NEAR(rows[0].approach, 102.79e-6, 0.3e-6);
}

TEST(IrregularWay, WhatCannotBeComputedIsRefused) {
  const auto refusal = [](const std::string& more, double cell) -> std::string {
    try {
      const CaseSpec spec = parse_case(crown(more), "a.toml").spec;
      BemOptions options;
      options.cell = cell;
      solve_contact(spec, place(spec, {}), {.bem = options});
    } catch (const CaseError& e) {
      return e.what();
    }
    return "taken";
  };
  const std::string rolling = "[transient]\nkind = \"rolling\"\ndistance = \"40 mm\"\n";
  EXPECT_NE(refusal(kHollow, 1e-3).find("steady rolling of half-spaces"), std::string::npos);
  EXPECT_NE(refusal(rolling + kHollow, 4e-3).find("fewer than 6"), std::string::npos);
  const std::string track = "[track]\npreset = \"delft\"\n";
  for (const std::string& more : {track, rolling + track})
    EXPECT_NE(refusal(more, 1e-3).find("(track.preset) is not supported by half-spaces"), std::string::npos) << more;
  EXPECT_NE(
      refusal(rolling + "start = \"steady\"\n[[irregularity]]\nat = \"2 mm\"\nlength = \"20 mm\"\ndepth = \"0.1 mm\"\n",
              1e-3)
          .find("nothing rolls steadily"),
      std::string::npos);
}

}  // namespace
}  // namespace railstrata
