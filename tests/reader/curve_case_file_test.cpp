// [curve] and [[bogie]]: kinds of vehicles, wheels of their own, mistakes.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/faults.hpp"
#include "reader/case_file.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {
namespace {

const std::string kCurve = "[curve]\nradius = \"800 m\"\nsuperelevation = \"80 mm\"\n[[bogie]]\nmgt = 10\n";

TEST(CurveCaseFile, AKindOfVehicleSuppliesWhatIsNotGiven) {
  const LoadedCase loaded = parse_case(kCurve + "type = \"wagon\"\naxle_load = \"8 t\"\n", "a.toml");
  const BogieSpec& bogie = loaded.spec.collective.curve.bogies.at(0);
  const BogieNumbers& wagon = bogie_types().at(1).numbers;
  EXPECT_EQ(bogie.title(), "wagon");
  EXPECT_NEAR(bogie.axle_load, 8e3 * 9.81, 1e-6);
  EXPECT_EQ(bogie.wheelbase, wagon.wheelbase);
  EXPECT_EQ(bogie.lateral, wagon.lateral);
  ASSERT_EQ(loaded.notes.size(), 1u);
  EXPECT_NE(loaded.notes[0].find("estimated"), std::string::npos) << loaded.notes[0];
}

TEST(CurveCaseFile, TheResolvedCaseReadsBackToTheSameBits) {
  const LoadedCase loaded = parse_case(
      kCurve + "name = \"unit\"\nspeed = \"33.3 m/s\"\nwheelbase = \"2.7 m\"\nwheel_profile = \"LMA\"\n", "a.toml");
  const LoadedCase back = parse_case(loaded.resolved_toml, "a.toml");
  EXPECT_EQ(back.resolved_toml, loaded.resolved_toml);
  EXPECT_EQ(back.spec.collective.curve.bogies.at(0).wheelbase, 2.7);
  EXPECT_EQ(back.spec.collective.curve.bogies.at(0).wheel_profile, "LMA");
  EXPECT_EQ(*back.spec.collective.curve.radius, 800);
}

TEST(CurveCaseFile, AFolderOfWheelsMakesABogieOfEach) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "bogie_wheels";
  std::filesystem::create_directories(folder / "worn");
  for (const char* name : {"a.csv", "b.csv"}) {
    std::ofstream file(folder / "worn" / name);
    for (int i = -35; i <= 35; ++i) file << i << ", " << 0.05 * i << "\n";
  }
  const LoadedCase loaded = parse_case(kCurve + "wheel_profile = \"worn\"\n", folder / "a.toml");
  std::filesystem::remove_all(folder);
  ASSERT_EQ(loaded.spec.collective.curve.bogies.size(), 2u);
  EXPECT_EQ(loaded.spec.collective.curve.bogies[1].name, "coach, b");
  EXPECT_EQ(*loaded.spec.collective.curve.bogies[1].mgt, 5);
  EXPECT_EQ(loaded.inputs.size(), 2u);
}

TEST(CurveCaseFile, MistakesHaveTheirPlace) {
  const std::pair<const char*, const char*> bad[] = {
      {"[curve]\nradius = \"800 m\"\n[[bogie]]\ntype = \"wagon\"\n", "its traffic is not given"},
      {"[curve]\nradius = \"800 m\"\n[[bogie]]\nmgt = 1\ntype = \"wagen\"\n", "wagon"},
      {"[[bogie]]\nmgt = 1\n", "curve.radius"},
      {"[curve]\nradius = \"800 m\"\n[[bogie]]\nmgt = 1\nwheel_radius = \"1.8 m\"\n", "must lie above the axle"},
      {"[curve]\nradius = \"800 m\"\n[[bogie]]\nmgt = 1\naxle_load = \"3 t\"\n", "half of the axle load"}};
  for (const auto& [text, message] : bad) try {
      parse_case(text, "a.toml");
      ADD_FAILURE() << text;
    } catch (const CaseError& e) {
      EXPECT_NE(std::string(e.what()).find(message), std::string::npos) << e.what();
    }
}

}  // namespace
}  // namespace railstrata
