// The keys of transients and of the approach: read, refused with place and remedy, written out again.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "reader/case_file.hpp"
#include "rules/support.hpp"
#include "tables/history_table.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

std::vector<Diagnostic> not_in_fem(const LoadedCase& loaded) { return refused_by(uses::kFiniteElements, loaded); }

std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse_case(text, "a.toml", overrides);
  } catch (const CaseError& e) {
    return e.what();
  }
  return "taken";
}

void expect_says(const std::string& text, std::initializer_list<const char*> words) {
  const std::string said = refusal(text);
  for (const char* word : words) EXPECT_NE(said.find(word), std::string::npos) << said << "\n  lacks: " << word;
}

TEST(TransientCaseFile, ATimeTooFarAwayIsRefused) {
  expect_says("[transient]\nkind = \"rolling\"\nat_time = [\"0 ms\", \"1000000 ms\"]\ncreepage = [0, 0.01]\n",
              {"a.toml:3", "transient.at_time", "the last row is 2.778e+04 m from the start", "rolls 20 m at most"});
}

TEST(TransientCaseFile, ColumnsAreReadInSiUnitsAndWrittenOutAgain) {
  const LoadedCase loaded = parse_case(
      "[transient]\nkind = \"rolling\"\nstart = \"steady\"\ndistance = \"30 mm\"\nat_distance = [\"0 mm\", \"10 mm\"]\n"
      "wheel_load = [\"80 kN\", \"100 kN\"]\ncreepage = [0, -0.002]\nlateral_force = [\"1 kN\", \"2 kN\"]\nspin = "
      "[\"0.1 "
      "1/m\", \"0.2 rad/m\"]\n",
      "a.toml");
  const TransientSpec& t = loaded.spec.transient;
  EXPECT_EQ(t.kind, TransientKind::rolling);
  EXPECT_EQ(t.start, TransientStart::steady);
  EXPECT_EQ(t.distance, 0.03);
  EXPECT_EQ(t.at_distance, (std::vector<double>{0, 0.01}));
  EXPECT_EQ(t.wheel_load, (std::vector<double>{80e3, 100e3}));
  EXPECT_EQ(t.creepage, (std::vector<double>{0, -0.002}));
  EXPECT_EQ(t.lateral_force, (std::vector<double>{1e3, 2e3}));
  EXPECT_EQ(t.spin, (std::vector<double>{0.1, 0.2}));
  const LoadedCase again = parse_case(loaded.resolved_toml, "b.toml");
  EXPECT_EQ(again.resolved_toml, loaded.resolved_toml);
  EXPECT_EQ(again.spec.transient.creepage, t.creepage);
  EXPECT_EQ(parse_case("", "a.toml").resolved_toml.find("transient"), std::string::npos)
      << "a case in steady rolling says nothing of it";
}

TEST(TransientCaseFile, AHistoryFileStandsForItsColumns) {
  CaseSpec spec;
  read_history_table(
      "# measured\ndistance [mm]; wheel_load_kN; creepage; spin_1_m\n0; 80; 0; 0.1\n# between\n10; 100.5; -1e-3; "
      "0.2\n\n",
      "h.csv", spec);
  EXPECT_EQ(spec.transient.at_distance, (std::vector<double>{0, 0.01}));
  EXPECT_EQ(spec.transient.wheel_load, (std::vector<double>{80e3, 100.5e3}));
  EXPECT_EQ(spec.transient.creepage, (std::vector<double>{0, -1e-3}));
  EXPECT_EQ(spec.transient.spin, (std::vector<double>{0.1, 0.2}));
  CaseSpec result;  // as results name it
  read_history_table("distance_mm,spin_per_m\n0,0.3\n10,0.4\n", "h.csv", result);
  EXPECT_EQ(result.transient.spin, (std::vector<double>{0.3, 0.4}));

  const TemporaryFolder temporary;
  const std::filesystem::path folder = temporary.path();
  std::ofstream(folder / "h.csv") << "\xEF\xBB\xBF"
                                     "displacement [um],lateral_displacement_um\n2,0\n-2,1\n";
  const LoadedCase loaded = parse_case("[transient]\nkind = \"shift\"\nhistory_file = \"h.csv\"\n", folder / "a.toml");
  EXPECT_EQ(loaded.spec.transient.displacement, (std::vector<double>{2e-6, -2e-6}));
  EXPECT_EQ(loaded.spec.transient.lateral_displacement, (std::vector<double>{0, 1e-6}));
  EXPECT_EQ(loaded.inputs, (std::vector<std::filesystem::path>{folder / "h.csv"}));
  EXPECT_EQ(parse_case(loaded.resolved_toml, "elsewhere.toml").spec.transient.displacement,
            loaded.spec.transient.displacement);
}

TEST(TransientCaseFile, TablesOfSpreadsheetsAreRead) {
  CaseSpec spec;
  EXPECT_EQ(
      read_history_table("# of a spreadsheet\n\ndistance [mm];wheel_load [kN];creepage\n0;80;0\n2,5;100,25;-1e-3\n",
                         "h.csv", spec)
          .of,
      (std::vector<int>{3, 4, 5}));
  EXPECT_EQ(spec.transient.at_distance, (std::vector<double>{0, 2.5e-3}));
  EXPECT_EQ(spec.transient.wheel_load, (std::vector<double>{80e3, 100.25e3}));
  EXPECT_EQ(spec.transient.creepage, (std::vector<double>{0, -1e-3}));
  CaseSpec tabs, quoted;
  read_history_table("displacement [um]\tlateral_displacement [um]\n0\t0\n2,5\t1.5\n", "h.csv", tabs);
  EXPECT_EQ(tabs.transient.displacement, (std::vector<double>{0, 2.5e-6}));
  EXPECT_EQ(tabs.transient.lateral_displacement, (std::vector<double>{0, 1.5e-6}));
  read_history_table("\"displacement [um]\",\"lateral_displacement [um]\",\n\"2,5\",\"1\",\n", "h.csv", quoted);
  EXPECT_EQ(quoted.transient.displacement, (std::vector<double>{2.5e-6}));
  EXPECT_EQ(quoted.transient.lateral_displacement, (std::vector<double>{1e-6}));
  CaseSpec alone;
  read_history_table("displacement [um]\n1,5\n-1.5\n", "h.csv", alone);
  EXPECT_EQ(alone.transient.displacement, (std::vector<double>{1.5e-6, -1.5e-6}));
}

/// What is said of a case beside a history file of this text.
std::string refusal_of_history(const std::string& table, const std::string& kind = "shift") {
  const TemporaryFolder temporary;
  const std::filesystem::path folder = temporary.path();
  std::ofstream(folder / "h.csv") << table;
  try {
    parse_case("[transient]\nkind = \"" + kind + "\"\nhistory_file = \"h.csv\"\n", folder / "a.toml");
  } catch (const CaseError& e) {
    EXPECT_EQ(e.diagnostics.size(), 1u) << e.what();
    return e.diagnostics.front().where.substr(folder.string().size() + 1) + ": " + e.diagnostics.front().message;
  }
  return "taken";
}

TEST(TransientCaseFile, AFaultInAHistoryFileIsOneErrorAtItsOwnLine) {
  EXPECT_EQ(refusal_of_history("displacement_um, lateral_displacement_um\n0, 0\n1, x\n"),
            "h.csv:3: \"x\" is not a number, in the column lateral_displacement");
  EXPECT_EQ(refusal_of_history("distance [mm], creepage\n0, 0\n# a remark\n5, 0.001\n4, 0.001\n", "rolling"),
            "h.csv:5: transient.at_distance: must not decrease from row to row");
  EXPECT_NE(refusal_of_history("tractive_force_kN\n10\n50\n").find("h.csv:3: transient.tractive_force: row 2 wants"),
            std::string::npos);
  EXPECT_EQ(refusal_of_history("creepage\n0\n").find("h.csv:1: transient.creepage cannot be combined with"), 0u);
}

TEST(TransientCaseFile, ARecordOfAVehicleCodeIsAHistoryFromItsFirstRow) {
  const TemporaryFolder temporary;
  const std::filesystem::path folder = temporary.path();
  EXPECT_NE(refusal_of_history("Time (s);Q (kN)\n12,340;85\n12,341;\xE2\x88\x92"
                               "1\n",
                               "rolling")
                .find("h.csv:3"),
            std::string::npos)
      << "a minus sign of a word processor is one";
  std::ofstream(folder / "h.csv") << "Time (s);Q (kN);y [mm]\n12,340;85;0\n12,341;1.0D+02;1\n";
  const LoadedCase loaded =
      parse_case("[transient]\nkind = \"rolling\"\nhistory_file = \"h.csv\"\n", folder / "a.toml");
  ASSERT_EQ(loaded.spec.transient.at_time.size(), 2u);
  EXPECT_EQ(loaded.spec.transient.at_time[0], 0);
  EXPECT_NEAR(loaded.spec.transient.at_time[1], 1e-3, 1e-12);
  EXPECT_EQ(loaded.spec.transient.wheel_load, (std::vector<double>{85e3, 100e3}));

  EXPECT_EQ(loaded.notes, (std::vector<std::string>{"h.csv: not read: y [mm]",
                                                    "h.csv: Time (s) counts from its first row, 12340 ms"}));
}

std::string table_refusal(const std::string& text) {
  CaseSpec spec;
  try {
    read_history_table(text, "folder/h.csv", spec);
  } catch (const CaseError& e) {
    return e.what();
  }
  return "taken";
}

TEST(TransientCaseFile, AFaultOfAHistoryFileIsToldWithItsLine) {
  const std::pair<const char*, const char*> all[] = {
      {"distance [mm], 2nd\n", "h.csv:1: unknown column \"2nd\"\n    remedy: columns: distance, "},
      {"distance [mm], creepage\n0, 0 # first\n", "a comment stands on a line of its own"},
      {"distance [mm], creepage\n0, 0\n1, #DIV/0!\n",
       "h.csv:3: \"#DIV/0!\" is an error of the spreadsheet, in the column creepage"},
      {"distance [mm], creepage\n#NV, 0\n", "h.csv:2: \"#NV\" is an error of the spreadsheet"},
      {"distance [mm], creepge\n", "did you mean creepage?"},
      {"distance, creepage\n", "h.csv:1: the column \"distance\" has no unit"},
      {"distance [kN], creepage\n", "h.csv:1: the column at_distance:"},
      {"distance [mm], at_distance_mm\n", "two columns are at_distance"},
      {"tractive_force_kN, creepage\n", "the table has tractive_force and creepage"},
      {"distance [mm], creepage\n0, 0\n1\n", "folder/h.csv:3: 1 value in a table of 2 columns"},
      {"distance [mm], creepage\n0, x\n", "h.csv:2: \"x\" is not a number, in the column creepage"},
      {"distance [mm], creepage\n0, 5\n", "h.csv:2: creepage = 5: must be between -10 and 1"},
      {"distance [mm], creepage\n0, nan\n", "is not a number"},
      {"distance [mm], creepage\n0,5, 0,001\n", "decimal commas need semicolons between the columns"},
      {"distance [mm]; creepage\n0, 0\n",
       "1 value in a table of 2 columns\n    remedy: give every row one value a "
       "column, separated as the names are"},
      {"distance [mm]; creepage\n1.000,5; 0\n", "\"1.000,5\" is not a number"},
      {"distance [mm], creepage\n", "the table has no rows"},
      {"", "h.csv:1: the table has no rows"},
  };
  for (const auto& [text, says] : all)
    EXPECT_NE(table_refusal(text).find(says), std::string::npos) << table_refusal(text) << "\n  lacks: " << says;
  expect_says(
      "[transient]\nkind = \"shift\"\nhistory_file = \"none.csv\"\n",
      {"a.toml:3:16: transient.history_file = \"none.csv\": cannot read", "none.csv", "relative to the case file"});
  expect_says("[transient]\nkind = \"shift\"\nhistory_file = \"h.csv\"\ndisplacement = [\"1 um\"]\n",
              {"a.toml:4:16: [transient] has history_file and displacement"});
}

TEST(TransientCaseFile, WhatCannotBeIsToldWithItsPlaceAndRemedy) {
  const std::string rolling = "[transient]\nkind = \"rolling\"\n", shift = "[transient]\nkind = \"shift\"\n";
  expect_says(rolling, {"a.toml:2:8: transient.kind: how far does it roll?", "add distance = \"25 mm\""});
  expect_says(rolling + "creepage = [0, 0.1]\n",
              {"a.toml:3:12: transient.creepage: where are these rows?", "at_distance"});
  expect_says(rolling + "at_distance = [\"0 mm\", \"1 mm\"]\ncreepage = [0]\n",
              {"a.toml:4:12: transient.creepage: 1 values, transient.at_distance has 2"});
  expect_says(rolling + "at_distance = [\"0 mm\", \"2 mm\", \"1 mm\"]\n", {"transient.at_distance: must not decrease"});
  expect_says(rolling + "at_distance = [\"1 mm\", \"2 mm\"]\n", {"the first row must be the start, 0"});
  expect_says(rolling + "distance = \"1 mm\"\ndisplacement = [\"1 um\"]\n",
              {"transient.displacement", "transient.kind = \"rolling\"", "kind = \"shift\""});
  expect_says(shift, {"transient.kind: a shift needs something that shifts"});
  expect_says(shift + "creepage = [0.1]\n", {"transient.creepage", "transient.kind = \"shift\""});
  expect_says(shift + "distance = \"1 mm\"\ndisplacement = [\"1 um\"]\n",
              {"transient.distance", "transient.kind = \"shift\""});
  expect_says(shift + "tractive_force = [\"10 kN\", \"50 kN\"]\n",
              {"a.toml:3:18: transient.tractive_force: row 2 wants 50 kN of friction", "at most 42.48 kN",
               "the wheel would slide"});
  expect_says(
      rolling + "at_distance = [\"0 mm\", \"1 mm\"]\nload_factor = [1, 0.3]\n",
      {"row 2 wants 16.99 kN of friction, a friction coefficient of 0.5 gives at most 12.74 kN under its load"});
  expect_says(shift + "displacement = [\"1 um\"]\n[vehicle]\napproach = \"0.1 mm\"\n",
              {"vehicle.approach", "transient.kind", "transient.wheel_load"});
  expect_says(shift + "displacement = [\"1 um\"]\n[run]\nrolling = false\n",
              {"transient.kind", "run.rolling = false", "take run.rolling out"});
  expect_says(shift + "displacement = [\"1 um\"]\n[drive]\nfriction_coefficient = 0\n",
              {"transient.kind", "drive.friction_coefficient", "above zero"});
  expect_says(shift + "displacement = [\"1 um\"]\ntractive_force = [\"1 kN\"]\n",
              {"[transient] has tractive_force and displacement"});
  expect_says(shift + "displacement = [2]\n", {"a bare number has no unit"});
}

TEST(TransientCaseFile, WhatHasNoEffectIsSaid) {
  const LoadedCase idle = parse_case("[transient]\ncreepage = [0.1]\n", "a.toml"),
                   held = parse_case(
                       "[drive]\ncreepage = 0.001\n[transient]\nkind = \"shift\"\ndisplacement = [\"1 um\"]\n",
                       "a.toml");
  ASSERT_EQ(idle.notes.size(), 1u);
  EXPECT_NE(idle.notes[0].find("transient.creepage has no effect"), std::string::npos) << idle.notes[0];
  EXPECT_EQ(parse_case(idle.resolved_toml, "b.toml").spec.transient.creepage, idle.spec.transient.creepage);
  ASSERT_EQ(held.notes.size(), 1u);
  EXPECT_NE(held.notes[0].find("drive.creepage has no effect"), std::string::npos) << held.notes[0];
  const LoadedCase steps =
      parse_case("[transient]\nkind = \"rolling\"\ndistance = \"5 mm\"\nincrements = 7\n", "a.toml");
  ASSERT_EQ(steps.notes.size(), 1u);
  EXPECT_EQ(steps.notes[0].find("transient.increments has no effect without transient.kind = \"shift\""), 0u)
      << steps.notes[0];
}

TEST(TransientCaseFile, FrictionThatFallsGoesWithRollingAlone) {
  const std::string falling =
      "[friction]\nlaw = \"falling_rational\"\nkinetic_coefficient = 0.2\nhalf_velocity = \"1 m/s\"\n";
  EXPECT_NO_THROW(parse_case(falling + "[transient]\nkind = \"rolling\"\ndistance = \"5 mm\"\n", "a.toml"));
  expect_says(falling + "[transient]\nkind = \"shift\"\ndisplacement = [\"1 um\"]\n",
              {"friction.law", "transient.kind = \"shift\"", "give friction.law = \"coulomb\""});
}

TEST(TransientCaseFile, AndApproachAreNotInTheFiniteElements) {
  const LoadedCase transient = parse_case("[transient]\nkind = \"rolling\"\ndistance = \"5 mm\"\n", "a.toml"),
                   approach = parse_case("[vehicle]\napproach = \"0.09 mm\"\n", "a.toml");
  ASSERT_EQ(not_in_fem(transient).size(), 1u);
  EXPECT_EQ(not_in_fem(transient)[0].where, "a.toml:2:8");
  EXPECT_NE(not_in_fem(transient)[0].message.find("not supported by the finite elements"), std::string::npos);
  ASSERT_EQ(not_in_fem(approach).size(), 1u);
  EXPECT_EQ(not_in_fem(approach)[0].where, "a.toml:2:12");
}

TEST(TransientCaseFile, AnApproachTakesThePlaceOfTheLoad) {
  const LoadedCase loaded = parse_case("[vehicle]\napproach = \"0.09 mm\"\n", "a.toml");
  EXPECT_EQ(loaded.spec.vehicle.approach, 0.09e-3);
  EXPECT_EQ(loaded.resolved_toml.find("\nsprung_mass ="), std::string::npos);
  EXPECT_EQ(parse_case(loaded.resolved_toml, "b.toml").spec.vehicle.approach, 0.09e-3);
  expect_says("[vehicle]\napproach = \"0.09 mm\"\nwheel_load = \"80 kN\"\n", {"[vehicle] has wheel_load and approach"});
  expect_says("[vehicle]\napproach = \"0.09 mm\"\n[drive]\ntractive_force = \"10 kN\"\n",
              {"a.toml:4:18: drive.tractive_force", "vehicle.approach", "give drive.traction_coefficient"});
  expect_says("[vehicle]\napproach = \"-1 mm\"\n", {"vehicle.approach = \"-1 mm\": must be above 0 mm"});
  const LoadedCase set = parse_case("[vehicle]\nwheel_load = \"80 kN\"\n", "a.toml", {"vehicle.approach=0.09 mm"});
  EXPECT_TRUE(set.spec.vehicle.approach.has_value()) << "--set takes the load's place";
}

}  // namespace
}  // namespace railstrata
