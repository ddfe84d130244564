// [[irregularity]]: read, its file too, refused with place and remedy, written out again.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <numbers>

#include "reader/case_file.hpp"
#include "rules/irregularity_rules.hpp"
#include "rules/support.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

std::string refusal(const std::string& text) {
  try {
    parse_case(text, "a.toml");
  } catch (const CaseError& e) {
    return e.what();
  }
  return "taken";
}

std::string refusal_of_entry(const std::string& keys) { return refusal("[[irregularity]]\n" + keys); }

TEST(IrregularityCaseFile, EntriesAreReadInSiUnitsAndWrittenOutAgain) {
  const LoadedCase loaded = parse_case(
      "[[irregularity]]\nat = \"200 mm\"\nlength = \"20 mm\"\ndepth = \"0.2 mm\"\nwidth = \"30 mm\"\n"
      "[[irregularity]]\non = \"wheel\"\nkind = \"out_of_round\"\norder = 6\ndepth = \"100 um\"\n"
      "[[irregularity]]\nkind = \"dip\"\nat = \"1 m\"\nangle = \"10 mrad\"\nshape = \"line\"\n"
      "[[irregularity]]\nkind = \"file\"\nx = [\"0 mm\", \"10 mm\", \"20 mm\"]\nz = [\"0 um\", \"-10 um\", \"0 um\"]\n"
      "[[irregularity]]\nkind = \"step\"\nat = \"1 m\"\nlength = \"12 mm\"\nheight = \"-0.5 mm\"\n",
      "a.toml");
  const std::vector<Irregularity>& all = loaded.spec.irregularities;
  ASSERT_EQ(all.size(), 5u);
  EXPECT_TRUE(std::holds_alternative<Indentation>(all[0].shape));
  EXPECT_EQ(all[0].at, 0.2);
  EXPECT_EQ(all[0].width, 30e-3);
  EXPECT_EQ(all[1].on, BodyId::wheel);
  EXPECT_EQ(std::get<OutOfRound>(all[1].shape).order, 6);
  EXPECT_NEAR(std::get<Dip>(all[2].shape).angle.value(), 10e-3, 1e-6) << "its tangent";
  EXPECT_EQ(std::get<Dip>(all[2].shape).shape, RampShape::line);
  EXPECT_EQ(std::get<HeightPoints>(all[3].shape).z, (std::vector<double>{0, -10e-6, 0}));
  EXPECT_EQ(std::get<Step>(all[4].shape).height_behind, -0.5e-3);
  EXPECT_EQ(parse_case(loaded.resolved_toml, "b.toml").resolved_toml, loaded.resolved_toml);
  EXPECT_EQ(parse_case("", "a.toml").resolved_toml.find("irregularity"), std::string::npos);
}

TEST(IrregularityCaseFile, AFileStandsForItsPoints) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "squat.csv") << "x [mm], y [mm], z [um]\n0, -5, 0\n10, -5, -20\n20, -5, 0\n0, 5, 0\n"
                                                "10, 5, -40\n20, 5, 0\n";
  const LoadedCase loaded = parse_case(
      "[[irregularity]]\nkind = \"file\"\nfile = \"squat.csv\"\nsmoothing = \"4 mm\"\n", folder.path() / "a.toml");
  const HeightPoints& is = std::get<HeightPoints>(loaded.spec.irregularities.at(0).shape);
  EXPECT_EQ(is.y, (std::vector<double>{-5e-3, -5e-3, -5e-3, 5e-3, 5e-3, 5e-3}));
  EXPECT_EQ(is.z.at(4), -40e-6);
  EXPECT_EQ(is.file, "");
  EXPECT_EQ(loaded.inputs.size(), 1u);
  EXPECT_EQ(std::get<HeightPoints>(parse_case(loaded.resolved_toml, "b.toml").spec.irregularities.at(0).shape).z, is.z);
}

TEST(IrregularityCaseFile, FaultsNameTheKeyAndTheRemedy) {
  const std::pair<std::string, std::vector<const char*>> all[] = {
      {"kind = \"indentation\"\nat = \"0 mm\"\nlength = \"20 mm\"\n", {"a.toml:1", "needs depth", "add depth"}},
      {"at = \"0 mm\"\nlength = \"20 mm\"\ndepth = \"1 mm\"\nwavelength = \"3 mm\"\n",
       {"a.toml:5", "irregularity.0.wavelength", "has no wavelength", "its keys: at, length, depth"}},
      {"at = \"0 mm\"\nlength = \"2 mm\"\ndepth = \"0.2 mm\"\n", {"steepest slope is 0.31", "up to 0.2", "less deep"}},
      {"kind = \"flat\"\nat = \"0 mm\"\nlength = \"40 mm\"\n", {"irregularity.0.on", "is of the wheel"}},
      {"kind = \"dip\"\non = \"wheel\"\nat = \"0 mm\"\nangle = \"1 mrad\"\n", {"irregularity.0.on", "is of the rail"}},
      {"kind = \"step\"\nat = \"0 mm\"\nlength = \"2 mm\"\nheight = \"1 mm\"\n",
       {"steepest slope is 0.79", "less high"}},
      {"kind = \"step\"\nat = \"0 mm\"\nlength = \"20 mm\"\ndepth = \"1 mm\"\n", {"needs height", "has no depth"}},
      {"kind = \"corrugation\"\nwavelength = \"40 mm\"\ndepth = \"20 um\"\nfrom = \"2 m\"\nto = \"1 m\"\n",
       {"irregularity.0.to", "beyond from"}},
      {"kind = \"file\"\n", {"needs x", "file = \"heights.csv\""}},
      {"kind = \"file\"\nfile = \"nowhere.csv\"\n", {"a.toml:3", "irregularity.0.file", "name a CSV file"}},
      {"kind = \"file\"\nx = [\"0 mm\", \"0 mm\", \"1 mm\"]\nz = [\"0 mm\", \"0 mm\", \"0 mm\"]\n",
       {"two heights at x = 0 mm"}},
      {"kind = \"file\"\nx = [\"0 mm\", \"1 mm\", \"2 mm\"]\nz = [\"0 mm\", \"1 mm\", \"0 mm\"]\n",
       {"steepest slope is 1", "units of x and z"}},
      {"kind = \"roughness\"\nrms = \"2 um\"\nshortest = \"30 mm\"\nlongest = \"20 mm\"\n", {"longer than shortest"}},
  };
  for (const auto& [keys, words] : all) {
    const std::string said = refusal_of_entry(keys);
    for (const char* word : words) EXPECT_NE(said.find(word), std::string::npos) << said << "\n  lacks: " << word;
  }
  EXPECT_EQ(refusal_of_entry("kind = \"stepp\"\nat = \"0 mm\"\n").find("needs"), std::string::npos)
      << "what kind it is to be is not known";
  EXPECT_NE(
      refusal("[transient]\nkind = \"shift\"\ndisplacement = [\"1 um\"]\n[[irregularity]]\nat = \"0 mm\"\nlength = "
              "\"20 mm\"\ndepth = \"0.1 mm\"\n")
          .find("irregularity cannot be combined with transient.kind = \"shift\""),
      std::string::npos);
}

TEST(IrregularityCaseFile, LevelsOfThirdOctavesAreReadFromTheirFile) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "levels.csv") << "Wellenlänge [cm];Pegel [dB]\n2,5;3,5\n2;-1\n";
  const LoadedCase loaded =
      parse_case("[[irregularity]]\nkind = \"levels\"\nfile = \"levels.csv\"\n", folder.path() / "a.toml");
  const auto& read = std::get<RoughnessLevels>(loaded.spec.irregularities.at(0).shape);
  EXPECT_EQ(read.wavelengths, (std::vector<double>{25e-3, 20e-3}));
  EXPECT_EQ(read.levels, (std::vector<double>{3.5, -1}));
  EXPECT_EQ(parse_case(loaded.resolved_toml, "b.toml").resolved_toml, loaded.resolved_toml);
  EXPECT_NE(refusal_of_entry("kind = \"levels\"\n").find("needs wavelengths"), std::string::npos);
  EXPECT_NE(refusal_of_entry("kind = \"levels\"\nwavelengths = [\"2 cm\"]\nlevels = [\"1 dB\", \"2 dB\"]\n")
                .find("2 levels of 1 wavelengths"),
            std::string::npos);
}

TEST(IrregularityCaseFile, WhatTheWheelNeverReachesIsRefused) {
  const std::string rolls = "[transient]\nkind = \"rolling\"\ndistance = \"20 mm\"\n",
                    hollow = "[[irregularity]]\nlength = \"20 mm\"\ndepth = \"0.2 mm\"\nat = ";
  EXPECT_EQ(refusal(rolls + hollow + "\"60 mm\"\n"), "taken");
  EXPECT_NE(refusal(rolls + hollow + "\"-900 mm\"\n").find("lies behind the way of the wheel: it ends at x = -890 mm"),
            std::string::npos);
  EXPECT_NE(refusal(rolls + hollow + "\"900 mm\"\n").find("it begins at x = 890 mm, the wheel stops at 20 mm"),
            std::string::npos);
  EXPECT_NE(refusal("[run]\npositions = [\"300 mm\"]\n" + hollow + "\"900 mm\"\n").find("the wheel stops at 300 mm"),
            std::string::npos);
}

TEST(IrregularityCaseFile, FiniteElementsSayWhatTheyDoNotTake) {
  const auto beyond = [](const std::string& text) {
    std::vector<std::string> keys;
    for (const Diagnostic& r : refused_by(uses::kFiniteElements, parse_case(text, "a.toml").spec))
      keys.push_back(r.where);
    return keys;
  };
  const std::string hollow = "[[irregularity]]\nat = \"200 mm\"\nlength = \"20 mm\"\ndepth = \"0.2 mm\"\n";
  using Keys = std::vector<std::string>;
  EXPECT_EQ(beyond(hollow + "[run]\nwindow = \"0 mm\"\n[mesh]\nelement_size = \"2 mm\"\n"), Keys{});
  EXPECT_EQ(beyond(hollow), Keys{"run.window"});
  EXPECT_EQ(beyond(hollow + "[run]\nwindow = \"0 mm\"\n[mesh]\nelement_size = \"4 mm\"\n"), Keys{"irregularity.0"});
  EXPECT_EQ(beyond(hollow + "[run]\nwindow = \"0 mm\"\nrun_up = \"195 mm\"\npositions = [\"300 mm\"]\n"),
            Keys{"irregularity.0"});
  EXPECT_EQ(beyond(hollow + "[run]\nrolling = false\n"), Keys{}) << "at rest it may lie anywhere";
  EXPECT_EQ(beyond("[run]\nwindow = \"0 mm\"\n[[irregularity]]\nkind = \"dip\"\nat = \"2 m\"\nangle = \"10 mrad\"\n"),
            Keys{"irregularity"})
      << "no track";
  const std::string on_track = "[track]\npreset = \"delft\"\n";
  EXPECT_EQ(beyond("[run]\nwindow = \"0 mm\"\n[[irregularity]]\nkind = \"dip\"\nat = \"2 m\"\nangle = \"10 mrad\"\n" +
                   on_track),
            Keys{});
  EXPECT_THROW(require_support(uses::kHalfSpaces, parse_case(hollow, "a.toml").spec), CaseError);
  EXPECT_THROW(require_support(uses::kHalfSpaces, parse_case(on_track, "a.toml").spec), CaseError);
}

}  // namespace
TEST(IrregularityCaseFile, HeightsMayHaveAChainageAGreekMuOrTheAnglesOfAWheel) {
  const TemporaryFolder folder;
  const auto read = [&](const char* table, const std::string& more) {
    std::ofstream(folder.path() / "h.csv") << table;
    return parse_case(
        "[geometry]\nwheel_radius = \"460 mm\"\n[[irregularity]]\nkind = \"file\"\nfile = \"h.csv\"\n" + more,
        folder.path() / "a.toml");
  };
  const auto points = [](const LoadedCase& loaded) {
    return std::get<HeightPoints>(loaded.spec.irregularities[0].shape);
  };
  const LoadedCase way = read("x [m];z [\u03BCm]\n12345,00;10\n12345,01;-10\n12345,02;0\n", "");
  EXPECT_EQ(points(way).x[0], 0);
  EXPECT_NEAR(points(way).x[2], 0.02, 1e-9);
  EXPECT_EQ(points(way).z, (std::vector<double>{1e-5, -1e-5, 0}));
  EXPECT_NE(way.notes.back().find("h.csv: x counts from its first row, 12345000 mm"), std::string::npos)
      << way.notes.back();
  const LoadedCase turned = read("angle [deg];runout [um]\n0;50\n90;-50\n180;0\n", "on = \"wheel\"\n");
  EXPECT_NEAR(points(turned).x[1], 0.46 * std::numbers::pi / 2, 1e-12);
  EXPECT_EQ(points(turned).z, (std::vector<double>{5e-5, -5e-5, 0}));
}

}  // namespace railstrata
