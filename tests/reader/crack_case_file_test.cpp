// [crack]: read, refused with place and remedy, written out again.
#include <gtest/gtest.h>

#include <numbers>

#include "reader/case_file.hpp"

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

void expect_written_again(const LoadedCase& loaded) {
  EXPECT_EQ(parse_case(loaded.resolved_toml, "b.toml").resolved_toml, loaded.resolved_toml);
}

TEST(CrackCaseFile, ACrackFromTheSurface) {
  const LoadedCase loaded = parse_case(
      "[life]\nuntil = \"5 Mt\"\n[crack]\ndepth = \"0.3 mm\"\nangle = \"30 deg\"\nazimuth = \"-135 deg\"\nplace = "
      "\"-15 "
      "mm\"\nlateral = \"1 mm\"\nface_friction = 0.3\nfluid = \"trapped\"\naspect = 2\nlaw = \"paris\"\nthreshold = "
      "\"5 "
      "MPa √m\"\ndetectable = \"1 mm\"\nallowable = \"4 mm\"\n",
      "a.toml");
  const CrackSpec& crack = loaded.spec.life.crack;
  EXPECT_EQ(crack.depth, 0.3e-3);
  EXPECT_NEAR(crack.angle, std::numbers::pi / 6, 1e-15);
  EXPECT_NEAR(*crack.azimuth, -0.75 * std::numbers::pi, 1e-15);
  EXPECT_EQ(*crack.place, -15e-3);
  EXPECT_EQ(crack.fluid, CrackFluid::trapped);
  EXPECT_EQ(crack.law, GrowthLaw::paris);
  EXPECT_EQ(crack.threshold, 5e6);
  expect_written_again(loaded);
}

TEST(CrackCaseFile, ACrackInside) {
  const LoadedCase loaded = parse_case("[crack]\ntop = \"3 mm\"\ndepth = \"4 mm\"\n", "a.toml");
  EXPECT_EQ(loaded.spec.life.crack.top, 3e-3);
  expect_written_again(loaded);
  EXPECT_EQ(parse_case("", "a.toml").resolved_toml.find("face_friction"), std::string::npos);
}

const std::string kTwoLayers =
    "[[layer]]\nname = \"clad\"\nthickness = \"1 mm\"\nyoung_ratio = 2\n[[layer]]\nname = \"bed\"\nthickness = \"0.5 "
    "mm\"\nyoung_ratio = 1\n";

TEST(CrackCaseFile, ACrackAlongAnInterface) {
  const LoadedCase loaded = parse_case(kTwoLayers + "[crack]\nlength = \"4 mm\"\nlayer = 2\n", "a.toml");
  EXPECT_EQ(loaded.spec.life.crack.length, 4e-3);
  EXPECT_EQ(loaded.spec.life.crack.layer, 2);
  EXPECT_TRUE(loaded.spec.life.crack.there());
  expect_written_again(loaded);
  EXPECT_NE(loaded.resolved_toml.find("face_friction"), std::string::npos);
}

TEST(CrackCaseFile, ACrackAlongNoInterfaceIsRefused) {
  const auto says = [](const std::string& text, const char* words) {
    EXPECT_NE(refusal(text).find(words), std::string::npos) << text;
  };
  const std::string crack = "[crack]\nlength = \"4 mm\"\n";
  says(crack, "below a layer, of which the rail has 0");
  says(kTwoLayers + crack + "layer = 3\n", "of which the rail has 2");
  says(kTwoLayers + "[crack]\nlength = \"21 mm\"\n", "at most 20 times the depth of the interface, 1 mm");
  says(kTwoLayers + "interface_shear_stiffness = \"100 MPa/mm\"\n" + crack + "layer = 2\n", "a crack needs a bond");
}

TEST(CrackCaseFile, WhatIsNoCrackIsRefused) {
  EXPECT_NE(refusal("[crack]\ndepth = \"1 mm\"\ntop = \"2 mm\"\n").find("must lie above crack.depth = 1 mm"),
            std::string::npos);
  EXPECT_NE(refusal("[crack]\ndepth = \"1 mm\"\nangle = \"5 deg\"\n").find("crack.angle"), std::string::npos);
  EXPECT_NE(refusal("[crack]\ndepth = \"1 mm\"\nangle = 0.5\n").find("25 deg"), std::string::npos);
  const std::string followed = "[life]\nuntil = \"5 Mt\"\n[crack]\n";
  EXPECT_NE(refusal(followed + "depth = \"6 mm\"\n").find("less than crack.allowable = 5 mm"), std::string::npos);
  EXPECT_NE(refusal(followed + "depth = \"0.2 mm\"\ndetectable = \"5 mm\"\n").find("less than crack.allowable = 5 mm"),
            std::string::npos);
}

}  // namespace
}  // namespace railstrata
