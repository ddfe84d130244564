#include "study/study_file.hpp"

#include <gtest/gtest.h>

#include "many/axis.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

const std::filesystem::path kFile = source_dir() / "cases/paper/made_up_study.toml";

LoadedStudy study(const std::string& groups) { return parse_study("[study]\nbase = \"base.toml\"\n" + groups, kFile); }

std::vector<std::string> said(const StudyGroup& g) {
  std::vector<std::string> out;
  for (const StudyPoint& point : g.points) {
    out.emplace_back();
    for (const StudyValue& v : point) out.back() += v.key + "=" + v.toml + ";";
  }
  return out;
}

/// "line:column: message | remedy" of every error.
std::vector<std::string> errors(const std::string& text) {
  std::vector<std::string> out;
  try {
    parse_study(text, kFile);
  } catch (const CaseError& e) {
    for (const Diagnostic& d : e.diagnostics)
      out.push_back(d.where.substr(kFile.string().size() + 1) + ": " + d.message.substr(0, d.message.find('\n')) +
                    " | " + d.remedy);
  }
  return out;
}

TEST(Variation, TheLastKeyChangesFastest) {
  const std::vector<std::vector<std::string>> wanted{{"1", "x"}, {"1", "y"}, {"2", "x"}, {"2", "y"}};
  EXPECT_EQ(combinations({{"a.b", {"1", "2"}}, {"c.d", {"x", "y"}}}), wanted);
  EXPECT_EQ(combinations({}).size(), 1u);
  const std::vector<std::string> ten(10, "1");
  EXPECT_EQ(combinations({{"a", ten}, {"b", ten}, {"c", ten}}).size(), 1000u);
  try {
    combinations({{"a", ten}, {"b", ten}, {"c", ten}, {"d", ten}, {"e", {"1", "2"}}});
    ADD_FAILURE() << "twenty thousand cases";
  } catch (const CaseError& e) {
    EXPECT_EQ(e.diagnostics.front().message, "the values to vary make 20000 cases, more than 10000");
  }
  EXPECT_THROW(combinations({{"a", ten}, {"b", ten}, {"c", ten}, {"d", ten}, {"e", ten}, {"f", {"1", "2"}}}),
               CaseError);
}

TEST(StudyFile, AGridIsEveryCombinationInTheOrderOfTheFile) {
  const LoadedStudy s = study(
      "[[group]]\nname = \"g\"\n[group.vary]\n\"layer.0.young_ratio\" = [1.67, 2]\n\"drive.speed\" = [\"10 m/s\", \"20 "
      "m/s\"]\n");
  EXPECT_EQ(said(s.spec.groups.at(0)),
            (std::vector<std::string>{
                "layer.0.young_ratio=1.67;drive.speed=\"10 m/s\";", "layer.0.young_ratio=1.67;drive.speed=\"20 m/s\";",
                "layer.0.young_ratio=2;drive.speed=\"10 m/s\";", "layer.0.young_ratio=2;drive.speed=\"20 m/s\";"}));
}

TEST(StudyFile, AKeyWithoutQuotesIsTheSameKey) {
  const LoadedStudy s = study("[[group]]\nname = \"g\"\n[group.vary]\nlayer.0.young_ratio = [2]\n");
  EXPECT_EQ(said(s.spec.groups.at(0)), std::vector<std::string>{"layer.0.young_ratio=2;"});
}

TEST(StudyFile, WhatIsZippedGoesTogetherAndAListStandsAsItIsWritten) {
  const LoadedStudy s = study(
      "[[group]]\nname = \"g\"\nset = { \"run.rolling\" = false }\n[group.zip]\n\"drive.speed\" = [\"10 m/s\", \"20 "
      "m/s\"]\n\"drive.traction_coefficient\" = [0.1, 0.2]\n"
      "[[group.case]]\n\"mesh.element\" = \"full\"\n[[group.case]]\n\"mesh.element\" = "
      "\"one_point\"\n\"run.positions\" = [\"0.2 m\"]\n");
  const StudyGroup& g = s.spec.groups.at(0);
  EXPECT_EQ(
      said(g),
      (std::vector<std::string>{
          "drive.speed=\"10 m/s\";drive.traction_coefficient=0.1;mesh.element=\"full\";",
          "drive.speed=\"10 m/s\";drive.traction_coefficient=0.1;mesh.element=\"one_point\";run.positions=[\"0.2 m\"];",
          "drive.speed=\"20 m/s\";drive.traction_coefficient=0.2;mesh.element=\"full\";",
          "drive.speed=\"20 m/s\";drive.traction_coefficient=0.2;mesh.element=\"one_point\";run.positions=[\"0.2 "
          "m\"];"}));
  EXPECT_EQ(g.set.at(0).toml, "false");
}

TEST(StudyFile, AGroupWithoutKeysIsOneCaseAndTakesBaseEnginesAndSettingsFromTheStudy) {
  const LoadedStudy s = parse_study(
      "[study]\nbase = \"base.toml\"\nengines = [\"bem\"]\nset = { \"drive.speed\" = \"10 m/s\", \"mesh.largest\" = "
      "\"9 mm\" }\n[[group]]\nname = \"a\"\n"
      "[[group]]\nname = \"b\"\nbase = \"layer_3mm_2E0.toml\"\nengines = [\"fem\"]\nset = { \"drive.speed\" = \"20 "
      "m/s\" }\n",
      kFile);
  const StudyGroup &a = s.spec.groups.at(0), &b = s.spec.groups.at(1);
  EXPECT_EQ(a.points.size(), 1u);
  EXPECT_EQ(a.base.filename(), "base.toml");
  EXPECT_EQ(a.engines, std::vector<Engine>{Engine::bem});
  EXPECT_EQ(b.base.filename(), "layer_3mm_2E0.toml");
  EXPECT_EQ(b.engines, std::vector<Engine>{Engine::fem});
  ASSERT_EQ(b.set.size(), 2u);
  EXPECT_EQ(b.set[0].toml, "\"20 m/s\"");
}

TEST(StudyFile, EveryMistakeIsToldAtOnceWithPlaceAndRemedy) {
  EXPECT_EQ(
      errors(
          "[study]\nbase = \"nowhere.toml\"\nengine = \"fem\"\ncell = \"1 s\"\n[[group]]\nname = \"a b\"\nbase = "
          "\"base.toml\"\n[group.vary]\nspeed = [1]\n\"drive.speed\" = \"10 m/s\"\n\"mesh.largest\" = [\"9 mm\", \"9 "
          "mm\"]\n"
          "[group.zip]\n\"mesh.largest\" = [\"8 mm\"]\n\"mesh.end_length\" = [\"80 mm\", \"90 mm\"]\n[[group]]\nname = "
          "\"x\"\nbase = \"base.toml\"\nengines = [\"bme\"]\n[[figure]]\nkind = \"trend\"\ngroups = [\"y\"]\n"),
      (std::vector<std::string>{
          "2:8: base = \"nowhere.toml\": there is no file " + (kFile.parent_path() / "nowhere.toml").string() +
              " | name it relative to the study's folder",
          "3:1: unknown key study.engine | did you mean engines? keys of [study]: title, base, engines, cell, set",
          "4:8: cell = \"1 s\": \"s\" is not the unit of a length | write a length, e.g. \"0.2 mm\" (units: mm, m, µm, "
          "cm)",
          "6:8: group.name = \"a b\": must be a word of letters, digits, _ - and .: folders bear it | write name = "
          "\"layers\"",
          "9:1: speed names no table of the case | write \"table.key\", e.g. \"drive.speed\" or \"layer.0.thickness\"",
          "10:17: drive.speed under vary: must be a list of at least one value | write \"drive.speed\" = [\"10 m/s\"], "
          "or put a single value into [group.set]",
          "11:27: mesh.largest has the value \"9 mm\" twice | leave one out",
          "13:19: mesh.largest is varied twice in this group | name a key once, in vary, zip or case",
          "14:22: mesh.end_length has 2 values and mesh.largest has 1: what is zipped goes together, value by value | "
          "give every key of [group.zip] equally many values, or put it into [group.vary]",
          "18:11: engines: there is no engine \"bme\" | write engines = [\"fem\", \"bem\", \"sections\"], or some of "
          "them",
          "19:1: figure \"figure-1\" is a trend and has no x | name the key along its axis: x = \"layer.0.thickness\"",
          "21:10: figure \"figure-1\": there is no group \"y\" | groups: x"}));
}

TEST(StudyFile, PublishedNumbersAreForValidate) {
  const std::vector<std::string> told =
      errors("[study]\nbase = \"base.toml\"\npublished = \"published.toml\"\n[[group]]\nname = \"a\"\n");
  ASSERT_EQ(told.size(), 1u);
  EXPECT_TRUE(
      told[0].starts_with("3:1: a study is no longer compared with published numbers | take the key out; "
                          "`railstrata validate` compares"));
}

TEST(StudyFile, NoGroupNoTomlNoStudy) {
  EXPECT_EQ(errors("[study]\nbase = \"base.toml\"\n").size(), 1u);
  EXPECT_EQ(
      errors("[[group]]\nname = \"a\"\nbase = \"base.toml\"\n"),
      std::vector<std::string>{"1:1: there is no [study] | begin with [study] and base = \"case.toml\" below it"});
  ASSERT_EQ(errors("[study\n").size(), 1u);
  EXPECT_NE(errors("[study\n")[0].find("this is not TOML"), std::string::npos);
}

TEST(StudyFile, WhatCannotBeComputedOrNamedIsRefused) {
  std::string many = "[study]\nbase = \"base.toml\"\n[[group]]\nname = \"g\"\n[group.vary]\n";
  for (const char* key : {"a.a", "a.b", "a.c", "a.d", "a.e", "a.f"})
    many += "\"" + std::string(key) + "\" = [1, 2, 3, 4, 5, 6, 7, 8, 9]\n";
  const std::string group = "[[group]]\nname = \"study.csv\"\n", start = "[study]\nbase = \"base.toml\"\n";
  EXPECT_EQ(errors(many),
            std::vector<std::string>{
                "3:1: this group has more than 10000 cases | vary fewer keys at once, or give fewer values"});
  EXPECT_EQ(errors(start + "[[group]]\nname = \"g\"\nbase = \"\"\n"),
            std::vector<std::string>{
                "5:8: base = \"\": names no file | name one relative to the study's folder, or leave the key out"});
  EXPECT_EQ(errors(start + group),
            std::vector<std::string>{"4:8: group.name = \"study.csv\": a file of the study may have this name | leave "
                                     "the ending out: folders bear the name"});
  for (const char* cell : {"nan mm", "inf mm", "0 mm", "-1 mm"})
    EXPECT_EQ(errors(start + "cell = \"" + cell + "\"\n[[group]]\nname = \"g\"\n"),
              std::vector<std::string>{"3:8: cell = \"" + std::string(cell) +
                                       "\": must be above 0 mm | write a length, e.g. \"0.5 mm\""});
  EXPECT_EQ(errors("[study]\nbase = \"" + std::string(10'000, 'x') + "\"\n[[group]]\nname = \"g\"\n")
                .at(0)
                .find("2:8: base = \"xxx"),
            0u);
}

TEST(StudyFile, AValueWithControlCharactersStaysOneValue) {
  const LoadedStudy s = study("[[group]]\nname = \"g\"\n[group.set]\n\"case.title\" = \"a\\nb\"\n");
  EXPECT_EQ(s.spec.groups.at(0).set.at(0).toml, "\"a\\u000Ab\"");
}

}  // namespace
}  // namespace railstrata
