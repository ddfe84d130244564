#include "clock/clock.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "clock/clock_lives.hpp"
#include "clock/wheel_life.hpp"
#include "core/faults.hpp"
#include "reader/case_file.hpp"

namespace railstrata {
namespace {

/// A rail that does not yield and has a sigma-N line; nothing rubs.
std::string fatigued(const std::string& loads) {
  return "[geometry]\nrail_profile = \"arc:R=80 mm\"\nwheel_profile = \"arc:R=-400 mm\"\ncant = 0\n"
         "[material.rail]\nyield_strength = \"3000 MPa\"\nfatigue_limit = \"100 MPa\"\ndang_van_coefficient = 0.23\n"
         "fatigue_exponent = 8\n[drive]\ntraction_coefficient = 0\nfriction_coefficient = 0\nspin = \"0 1/m\"\n" +
         loads;
}

ClockResult run(const std::string& text, double mgt) {
  ClockOptions options;
  options.bem.cell = 1e-3;
  options.horizon = 1e9 * mgt;
  return run_clock(parse_case(text, "a.toml").spec, {}, options);
}

const LifeRow& row_of(const ClockResult& result, const std::string& mechanism, const std::string& place) {
  for (const LifeRow& row : result.lives)
    if (row.mechanism == mechanism && row.place == place) return row;
  throw CaseError("no such row: " + mechanism, place);
}

constexpr const char* kOne = "[[load]]\nname = \"a\"\npassages = 1000\nwheel_load = \"100 kN\"\n";
constexpr const char* kCut =
    "[[load]]\nname = \"a\"\npassages = 300\nwheel_load = \"100 kN\"\n"
    "[[load]]\nname = \"b\"\npassages = 700\nwheel_load = \"100 kN\"\n";

// Nothing wears and nothing flows: Miner's sum of one stress is one after the cycles of its sigma-N line.
TEST(Clock, WithoutWearAndFlowALifeIsThatOfTheLine) {
  const ClockResult one = run(fatigued(kOne), 1000);
  const LifeRow& row = row_of(one, "fatigue", "below");
  ASSERT_TRUE(std::isfinite(row.mgt.best));
  EXPECT_NEAR(row.mgt.best / row.mgt.low, 3, 1e-6) << "Miner's sum of 1/3; both lines are the same above the limit";
  // the same from the collective's own damage (lives/zone_life.hpp), between the depths of another table
  const CaseSpec spec = parse_case(fatigued(kOne), "a.toml").spec;
  std::vector<CollectiveRow> rows = plan_collective(spec);
  CollectiveOptions how;
  how.bem.cell = 1e-3;
  solve_collective(rows, {}, how);
  const Placement placement = place(spec, {});
  const Lives lives =
      collective_lives(spec, rows, rail_damage(rows, placement, 1e-3), wheel_damage(rows, placement, 1e-3));
  for (const LifeRow& other : lives.rows) {
    if (other.body != "rail" || other.mechanism != "fatigue" || other.place != "below") continue;
    EXPECT_NEAR(row.mgt.best / other.mgt.best, 1, 0.1);
  }
}

TEST(Clock, ARowThatIsCutGivesTheSameBits) {
  const ClockResult one = run(fatigued(kOne), 1000), cut = run(fatigued(kCut), 1000);
  EXPECT_EQ(row_of(one, "fatigue", "below").mgt.best, row_of(cut, "fatigue", "below").mgt.best);
}

TEST(Clock, GrindingTakesAwayWhatItReaches) {
  const std::string grinding = "[grinding]\nevery = \"1 Mt\"\ndepth = \"0.5 mm\"\n";
  const ClockResult out = run(fatigued(kOne) + grinding, 6);
  ASSERT_FALSE(out.history.empty());
  EXPECT_NEAR(out.history.back().removed, 6 * 0.5e-3, 1e-9);
  EXPECT_NEAR(out.history.back().kilograms, 6e9, 1);
}

TEST(Clock, WithoutAHorizonNothingIsFollowed) {
  const ClockResult out = run(fatigued(kOne), 0.001);
  EXPECT_TRUE(std::isinf(row_of(out, "fatigue", "below").mgt.best));
  const LifeRow& row = row_of(out, "fatigue", "below");
  EXPECT_EQ(range_text(row.mgt, row.followed).rfind("> 0.001", 0), 0u) << range_text(row.mgt, row.followed);
  EXPECT_NE(life_text(out.lives).find("no failure in the known modes within 0.001 MGT"), std::string::npos);
  EXPECT_NE(row_of(out, "fatigue", "below").rests_on.find("followed to 0.001 MGT"), std::string::npos);
}

// bem, sweep and study give the life of their one load: that of a collective of it.
// Used shares 0, 0.4 and 1.2 after 0, 10 and 20 MGT: between the last two 0.8 of a ductility of 5 after 15.
TEST(Clock, ADateOfFirstCracksNamesTheDuctilityThatGivesIt) {
  std::vector<ClockMoment> history(3);
  history[1].kilograms = 10e9;
  history[1].ductility = 0.4;
  history[2].kilograms = 20e9;
  history[2].ductility = 1.2;
  CaseSpec spec;
  EXPECT_EQ(fitted_ductility(spec, history), "");
  spec.life.first_cracks = 15e9;
  EXPECT_NE(fitted_ductility(spec, history).find("give passes.ductility"), std::string::npos);
  spec.passes.ductility = 5;
  EXPECT_NE(fitted_ductility(spec, history).find("passes.ductility = 4 gives this"), std::string::npos);
  spec.life.first_cracks = 21e9;
  EXPECT_NE(fitted_ductility(spec, history).find("not followed so far"), std::string::npos);
  history[1].ductility = history[2].ductility = 0;
  spec.life.first_cracks = 20e9;
  EXPECT_NE(fitted_ductility(spec, history).find("no metal has yielded"), std::string::npos);
}

TEST(Clock, ItSaysThatAllWheelsWearOneTrack) {
  EXPECT_EQ(one_track(0), "") << "nothing wears";
  EXPECT_NE(one_track(1e-4).find("run in one track (100 µm)"), std::string::npos) << one_track(1e-4);
  EXPECT_EQ(one_track(kNotApplicable), "") << "several kinds of wheels";
}

// Two stretches of a single step of wear, then one of three.
TEST(Clock, ItSaysWhichDaysAreNotResolved) {
  std::vector<ClockMoment> history(4);
  for (std::size_t i = 1; i < 4; ++i) {
    history[i].kilograms = 0.1e9 * static_cast<double>(i);
    history[i].removed = history[i - 1].removed + (i < 3 ? 1e-5 : 3e-5);
    history[i].contact_change = i == 1 ? 2.5 : 1.2;
  }
  std::vector<LifeRow> lives(1);
  lives[0].wheels = lives[0].mgt = {0.15, 0.15, 0.15};
  const std::string note = unresolved_days(history, lives, 1e-5);
  EXPECT_NE(note.find("before 0.2 MGT"), std::string::npos) << note;
  EXPECT_NE(note.find("2.5 times"), std::string::npos) << note;
  EXPECT_NE(note.find("first crack"), std::string::npos) << note;
  lives[0].wheels = lives[0].mgt = {30, 30, 30};
  EXPECT_EQ(unresolved_days(history, lives, 1e-5), "") << "hardly any damage by then";
  history[2].ductility = 0.5;
  EXPECT_NE(unresolved_days(history, lives, 1e-5), "");
  EXPECT_EQ(unresolved_days(history, lives, 1e-6), "") << "several steps in each";
}

TEST(Clock, TheLifeOfOneWheelIsThatOfItsCollective) {
  const std::string horizon = "[life]\nuntil = \"1000 Mt\"\n";
  const CaseSpec alone = parse_case(fatigued(horizon + "[vehicle]\nwheel_load = \"100 kN\"\n"), "a.toml").spec;
  AskOptions how;
  how.bem.cell = 1e-3;
  how.life_of = life_of_wheels({});
  const LifeSummary life = ask(alone, place(alone, {}), {}, how).summary.life;
  const ClockResult collective = run(fatigued(kOne), 1000);
  EXPECT_EQ(life.text, life_text(collective.lives));
  EXPECT_DOUBLE_EQ(life.best, 1e9 * shortest(collective.lives)->mgt.best);
  EXPECT_TRUE(std::isfinite(life.best));
  how.life_of = {};
  EXPECT_TRUE(ask(alone, place(alone, {}), {}, how).summary.life.text.empty()) << "nothing gives a life";
}

}  // namespace
}  // namespace railstrata
