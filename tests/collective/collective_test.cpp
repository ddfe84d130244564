#include "collective/collective.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <utility>

#include "ask/answer.hpp"
#include "collective/collective_errors.hpp"
#include "collective/collective_files.hpp"
#include "collective/measured_wear.hpp"
#include "core/faults.hpp"
#include "geometry/profile_names.hpp"
#include "reader/case_file.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

constexpr const char* kArcs =
    "[geometry]\nrail_profile = \"arc:R=80 mm\"\nwheel_profile = \"arc:R=-400 mm\"\ncant = 0\n"
    "[drive]\ntraction_coefficient = 0.1\nspin = \"0 1/m\"\n";

CollectiveOptions coarse() {
  CollectiveOptions options;
  options.bem.cell = 1e-3;
  return options;
}

std::vector<CollectiveRow> solved(const CaseSpec& spec) {
  std::vector<CollectiveRow> rows = plan_collective(spec);
  solve_collective(rows, {}, coarse());
  return rows;
}

}  // namespace

TEST(Collective, ARowThatCannotBeSolvedIsToldAndTheOthersGoOn) {
  const CaseSpec spec = parse_case(std::string(kArcs) +
                                       "[[load]]\npassages = 10\n[[load]]\nname = \"beside the rail\"\n"
                                       "lateral_shift = \"50 mm\"\n[[load]]\npassages = 20\nwheel_load = \"60 kN\"\n",
                                   "a.toml")
                            .spec;
  const std::vector<CollectiveRow> rows = solved(spec);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].fault, "");
  EXPECT_EQ(rows[2].fault, "");
  EXPECT_NE(rows[1].fault, "");
  EXPECT_FALSE(rows[1].solved());
  EXPECT_EQ(faults(rows), 1);
  const Placement placement = place(spec, {});
  const auto json =
      collective_json("t", rows, {rail_damage(rows, placement, 0.5e-3), wheel_damage(rows, placement, 0.5e-3)});
  EXPECT_EQ(json["totals"]["passages"], 30);
  EXPECT_EQ(json["totals"]["passages_left_out"], 1);
  EXPECT_EQ(json["loads"][1]["name"], "beside the rail");
}

// Three wheels, on cells of 0.5 mm and, as truth, of half of that.
TEST(Collective, AnswersOnCellsHalfAsLargeLieWithinTheBars) {
  const CaseSpec spec = parse_case(std::string(kArcs) +
                                       "[material.rail]\nyield_strength = \"300 MPa\"\n[[load]]\npassages = 1e4\n"
                                       "wheel_load = \"60 kN\"\n[[load]]\npassages = 100\nwheel_load = \"20 kN\"\n"
                                       "lateral_shift = \"3 mm\"\n[[load]]\nname = \"heavy\"\npassages = 10\n"
                                       "wheel_load = \"80 kN\"\n",
                                   "a.toml")
                            .spec;
  const Placement placement = place(spec, {});
  const auto answered = [&](double cell, std::vector<CollectiveRow>& rows, CollectiveOptions& options) {
    options.bem.cell = cell;
    rows = plan_collective(spec);
    solve_collective(rows, {}, options);
    CollectiveDamage out{rail_damage(rows, placement, cell), wheel_damage(rows, placement, cell)};
    out.lives = collective_lives(spec, rows, out.rail, out.wheel);
    return out;
  };
  std::vector<CollectiveRow> rows, finer;
  CollectiveOptions options, fine;
  CollectiveDamage damage = answered(0.5e-3, rows, options), truth = answered(0.25e-3, finer, fine);
  EXPECT_EQ(deciding_loads(rows), (std::vector<std::size_t>{0, 2})) << "the most energy; the largest pressure";
  damage.error = collective_errors(spec, rows, damage, placement, {}, options);
  ASSERT_TRUE(damage.error.is_object());
  const auto here = collective_numbers(rows, damage), there = collective_numbers(finer, truth);
  for (const char* place : {"/totals/friction_energy_J_m", "/totals/usfd_area_m2", "/totals/usfd_deepest/depth_m",
                            "/totals/usfd_deepest/rail_y_m", "/totals/rcf_damage_largest/damage",
                            "/totals/largest_pressure/p_max_Pa", "/worst_shakedown/wandering"}) {
    const nlohmann::ordered_json::json_pointer at(place);
    const double bar = damage.error.at(at).get<double>(), value = here.at(at).get<double>();
    EXPECT_LE(std::abs(value - there.at(at).get<double>()), bar) << place;
    EXPECT_LT(bar, 0.3 * std::abs(value) + 3e-3) << place;
  }
  const std::vector<ReportAnswer> answers = collective_answers(rows, damage);
  EXPECT_GE(std::count_if(answers.begin(), answers.end(),
                          [](const ReportAnswer& a) { return a.text.find(" ± ") != std::string::npos; }),
            3);
  EXPECT_TRUE(collective_errors(spec, plan_collective(spec), damage, placement, {}, options).is_null())
      << "nothing solved";
}

// A layer of t lasts t over the depth that a collective wears, grinding of t at once ends it, in MGT of 2 F/g a wheel.
TEST(Collective, ALayerWornThroughHasItsLifeInGrossTonnes) {
  const auto life = [](const char* more) {
    const CaseSpec spec =
        parse_case(std::string(kArcs) + "[[layer]]\nname = \"clad\"\nthickness = \"0.1 mm\"\nyoung_ratio = 1.2\n" +
                       more + "[[load]]\npassages = 1e4\nwheel_load = \"60 kN\"\n",
                   "a.toml")
            .spec;
    const std::vector<CollectiveRow> rows = solved(spec);
    const Placement placement = place(spec, {});
    const RailDamage damage = rail_damage(rows, placement, 0.5e-3);
    const Lives lives = collective_lives(spec, rows, damage, wheel_damage(rows, placement, 0.5e-3));
    const double mgt = 1e4 * 2e-9 * rows[0].summary.contact.F_z / kGravity;
    for (const LifeRow& row : lives.rows)
      if (row.mechanism == "worn through") {
        const std::vector<double> wear = smoothed_wear(damage, WearLaw::usfd);
        return std::pair{row.mgt.best, mgt * 0.1e-3 / *std::max_element(wear.begin(), wear.end())};
      }
    return std::pair{0.0, 1.0};
  };
  const auto [worn, expected] = life("");
  EXPECT_NEAR(worn / expected, 1, 1e-9);
  EXPECT_NEAR(life("[grinding]\nevery = \"0.01 Mt\"\ndepth = \"0.2 mm\"\n").first, 0.01, 1e-9);
}

// The wheels of a row run aside by a normal distribution: the sum stays, the variance grows by theirs, which the cut at
// three deviations takes 2.7 % off.
TEST(Collective, WheelsThatRunAsideSpreadTheirWear) {
  const auto wear_of = [](const char* more) {
    const CaseSpec spec =
        parse_case(std::string(kArcs) + more + "[[load]]\npassages = 1e4\nwheel_load = \"60 kN\"\n", "a.toml").spec;
    const RailDamage damage = rail_damage(solved(spec), place(spec, {}), 0.25e-3);
    double sum = 0, mean = 0, square = 0;
    for (std::size_t k = 0; k < damage.s.size(); ++k) {
      sum += damage.usfd[k];
      mean += damage.usfd[k] * damage.s[k];
      square += damage.usfd[k] * damage.s[k] * damage.s[k];
    }
    return std::array{sum, mean / sum, square / sum - mean * mean / (sum * sum)};
  };
  const auto straight = wear_of(""), aside = wear_of("[collective]\nlateral_deviation = \"4 mm\"\n");
  EXPECT_NEAR(aside[0] / straight[0], 1, 1e-9);
  EXPECT_NEAR(aside[1], straight[1], 1e-6);
  EXPECT_NEAR((aside[2] - straight[2]) / (0.973 * 16e-6), 1, 0.01);
}

// Dang Van's line with the exponent k: the low life has strengths two deviations lower and a third of Miner's sum.
TEST(Collective, TheRangeOfALifeHasTheScatterOfStrengths) {
  const auto life = [](const char* more) {
    const CaseSpec spec = parse_case(std::string(kArcs) +
                                         "[material.rail]\nyield_strength = \"2000 MPa\"\nfatigue_limit = \"100 MPa\"\n"
                                         "dang_van_coefficient = 0.1\nfatigue_exponent = 6\n" +
                                         more + "[[load]]\npassages = 1e4\nwheel_load = \"60 kN\"\n",
                                     "a.toml")
                              .spec;
    const std::vector<CollectiveRow> rows = solved(spec);
    const Placement placement = place(spec, {});
    const Lives lives =
        collective_lives(spec, rows, rail_damage(rows, placement, 0.5e-3), wheel_damage(rows, placement, 0.5e-3));
    for (const LifeRow& row : lives.rows)
      if (row.body == "rail" && row.place == "below" && row.mechanism == "fatigue") return row;
    return LifeRow{};
  };
  const LifeRow given = life(""), scattered = life("[life]\nstrength_scatter = 0.05\n");
  ASSERT_TRUE(given.known() && std::isfinite(given.wheels.best));
  EXPECT_DOUBLE_EQ(scattered.wheels.best, given.wheels.best);
  EXPECT_NEAR(scattered.wheels.low / given.wheels.low, std::pow(0.9, 6), 1e-3);
  EXPECT_NE(scattered.rests_on.find("strengths ± 10 %"), std::string::npos) << scattered.rests_on;
  EXPECT_GT(life("[collective]\nlateral_deviation = \"6 mm\"\n").wheels.best, 1.3 * given.wheels.best);
}

TEST(Collective, NamesTheLoadThatDecidesAndDoubtsTheWearOfOneProfile) {
  const auto answers = [](const char* passages) {
    std::string text = kArcs;
    text +=
        "[material.rail]\nhardness = \"280 HV\"\nyield_strength = \"400 MPa\"\n"
        "[[load]]\nname = \"light\"\nwheel_load = \"20 kN\"\npassages = 1\n"
        "[[load]]\nname = \"heavy\"\nwheel_load = \"90 kN\"\npassages = ";
    text += passages;
    const CaseSpec spec = parse_case(text, "a.toml").spec;
    const std::vector<CollectiveRow> rows = solved(spec);
    return collective_answers(rows, {rail_damage(rows, place(spec, {}), 0.5e-3), {}});
  };
  const std::vector<ReportAnswer> few = answers("1000");
  ASSERT_EQ(few.size(), 2u);
  EXPECT_EQ(few[0].title, "Does not last");
  EXPECT_TRUE(few[0].text.starts_with("load \"heavy\", rail, ")) << few[0].text;
  EXPECT_EQ(few[1].tone, "plain") << few[1].text;
  EXPECT_EQ(answers("1e8").back().tone, "open") << "millimetres";
}

TEST(Collective, AnswersGiveWearAndTheFirstCrackByGrossTonnes) {
  const CaseSpec spec = parse_case(std::string(kArcs) +
                                       "[[load]]\nwheel_load = \"50 kN\"\npassages = 1e5\n"
                                       "traction_coefficient = 0.1\n",
                                   "a.toml")
                            .spec;
  const std::vector<CollectiveRow> rows = solved(spec);
  CollectiveDamage damage{rail_damage(rows, place(spec, {}), 0.5e-3), {}, {}};
  damage.lives.tonnes = 2e6;
  damage.rail.rcf_damage.front() = 0.25;  // more than any other cell has
  const std::vector<ReportAnswer> answers = collective_answers(rows, damage);
  ASSERT_EQ(answers.size(), 2u);
  EXPECT_TRUE(answers[0].text.ends_with("a visible crack: after 8 MGT")) << answers[0].text;
  const std::vector<double> wear = smoothed_wear(damage.rail, WearLaw::usfd);
  const double deepest = *std::max_element(wear.begin(), wear.end());
  EXPECT_NE(answers[1].text.find(fmt::format(", {:.3g} mm per 100 MGT at y", 50 * 1e3 * deepest)), std::string::npos)
      << answers[1].text;
}

TEST(Collective, PutsTheVehicleCodesForcesBesideItsOwn) {
  const auto answer = [](const char* given) {
    const CaseSpec spec =
        parse_case(std::string(kArcs) + "[[load]]\npassages = 1\nwheel_load = \"60 kN\"\n" + given, "a.toml").spec;
    const std::vector<CollectiveRow> rows = solved(spec);
    const std::vector<ReportAnswer> all =
        collective_answers(rows, {rail_damage(rows, place(spec, {}), 0.5e-3), {}, {}});
    return std::pair{all.back(), rows[0].summary};
  };
  const auto [far, own] = answer("t_gamma = \"1 kN\"\n");
  EXPECT_EQ(far.title, "Comparison with the vehicle code");
  EXPECT_EQ(far.tone, "open");
  EXPECT_EQ(far.text, fmt::format("mean of the wheels: T-gamma {:.3g} N here, 1000 N there", own.damage.t_gamma));
  const std::string same = fmt::format("guiding_force = \"{} N\"\n", -own.contact.F_y);
  EXPECT_EQ(answer(same.c_str()).first.tone, "plain");
  EXPECT_EQ(answer("").first.title, "Wear");
}

// Tread and flange touch: 0.1 mm of the shift change the guiding force by 1.6 kN. And a
// force that no shift has.
TEST(Collective, MovesTheShiftUntilTheWheelHasTheGuidingForce) {
  const auto row = [](const char* shift, const std::string& force) {
    const CaseSpec spec =
        parse_case(
            std::string("[geometry]\nrail_profile = \"UIC60\"\nwheel_profile = \"S1002\"\ncant = "
                        "\"1:40\"\nyaw = \"1 mrad\"\n[drive]\ntraction_coefficient = 0\nfriction_coefficient = 0.1\n"
                        "[collective]\nmatch_guiding_force = true\n[[load]]\n"
                        "wheel_load = \"73 kN\"\nlateral_shift = \"") +
                shift + "\"\n" + force,
            "a.toml")
            .spec;
    return solved(spec).front();
  };
  const double there = -row("5.05 mm", "").summary.contact.F_y;
  const CollectiveRow matched = row("4.95 mm", fmt::format("guiding_force = \"{} N\"\n", there));
  EXPECT_NEAR(-matched.summary.contact.F_y, there, 0.01 * 73e3);
  EXPECT_GT(matched.moved, 10e-6);
  EXPECT_LE(matched.moved, 200e-6);
  EXPECT_DOUBLE_EQ(matched.spec.geometry.lateral_shift, 4.95e-3 + matched.moved);
  const CollectiveRow out_of_reach = row("4.95 mm", "guiding_force = \"-50 kN\"\n");
  EXPECT_TRUE(std::isnan(out_of_reach.moved));
  EXPECT_DOUBLE_EQ(out_of_reach.spec.geometry.lateral_shift, 4.95e-3);
}

TEST(Collective, TheWearFactorMultipliesTheWearOfBothBodies) {
  const auto worn = [](const char* more) {
    const CaseSpec spec = parse_case(std::string(kArcs) + more + "[[load]]\npassages = 10\n", "a.toml").spec;
    const std::vector<CollectiveRow> rows = solved(spec);
    const Placement placement = place(spec, {});
    const RailDamage rail = rail_damage(rows, placement, 0.5e-3);
    const WheelDamage wheel = wheel_damage(rows, placement, 0.5e-3);
    return std::array{worn_area(rail, rail.usfd), worn_area(wheel, wheel.usfd), streamline_area(rows, WearLaw::usfd)};
  };
  const std::array given = worn(""), fifth = worn("[collective]\nwear_factor = 0.2\n");
  for (std::size_t k = 0; k < given.size(); ++k) EXPECT_NEAR(fifth[k] / given[k], 0.2, 1e-12);
}

TEST(Collective, SumsTheRowsTimesTheirPassages) {
  const CaseSpec spec = parse_case(std::string(kArcs) +
                                       "[material.rail]\nhardness = \"280 HV\"\n"
                                       "[[load]]\npassages = 10\n[[load]]\npassages = 20\n"
                                       "[[load]]\npassages = 5\nlateral_shift = \"4 mm\"\n",
                                   "a.toml")
                            .spec;
  const std::vector<CollectiveRow> rows = solved(spec);
  ASSERT_EQ(faults(rows), 0);
  const RailDamage damage = rail_damage(rows, place(spec, {}), 0.5e-3);
  for (const WearLaw law : {WearLaw::usfd, WearLaw::kth})
    EXPECT_NEAR(worn_area(damage, damage.depth(law)) / streamline_area(rows, law), 1, 1e-9);
  double energy = 0;
  for (const CollectiveRow& r : rows) energy += r.passages * r.summary.damage.friction_energy;
  EXPECT_NEAR(worn_area(damage, damage.friction_energy) / energy, 1, 1e-9);
  EXPECT_DOUBLE_EQ(rows[0].summary.damage.usfd_depth, rows[1].summary.damage.usfd_depth);
}

// A wheel and a rail of one material lose the same volume; twice the hardness, half the depth.
TEST(Collective, AWheelLosesOverADistanceWhatTheRailLosesBelowIt) {
  const CaseSpec spec = parse_case(std::string(kArcs) +
                                       "[material.rail]\nhardness = \"280 HV\"\n[material.wheel]\nhardness = \"560 "
                                       "HV\"\n[[load]]\npassages = 3\n[[load]]\nlateral_shift = \"4 mm\"\n",
                                   "a.toml")
                            .spec;
  const std::vector<CollectiveRow> rows = solved(spec);
  ASSERT_EQ(faults(rows), 0);
  const WheelDamage wheel = wheel_damage(rows, place(spec, {}), 0.5e-3);
  const double turn = 2 * std::numbers::pi * spec.geometry.wheel_radius;
  const DamageSummary& damage = rows[0].summary.damage;
  EXPECT_NEAR(turn * worn_area(wheel, wheel.usfd) / (streamline_area(rows, WearLaw::usfd) / 4),
              damage.wheel_steel.factor / damage.rail_steel.factor, 1e-3);
  EXPECT_NEAR(turn * worn_area(wheel, wheel.kth) / (0.5 * streamline_area(rows, WearLaw::kth) / 4), 1, 2e-3);
  EXPECT_TRUE(std::isnan(worn_area(wheel, wheel.archard)));
}

TEST(Collective, WheelsShiftedAlikeToEitherSideWearSymmetrically) {
  const CaseSpec spec = parse_case(std::string(kArcs) +
                                       "[[load]]\npassages = 7\nlateral_shift = \"3 mm\"\n"
                                       "[[load]]\npassages = 7\nlateral_shift = \"-3 mm\"\n",
                                   "a.toml")
                            .spec;
  const RailDamage damage = rail_damage(solved(spec), place(spec, {}), 0.5e-3);
  const std::size_t n = damage.s.size();
  double largest = 0;
  for (const double d : damage.usfd) largest = std::max(largest, d);
  ASSERT_GT(largest, 0);
  for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(damage.usfd[i], damage.usfd[n - 1 - i], 1e-3 * largest) << i;
}

TEST(Collective, NeedsRowsAndRolling) {
  EXPECT_THROW(plan_collective(parse_case("", "a.toml").spec), CaseError);
  EXPECT_THROW(plan_collective(parse_case("[run]\nrolling = false\n[[load]]\n", "a.toml").spec), CaseError);
}

// A row's own wheel wears the rail as that wheel does, and the wheel where it touches, by its distance from the tape
// circle.
TEST(Collective, AWheelOfARowIsThatOfACaseWithIt) {
  const auto with = [](const char* wheel, const char* row) {
    return parse_case(std::string("[geometry]\nrail_profile = \"UIC60\"\ncant = \"1:40\"\nwheel_profile = \"") + wheel +
                          "\"\nwheel_radius = \"460 mm\"\nback_to_back = \"1360 mm\"\ngauge = \"1435 mm\"\n"
                          "gauge_depth = \"14 mm\"\n[[load]]\npassages = 4\nyaw = \"2 mrad\"\n" +
                          row,
                      "a.toml")
        .spec;
  };
  const CaseSpec own = with("LMA", "wheel_profile = \"S1002\"\n"), plain = with("S1002", "");
  const std::vector<CollectiveRow> rows = solved(own), same = solved(plain);
  ASSERT_EQ(rows[0].fault, "");
  ASSERT_EQ(same[0].fault, "");
  EXPECT_DOUBLE_EQ(streamline_area(rows, WearLaw::usfd), streamline_area(same, WearLaw::usfd));
  const WheelDamage of_row = wheel_damage(rows, place(own, {}), 0.5e-3),
                    of_case = wheel_damage(same, place(plain, {}), 0.5e-3);
  EXPECT_NEAR(worn_area(of_row, of_row.usfd) / worn_area(of_case, of_case.usfd), 1, 1e-9);
  const auto deepest = [](const WheelDamage& d) {
    return d.y[static_cast<std::size_t>(std::max_element(d.usfd.begin(), d.usfd.end()) - d.usfd.begin())];
  };
  EXPECT_NEAR(deepest(of_row), deepest(of_case), 0.6e-3);
}

// Half the computed wear taken off the rail, which was turned and moved before it was measured again.
TEST(Collective, TheMeasuredFactorIsThatOfTheMetalThatIsGone) {
  constexpr double kHalf = 0.5, kTurn = 2e-3, kShift = 0.3e-3;
  const CaseSpec spec = parse_case(
                            "[geometry]\nwheel_profile = \"S1002\"\nrail_profile = \"UIC60\"\ncant = \"1:40\"\n"
                            "wheel_radius = \"460 mm\"\n[collective]\nwear_factor = 0.2\nlateral_deviation = \"1 mm\"\n"
                            "[[load]]\npassages = 4e6\nyaw = \"2 mrad\"\nlateral_shift = \"2 mm\"\n",
                            "a.toml")
                            .spec;
  const std::vector<CollectiveRow> rows = solved(spec);
  ASSERT_EQ(rows[0].fault, "");
  const RailDamage damage = rail_damage(rows, place(spec, {}), 0.5e-3);
  const Profile rail = builtin_profile(ProfileKind::rail, "UIC60");
  const TemporaryFolder folder;
  std::ofstream before(folder.path() / "before.csv"), after(folder.path() / "after.csv");
  for (std::size_t i = 0; i < damage.s.size(); ++i) {
    const ProfilePoint p = rail.at(damage.s[i]);
    const Vec2 at = p.position - kHalf * damage.usfd[i] * p.outward;
    before << fmt::format("{:.7f} {:.7f}\n", 1e3 * p.position.y, 1e3 * p.position.z);
    after << fmt::format("{:.7f} {:.7f}\n", 1e3 * (at.y - kTurn * at.z + kShift), 1e3 * (at.z + kTurn * at.y));
  }
  before.close();
  after.close();
  const double tonnes = 4e6 * gross_tonnes(rows[0].summary.contact.F_z);
  const auto measured = [&](double of) {
    return measured_wear(rows, damage, folder.path() / "before.csv", folder.path() / "after.csv", of);
  };
  const MeasuredWear found = measured(tonnes);
  EXPECT_NEAR(found.factor(), kHalf, 0.02);
  EXPECT_NEAR(found.factor(), kHalf, 4 * found.factor_error() + 1e-3);
  EXPECT_NEAR(measured(2 * tonnes).factor(), kHalf / 2, 0.01) << "the same metal by twice the traffic";
  EXPECT_NE(measured_text(found).find("write wear_factor = 0.1 into [collective]"), std::string::npos)
      << measured_text(found);
  EXPECT_THROW(measured_wear(rows, damage, folder.path() / "after.csv", folder.path() / "before.csv", tonnes),
               CaseError);
}

}  // namespace railstrata
