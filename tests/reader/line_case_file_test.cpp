// What a line contact asks of a case, and what of it the engines refuse.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/faults.hpp"
#include "reader/case_file.hpp"

namespace railstrata {
namespace {

const std::string kLine =
    "[geometry]\ncontact = \"line\"\nline_length = \"20 mm\"\nrail_profile = \"flat\"\nwheel_profile = \"flat\"\ncant "
    "= "
    "0.0\n";

std::string fault_of(const std::string& text, const std::vector<std::string>& set = {}) {
  try {
    parse_case(text, "a.toml", set);
  } catch (const CaseError& e) {
    return e.what();
  }
  return "";
}

TEST(LineCaseFile, IsReadAndWrittenBack) {
  const LoadedCase line = parse_case(kLine, "a.toml");
  EXPECT_TRUE(line.spec.geometry.in_line());
  EXPECT_EQ(line.spec.geometry.line_length, 0.02);
  EXPECT_TRUE(parse_case(line.resolved_toml, "b.toml").spec.geometry.in_line());
  EXPECT_FALSE(parse_case("", "a.toml").spec.geometry.in_line());
  ASSERT_EQ(line.not_in_fem.size(), 1u);
  EXPECT_TRUE(line.not_in_fem[0].message.starts_with("a line contact (geometry.contact) is not in this engine"))
      << line.not_in_fem[0].message;
}

TEST(LineCaseFile, WhatItCannotHaveIsRefusedInWords) {
  struct Bad {
    std::string set, says;
  };
  for (const Bad& bad : {
           Bad{"geometry.cant=0.025", "geometry.cant: a line contact lies level"},
           Bad{"geometry.yaw=\"5 mrad\"", "geometry.yaw: a line contact rolls straight on"},
           Bad{"geometry.roll=0.01", "geometry.roll: a line contact lies level"},
           Bad{"geometry.lateral_shift=\"1 mm\"", "geometry.lateral_shift: a line contact"},
           Bad{"geometry.curve_radius=\"300 m\"", "geometry.curve_radius: a line contact has no spin"},
           Bad{"geometry.wheel_profile=LMA", "geometry.wheel_profile: a line contact is that of a cylinder"},
           Bad{"geometry.rail_profile=CN60", "geometry.rail_profile: a line contact"},
           Bad{"drive.spin=\"0.1 1/m\"", "drive.spin: a line contact has no spin"},
           Bad{"drive.lateral_creepage=0.001", "drive.lateral_creepage: a line contact is driven along the rail"},
           Bad{"drive.lateral_force=\"1 kN\"", "drive.lateral_force: a line contact is driven along the rail"},
           Bad{"vehicle.approach=\"0.1 mm\"", "vehicle.approach: a line contact has no approach"},
       }) {
    const std::string fault = fault_of(kLine, {bad.set});
    EXPECT_NE(fault.find(bad.says), std::string::npos) << bad.set << ": " << fault;
    EXPECT_NE(fault.find("remedy"), std::string::npos) << fault;
  }
  EXPECT_NE(fault_of("[geometry]\ncontact = \"line\"\n").find("geometry.contact = \"line\" needs geometry.line_length"),
            std::string::npos);
  EXPECT_NE(fault_of("[geometry]\nline_length = \"1 mm\"\n").find("no meaning with geometry.contact = \"point\""),
            std::string::npos);
}

TEST(RollInACase, IsReadAndNotInTheFiniteElements) {
  const LoadedCase rolled = parse_case("[geometry]\nroll = \"5 mrad\"\n", "a.toml");
  EXPECT_NEAR(rolled.spec.geometry.roll, std::tan(0.005), 1e-9);
  ASSERT_EQ(rolled.not_in_fem.size(), 1u);
  EXPECT_TRUE(rolled.not_in_fem[0].message.starts_with("a roll of the wheelset (geometry.roll) is not in this engine"));
}

// Displacements of distant points have no meaning in plane strain.
TEST(LineCaseFile, HistoriesOfALineAreThoseOfForces) {
  const std::string rolling = kLine + "[transient]\nkind = \"rolling\"\ndistance = \"5 mm\"\n",
                    shift = kLine + "[transient]\nkind = \"shift\"\n";
  EXPECT_EQ(fault_of(rolling), "");
  EXPECT_EQ(fault_of(shift + "tractive_force = [\"5 kN\", \"-5 kN\"]\n"), "");
  const std::string unknown = "a line contact follows a history of forces alone";
  EXPECT_NE(fault_of(shift + "displacement = [\"1 um\"]\n").find("transient.displacement: " + unknown),
            std::string::npos);
  EXPECT_NE(fault_of(rolling, {"drive.creepage=-0.001"}).find("drive.creepage: " + unknown), std::string::npos);
  EXPECT_NE(fault_of(shift + "lateral_force = [\"5 kN\"]\n").find("transient.lateral_force: a line contact is driven"),
            std::string::npos);
}

}  // namespace
}  // namespace railstrata
