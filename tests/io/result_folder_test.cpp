#include "io/result_folder.hpp"

#include <gtest/gtest.h>

#include "core/faults.hpp"

namespace railstrata {
namespace {

constexpr const char* kHeading =
    "x_mm,y_mm,z_mm,area_mm2,p_MPa,q_x_MPa,q_y_MPa,slip_x_mm_s,slip_y_mm_s,state_0separated_1stick_2slip\n";

/// What is wrong with a patch of two points, the second as given.
std::string refusal(const std::string& second, const std::string& summary = R"({"contact": {}})") {
  try {
    parse_results(summary, kHeading + std::string("0,0,0,1,2,3,4,5,6,1\n") + second, "folder");
  } catch (const CaseError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(ResultFolder, OnlyWholeSoundPatchesAreRead) {
  EXPECT_EQ(refusal("0,1,0,1,2,3,4,5,6,2\n"), "accepted");
  EXPECT_NE(refusal("0,1,0,1,2,3,4,5,6,3\n").find("folder/patch.csv: there is no contact state 3"), std::string::npos);
  EXPECT_NE(refusal("0,1,0,1,2,3,4,5,6,nan\n").find("there is no contact state nan"), std::string::npos);
  EXPECT_NE(refusal("0,1,0,1,nan,3,4,5,6,1\n").find("a value is not a finite number"), std::string::npos);
  EXPECT_NE(refusal("").find("the points are not a grid"), std::string::npos);
  EXPECT_NE(refusal("0,1,0,1,2,3,4,5,6\n").find("folder/patch.csv:3: a row of 10 numbers is expected"),
            std::string::npos);
  EXPECT_NE(refusal("", "[]").find("folder/summary.json: this is not a summary"), std::string::npos);
}

TEST(ResultFolder, TextsInThePlaceOfNumbersAreRefused) {
  const auto said = [](const char* summary) { return refusal("0,1,0,1,2,3,4,5,6,2\n", summary); };
  EXPECT_EQ(said(R"({"contact": {"p_max_Pa": 1e9, "spin_per_m": null}, "stress": {"rail": {"layer": null}}})"),
            "accepted");
  EXPECT_NE(said(R"({"contact": {"p_max_Pa": "1 GPa"}})").find("contact.p_max_Pa is a text, not a number"),
            std::string::npos);
  EXPECT_NE(said(R"({"contact": {}, "stress": {"rail": {"layer": [1]}}})").find("stress.rail.layer is a list"),
            std::string::npos);
  EXPECT_NE(said(R"({"contact": {}, "position_m": true})").find("position_m is true or false"), std::string::npos);
  std::string deep = "1";
  for (int k = 0; k < 20000; ++k) deep = "{\"a\":" + deep + "}";
  EXPECT_NE(said(("{\"contact\": " + deep + "}").c_str()).find("is a table, not a number"), std::string::npos);
}

TEST(ResultFolder, OnlyEnginesOfThisProgramAreRead) {
  const auto said = [](const std::string& engine) {
    return refusal("0,1,0,1,2,3,4,5,6,2\n", R"({"contact": {}, "run": {"engine": ")" + engine + "\"}}");
  };
  EXPECT_EQ(said("fem"), "accepted");
  EXPECT_EQ(said("bem"), "accepted");
  EXPECT_NE(said("abc").find("the engine is \"abc\""), std::string::npos);
}

}  // namespace
}  // namespace railstrata
