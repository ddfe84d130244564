// What a line contact asks of a case, and what of it the engines refuse.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/faults.hpp"
#include "reader/case_file.hpp"
#include "rules/clashes.hpp"

namespace railstrata {
namespace {

std::vector<Diagnostic> not_in_fem(const LoadedCase& loaded) { return refused_by(uses::kFiniteElements, loaded); }

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
  ASSERT_EQ(not_in_fem(line).size(), 1u);
  EXPECT_NE(not_in_fem(line)[0].message.find("geometry.contact = \"line\""), std::string::npos);
}

TEST(LineCaseFile, WhatItCannotHaveIsRefusedInWords) {
  for (const char* set :
       {"geometry.cant=0.025", "geometry.yaw=\"5 mrad\"", "geometry.roll=0.01", "geometry.lateral_shift=\"1 mm\"",
        "geometry.curve_radius=\"300 m\"", "geometry.wheel_profile=LMA", "geometry.rail_profile=CN60",
        "drive.spin=\"0.1 1/m\"", "drive.lateral_creepage=0.001", "drive.lateral_force=\"1 kN\"",
        "vehicle.approach=\"0.1 mm\""}) {
    const std::string fault = fault_of(kLine, {set}), key = std::string(set).substr(0, std::string(set).find('='));
    for (const std::string& word : {key, std::string("geometry.contact = \"line\""), std::string("remedy: ")})
      EXPECT_NE(fault.find(word), std::string::npos) << set << ": " << fault;
  }
  for (const char* text : {"[geometry]\ncontact = \"line\"\n", "[geometry]\nline_length = \"1 mm\"\n"})
    EXPECT_NE(fault_of(text).find(" needs geometry."), std::string::npos) << text;
}

TEST(RollInACase, IsReadAndNotInTheFiniteElements) {
  const LoadedCase rolled = parse_case("[geometry]\nroll = \"5 mrad\"\n", "a.toml");
  EXPECT_NEAR(rolled.spec.geometry.roll, std::tan(0.005), 1e-9);
  ASSERT_EQ(not_in_fem(rolled).size(), 1u);
  EXPECT_TRUE(not_in_fem(rolled)[0].message.starts_with("geometry.roll is not supported by the finite elements"));
}

// Displacements of distant points have no meaning in plane strain.
TEST(LineCaseFile, HistoriesOfALineAreThoseOfForces) {
  const std::string rolling = kLine + "[transient]\nkind = \"rolling\"\ndistance = \"5 mm\"\n",
                    shift = kLine + "[transient]\nkind = \"shift\"\n";
  EXPECT_EQ(fault_of(rolling), "");
  EXPECT_EQ(fault_of(shift + "tractive_force = [\"5 kN\", \"-5 kN\"]\n"), "");
  const auto keeps = [](const std::string& fault, const char* key) {
    return fault.find(key) != std::string::npos && fault.find("geometry.contact = \"line\"") != std::string::npos;
  };
  EXPECT_TRUE(keeps(fault_of(shift + "displacement = [\"1 um\"]\n"), "transient.displacement"));
  EXPECT_TRUE(keeps(fault_of(rolling, {"drive.creepage=-0.001"}), "drive.creepage"));
  EXPECT_TRUE(keeps(fault_of(shift + "lateral_force = [\"5 kN\"]\n"), "transient.lateral_force"));
}

}  // namespace
}  // namespace railstrata
