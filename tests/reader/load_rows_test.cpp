#include "tables/load_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/faults.hpp"
#include "reader/case_file.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse_case(text, "a.toml", overrides);
  } catch (const CaseError& e) {
    return e.what();
  }
  return "taken";
}

void expect_says(const std::string& said, const std::string& words) {
  EXPECT_NE(said.find(words), std::string::npos) << said << "\n  lacks: " << words;
}

constexpr const char* kTwo =
    "[drive]\ncreepage = -0.001\n[[load]]\nname = \"freight\"\npassages = 4e5\naxle_load = \"22 t\"\n"
    "lateral_shift = \"-3 mm\"\nyaw = \"2 mrad\"\n"
    "[[load]]\nwheel_load = \"80 kN\"\ntraction_coefficient = 0.1\nfriction_coefficient = 0.3\nspeed = \"30 m/s\"\n"
    "curve_radius = \"-600 m\"\nlateral_creepage = 0.002\n";

}  // namespace

TEST(LoadRows, ARowIsTheCaseWithWhatTheRowGives) {
  const CaseSpec spec = parse_case(kTwo, "a.toml").spec;
  ASSERT_EQ(spec.loads.size(), 2u);
  EXPECT_EQ(load_name(spec, 0), "freight");
  EXPECT_EQ(load_name(spec, 1), "load 2");
  EXPECT_EQ(spec.loads[0].passages, 4e5);
  EXPECT_DOUBLE_EQ(*spec.loads[0].wheel_load, 0.5 * 22e3 * kGravity);

  const CaseSpec freight = with_load(spec, spec.loads[0]);
  EXPECT_DOUBLE_EQ(freight.vehicle.load(), *spec.loads[0].wheel_load);
  EXPECT_EQ(freight.geometry.lateral_shift, -3e-3);
  EXPECT_DOUBLE_EQ(freight.geometry.yaw, std::tan(2e-3));
  EXPECT_EQ(freight.drive.creepage, -0.001);
  EXPECT_EQ(freight.drive.speed, spec.drive.speed);
  EXPECT_TRUE(freight.loads.empty());

  const CaseSpec second = with_load(spec, spec.loads[1]);
  EXPECT_EQ(second.drive.traction(), 0.1) << "the row's traction takes the place of the case's creepage";
  EXPECT_EQ(second.drive.friction_coefficient, 0.3);
  EXPECT_EQ(second.drive.lateral_creepage, 0.002);
  EXPECT_EQ(second.geometry.curve_radius, -600);
  EXPECT_EQ(second.drive.speed, 30);
  EXPECT_EQ(second.geometry.lateral_shift, spec.geometry.lateral_shift);
}

TEST(LoadRows, TheResolvedCaseHasTheRowsAndReadsBack) {
  const LoadedCase loaded = parse_case(kTwo, "a.toml");
  const LoadedCase again = parse_case(loaded.resolved_toml, "b.toml");
  EXPECT_EQ(again.resolved_toml, loaded.resolved_toml);
  EXPECT_EQ(again.spec.loads.size(), 2u);
  EXPECT_EQ(again.spec.loads[0].wheel_load, loaded.spec.loads[0].wheel_load);
  EXPECT_EQ(parse_case("", "a.toml").resolved_toml.find("collective"), std::string::npos)
      << "a case without rows says nothing of them";
}

TEST(LoadRows, AreSetFromTheCommandLine) {
  const CaseSpec spec =
      parse_case(kTwo, "a.toml", {"load.1.creepage=0.01", "load.2.passages=7", "load.0.name=60E1"}).spec;
  ASSERT_EQ(spec.loads.size(), 3u);
  EXPECT_EQ(spec.loads[1].creepage, 0.01);
  EXPECT_FALSE(spec.loads[1].traction_coefficient)
      << "what is set takes the place of the file's other way of saying it";
  EXPECT_EQ(spec.loads[2].passages, 7);
  EXPECT_EQ(spec.loads[0].name, "60E1");
}

TEST(LoadRows, ATableInAFileGivesTheSameRowsAsTheCase) {
  const TemporaryFolder temporary;
  const std::filesystem::path folder = temporary.path();
  std::ofstream(folder / "loads.csv")
      << "name;passages;axle_load [t];lateral_shift_mm;yaw [mrad];speed [m/s]\n\"freight\";4e5;22;-3;2;\n;5;;;;30\n";
  const LoadedCase loaded = parse_case("[collective]\nfile = \"loads.csv\"\n", folder / "a.toml");
  const LoadedCase written = parse_case(
      "[[load]]\nname = \"freight\"\npassages = 4e5\naxle_load = \"22 t\"\nlateral_shift = \"-3 mm\"\nyaw = \"2 "
      "mrad\"\n"
      "[[load]]\npassages = 5\nspeed = \"30 m/s\"\n",
      "b.toml");
  EXPECT_EQ(loaded.resolved_toml, written.resolved_toml);
  EXPECT_EQ(loaded.inputs, (std::vector<std::filesystem::path>{folder / "loads.csv"}));
}

TEST(LoadRows, APointBeforeThreeDigitsIsADecimalPointWithoutDecimalCommasBesideIt) {
  CaseSpec spec;
  read_load_table("passages;wheel_load [kN]\n420.000;80.5\n", "loads.csv", spec);
  EXPECT_EQ(spec.loads.at(0).passages, 420);
}

TEST(LoadRows, ATableOfASpreadsheetInWindows1252IsReadAndThatIsSaid) {
  const TemporaryFolder temporary;
  const std::filesystem::path folder = temporary.path();
  std::ofstream(folder / "loads.csv") << "name;passages\r\nG\xFCterwagen;4\r\n";
  const LoadedCase loaded =
      parse_case("[drive]\ntraction_coefficient = 0\n[collective]\nfile = \"loads.csv\"\n", folder / "a.toml");
  EXPECT_EQ(loaded.spec.loads.at(0).name, "Güterwagen");
  ASSERT_EQ(loaded.notes.size(), 1u);
  expect_says(loaded.notes[0], "loads.csv is not in UTF-8: it was read as Windows-1252");
}

TEST(LoadRows, AFaultIsToldWithItsPlaceAndRemedy) {
  expect_says(refusal("[[load]]\ntraction_coefficient = 0.3\nfriction_coefficient = 0.25\n"),
              "a.toml:3:24: load.0: a traction coefficient of 0.3 must be below the friction coefficient 0.25");
  expect_says(refusal("[[load]]\ncurve_radius = \"2 m\"\n"), "must be at least 5000 mm to either side");
  expect_says(refusal("[[load]]\npassages = 0\n"), "must be above 0");
  expect_says(refusal("[[load]]\ncreepage = 0\ntraction_coefficient = 0.1\n"), "a case has one of them");
  expect_says(refusal("[[load]]\nweel_load = \"80 kN\"\n"), "did you mean wheel_load?");
  expect_says(refusal("[load]\npassages = 1\n"), "write [[load]] with two brackets");
  expect_says(refusal("[drive]\ntractive_force = \"10 kN\"\n[[load]]\nwheel_load = \"80 kN\"\n"),
              "drive.tractive_force cannot be combined with load.0.wheel_load");
  expect_says(refusal("[[load]]\n[collective]\nfile = \"x.csv\"\n"), "rows of [[load]] and collective.file");
  expect_says(refusal("[transient]\nkind = \"shift\"\nat_time = [\"0 s\"]\n[[load]]\n"),
              "transient.kind cannot be combined with load");
}

TEST(LoadRows, AFaultOfATableIsToldWithItsLine) {
  const std::pair<const char*, const char*> all[] = {
      {"wheel_load, passages\n", "loads.csv:1: the column \"wheel_load\" has no unit"},
      {"wheel_load [kN], passages\n80, 1\n0, 1\n", "loads.csv:3: wheel_load = 0 kN: must be above 0"},
      {"traction_coefficient, friction_coefficient\n0.3, 0.2\n", "loads.csv:2: a traction coefficient of 0.3"},
      {"lateral_shift [mm]\n80\n", "loads.csv:2: lateral_shift = 80 mm: must be between"},
      {"passages, creepage, traction_coefficient\n", "the table has creepage and traction_coefficient: a load has one"},
      {"passages\n", "the table has no rows"},
      {"passages\nmany\n", "loads.csv:2: \"many\" is not a number"},
      {"passages;wheel_load [kN]\n420.000;80,5\n", "loads.csv:2: \"420.000\" has a point, numbers beside it have"}};
  for (const auto& [text, says] : all) {
    CaseSpec spec;
    try {
      read_load_table(text, "folder/loads.csv", spec);
      ADD_FAILURE() << text;
    } catch (const CaseError& e) {
      expect_says(e.what(), says);
    }
  }
}

TEST(LoadRows, TonnesBecomePassagesOfAxles) {
  CaseSpec spec;
  read_load_table("Radlast [t]; Mio. t; Querverschiebung [mm]\n11; 22; 2\n", "loads.csv", spec);
  ASSERT_EQ(spec.loads.size(), 1u);
  EXPECT_DOUBLE_EQ(*spec.loads[0].wheel_load, 11e3 * kGravity);
  EXPECT_DOUBLE_EQ(spec.loads[0].passages, 1e6);
  EXPECT_DOUBLE_EQ(*spec.loads[0].lateral_shift, 2e-3);
}

TEST(LoadRows, TheLoadOfARowMayBeAMass) {
  const CaseSpec spec = parse_case("[[load]]\nmgt = 22\nwheel_load = \"11 t\"\n", "a").spec;
  EXPECT_DOUBLE_EQ(spec.loads.at(0).wheel_load.value(), 11e3 * kGravity);
  EXPECT_DOUBLE_EQ(spec.loads.at(0).passages, 1e6);
  expect_says(refusal("[[load]]\nwheel_load = \"11 mm\"\n"), "\"mm\" is not the unit of a force");
  expect_says(refusal("[[load]]\nwheel_load = \"2000 t\"\n"),
              "a.toml:2:14: load.0.wheel_load = \"2000 t\": must be above");
}

TEST(LoadRows, TonnesCountOverTheLoadWhereverItStands) {
  CaseSpec spec;
  read_load_table("mgt,axle_load [t]\n22,22\n", "loads.csv", spec);
  EXPECT_DOUBLE_EQ(spec.loads.at(0).passages, 1e6);
  expect_says(refusal("[[load]]\npassages = 3\nmgt = 1\n"), "passages and mgt");
}

TEST(LoadRows, ASeriesOfAVehicleCodeIsBinned) {
  CaseSpec spec;
  const std::string note = read_load_table(
      "time [s],y [mm],psi [mrad],Q [kN],Y [kN],T-gamma [N]\n0,2.2,1.1,82,5,80\n0.1,1.8,0.9,78,6,70\n0.2,-3,0,80,1,0\n",
      "wheel.csv", spec);
  ASSERT_EQ(spec.loads.size(), 2u) << note;
  EXPECT_DOUBLE_EQ(spec.loads[0].passages, 2);
  EXPECT_NEAR(*spec.loads[0].lateral_shift, 2e-3, 1e-15);
  EXPECT_NEAR(*spec.loads[0].wheel_load, 80e3, 1e-9);
  EXPECT_NEAR(*spec.loads[0].yaw, 1e-3, 1e-8);
  EXPECT_DOUBLE_EQ(spec.loads[1].passages, 1);
  EXPECT_NEAR(*spec.loads[0].guiding_force, 5.5e3, 1e-9);
  EXPECT_NEAR(*spec.loads[0].t_gamma, 75, 1e-12);
  expect_says(note,
              "3 samples of a wheel became 2 loads; taken from the case, for the table has none: creepage; "
              "without a column passages or mgt every sample is one wheel; without a column lateral_creepage");
  expect_says(note, "; without a column roll, and y of the tread");
  EXPECT_EQ(spec.loads[1].name, "bin 2: 80 kN, -3 mm");
}

TEST(LoadRows, ASpreadsheetsSeriesIsReadAndSaysWhatItLacks) {
  CaseSpec spec;
  spec.drive.creepage_of = CreepageOf::wheel;
  const std::string note = read_load_table(
      "\xEF\xBB\xBFWeg [m];Radlast [kN];y [mm];Gierwinkel [mrad];Längsschlupf;Querschlupf;Fahrweg\n"
      "0;80;2,1;1;0,001;0;a\n;;;;;;\n1;80;;1;0,001;0;b\n",
      "wheel.csv", spec);
  expect_says(note,
              "2 samples of a wheel became 2 loads; not read: Fahrweg; taken from the case, for the table has "
              "none: lateral_shift (1 of 2 samples); without a column passages or mgt every sample is one wheel");
  EXPECT_NEAR(spec.loads.at(0).creepage.value(), 1e-3, 1e-15);
  EXPECT_EQ(note.find("creepages are taken"), std::string::npos);
  spec = {};
  expect_says(read_load_table("time [s];Q [kN];creepage\n0;80;0.001\n", "wheel.csv", spec),
              "its creepages are taken for those of the contact that touches first");
}

TEST(LoadRows, ASeriesMayHaveUnitsInParenthesesAndWheelsThatLift) {
  CaseSpec spec;
  const std::string note = read_load_table(
      "TIME (s),y (mm),Psi (mrad),Wheel load (kN),Y (kN)\n0.00,2.2,1.1,82,5\n0.01,1.8,0.9,-0.4,0\n0.02,2,1,78,6\n",
      "s.csv", spec, nullptr);
  ASSERT_EQ(spec.loads.size(), 1u);
  EXPECT_DOUBLE_EQ(*spec.loads[0].wheel_load, 80e3);
  EXPECT_DOUBLE_EQ(*spec.loads[0].lateral_shift, 2.1e-3);
  EXPECT_EQ(spec.loads[0].passages, 2);
  expect_says(note, "2 samples of a wheel became 1 loads; 1 of a lifted wheel were left out");
}

TEST(LoadRows, ASeriesHasItsTimeInAnyScript) {
  for (const char* time : {"Zeit", "Temps", "Tid", "时间", "里程"}) {
    CaseSpec spec;
    const std::string names = std::string(time) + (time == std::string("里程") ? " [m]" : " [s]");
    read_load_table(names + ";轮重 [kN];横移量 [mm]\n0;80;1\n0.1;82;1\n", "s.csv", spec, nullptr);
    ASSERT_EQ(spec.loads.size(), 1u) << time;
    EXPECT_DOUBLE_EQ(*spec.loads[0].wheel_load, 81e3);
  }
}

TEST(LoadRows, AHeadingNeedsAUnitOfItsColumnAndNoValue) {
  CaseSpec spec;
  EXPECT_EQ(
      read_load_table("passages,wheel_load [kN],wheel_radius [mm]\n1000,80,430\n2000,85,460\n", "l.csv", spec, nullptr),
      "");
  EXPECT_DOUBLE_EQ(*spec.loads.at(1).wheel_radius, 0.46);
}

TEST(LoadRows, TGammaIsNoTimeInGammas) {
  CaseSpec spec;
  EXPECT_EQ(read_load_table("wheel_load_kN,t_gamma_N\n80,20\n80,20\n", "l.csv", spec, nullptr), "");
  EXPECT_EQ(spec.loads.size(), 2u) << "a table of loads, not a series";
}

TEST(LoadRows, ASeriesWithoutAStateIsRefused) {
  CaseSpec spec;
  try {
    read_load_table("time [s];Last {kN};Vitesse [km/h]\n0;80;100\n", "s.csv", spec, nullptr);
    FAIL() << "taken";
  } catch (const CaseError& e) {
    expect_says(e.what(), "s.csv:1: a series without a load, a lateral shift and a yaw; not read: time [s], Last {kN}");
  }
}

TEST(LoadRows, NamesPartTheSamplesOfASeriesAndBinsHaveAScale) {
  const char* series =
      "time [s];name;y [mm];Q [kN];phi [mrad]\n0;wagon;2.2;82;0.1\n1;coach;1.8;78;0\n2;wagon;1.9;79;0.2\n"
      "3;wagon;2.6;81;0.3\n";
  const auto names = [&](double scale) {
    CaseSpec spec;
    spec.collective.bin_scale = scale;
    EXPECT_EQ(read_load_table(series, "wheel.csv", spec).find("roll"), std::string::npos);
    EXPECT_NEAR(*spec.loads[0].roll, scale == 1 ? 0.15e-3 : 0.2e-3, 1e-11);
    EXPECT_EQ(with_load(spec, spec.loads[0]).geometry.roll, *spec.loads[0].roll);
    std::vector<std::string> out;
    for (const LoadSpec& load : spec.loads) out.push_back(load.name);
    return out;
  };
  EXPECT_EQ(names(1),
            (std::vector<std::string>{"wagon: 80.5 kN, 2.05 mm", "coach: 78 kN, 1.8 mm", "wagon: 81 kN, 2.6 mm"}));
  EXPECT_EQ(names(6), (std::vector<std::string>{"wagon: 80.7 kN, 2.23 mm", "coach: 78 kN, 1.8 mm"}));
}

TEST(LoadRows, DoubtfulLoadsAreNamed) {
  const TemporaryFolder temporary;
  std::ofstream(temporary.path() / "loads.csv")
      << "name; Q [kN]; y [mm]; curve_radius [m]; t_gamma [N]\na; 2250; 0; -600; -2\nb; 80; 5; 600; 9\n";
  const LoadedCase loaded = parse_case("[collective]\nfile = \"loads.csv\"\n", temporary.path() / "a.toml");
  ASSERT_EQ(loaded.spec.loads.size(), 2u);
  std::string all;
  for (const std::string& note : loaded.notes) all += note;
  expect_says(all, "1 of 2 loads have more than 250 kN on a wheel");
  expect_says(all, "1 of 2 loads have a positive curve_radius");
}

namespace {

/// A folder with two wheels, one of them twice as often.
void write_wheels(const std::filesystem::path& folder, const std::string& list) {
  std::filesystem::create_directories(folder / "wheels");
  for (const char* name : {"new.prw", "hollow.prw"}) std::ofstream(folder / "wheels" / name) << "0 0\n";
  if (!list.empty()) std::ofstream(folder / "wheels" / "shares.csv") << list;
}

constexpr const char* kMeasured =
    "[[load]]\nname = \"wagon\"\npassages = 900\nwheel_profile = \"wheels\"\nwheel_radius = \"420 mm\"\n"
    "[[load]]\nwheel_profile = \"S1002\"\n";

}  // namespace

TEST(LoadRows, AFolderOfMeasuredWheelsBecomesARowForEach) {
  const TemporaryFolder temporary;
  const std::filesystem::path folder = temporary.path();
  write_wheels(folder, "");
  const LoadedCase loaded = parse_case(kMeasured, folder / "a.toml");
  ASSERT_EQ(loaded.spec.loads.size(), 3u);
  EXPECT_EQ(load_name(loaded.spec, 0), "wagon, hollow");
  EXPECT_EQ(load_name(loaded.spec, 1), "wagon, new");
  EXPECT_DOUBLE_EQ(loaded.spec.loads[0].passages, 450);
  EXPECT_EQ(loaded.spec.loads[2].wheel_profile, "S1002");
  EXPECT_EQ(load_name(loaded.spec, 2), "load 2") << "of the case, not of the rows made of it";
  const CaseSpec one = with_load(loaded.spec, loaded.spec.loads[1]);
  EXPECT_EQ(one.geometry.wheel_profile, (folder / "wheels" / "new.prw").string());
  EXPECT_EQ(one.geometry.wheel_radius, 0.42);
  EXPECT_EQ(loaded.inputs.size(), 2u);
  EXPECT_EQ(parse_case(loaded.resolved_toml, "b.toml").resolved_toml, loaded.resolved_toml);
}

TEST(LoadRows, AListGivesTheSharesOfMeasuredWheels) {
  const TemporaryFolder temporary;
  const std::filesystem::path folder = temporary.path();
  write_wheels(folder, "file; share [%]\nnew.prw; 66,5\nhollow.prw; 33,5\n");
  for (const char* value : {"wheels", "wheels/shares.csv"}) {
    const std::string text = std::string("[[load]]\npassages = 1000\nwheel_profile = \"") + value + "\"\n";
    const CaseSpec spec = parse_case(text, folder / "a.toml").spec;
    ASSERT_EQ(spec.loads.size(), 2u) << value;
    EXPECT_NEAR(spec.loads[0].passages, 665, 1e-9);
    EXPECT_EQ(load_name(spec, 1), "load 1, hollow");
  }
}

TEST(LoadRows, AWheelThatIsNotThereIsToldWithItsPlace) {
  const TemporaryFolder temporary;
  const std::filesystem::path folder = temporary.path();
  const auto said = [&](const std::string& text) {
    try {
      parse_case(text, folder / "a.toml");
    } catch (const CaseError& e) {
      return std::string(e.what());
    }
    return std::string("taken");
  };
  expect_says(said("[[load]]\nwheel_profile = \"nowhere.prw\"\n"), "a.toml:2:");
  expect_says(said("[[load]]\nwheel_profile = \"nowhere.prw\"\n"), "load.0.wheel_profile = \"nowhere.prw\": neither");
  std::ofstream(folder / "loads.csv") << "passages; wheel_profile\n5; S1002\n6; nowhere.prw\n";
  expect_says(said("[collective]\nfile = \"loads.csv\"\n"), "loads.csv:3");
  write_wheels(folder, "file; share [%]\nnew.prw; 60\nhollow.prw; 33\n");
  expect_says(said(kMeasured), "the shares add up to 93 %");
  write_wheels(folder, "file; share [%]\nnew.prw; 60\nlost.prw; 40\n");
  expect_says(said(kMeasured), "shares.csv:3");
  write_wheels(folder, "file; share [%]\nnew.prw; many\n");
  expect_says(said(kMeasured), "\"many\" is not a number, in the column share");
  write_wheels(folder, "Anteil (%); Datei\n# half of each\n50; new.prw\n5,0D1; hollow.prw\n");
  EXPECT_EQ(parse_case(kMeasured, folder / "a.toml").spec.loads.size(), 3u);
}

TEST(LoadRows, AWheelThatIsToldNothingOfTractionRollsFree) {
  const auto first = [](const std::string& drive, const std::string& row) {
    const LoadedCase loaded = parse_case(drive + "[[load]]\n" + row, "a.toml");
    return with_load(loaded.spec, loaded.spec.loads.at(0)).drive;
  };
  EXPECT_EQ(first("", "").traction(), 0);
  EXPECT_EQ(first("", "traction_coefficient = 0.1\n").traction(), 0.1);
  EXPECT_EQ(first("", "creepage = 0.001\n").creepage, 0.001);
  EXPECT_EQ(first("[drive]\ntraction_coefficient = 0.2\n", "").traction(), 0.2) << "as the case gives it";
  EXPECT_EQ(first("[drive]\ncreepage = 0.001\n", "").creepage, 0.001);
  EXPECT_NE(first("[drive]\ntractive_force = \"5 kN\"\n", "").traction(), 0);
  EXPECT_EQ(first("[drive]\nfriction_coefficient = 0.1\n", "").traction(), 0) << "less friction than the default asks";
  const LoadedCase loaded = parse_case("[[load]]\n[[load]]\ncreepage = 0.001\n", "a.toml");
  ASSERT_FALSE(loaded.notes.empty());
  expect_says(loaded.notes.back(), "1 of 2 loads roll free");
}

}  // namespace railstrata
