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

}  // namespace
}  // namespace railstrata
