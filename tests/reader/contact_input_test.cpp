#include "tables/contact_input.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "core/faults.hpp"
#include "reader/case_file.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

/// Two cases of a right wheel; the second keeps all but position and velocity. Line 3 is the first with digits.
constexpr const char* kTwoPositions = R"(% an input of our own
  1 MODULE
 1203100    C-P-B-T-N-F-S
 0022033    V-L-D-C-M-Z-E
 0000321    H-G-I-A-O-W-R
    500     60    20    1     1.0d-4        MAXGS
  0.350   0.320                             FSTAT, FKIN
  0.300   0.280   80000.  81000.            POISS 1,2,  GG 1,2
  0.250   0.250   1.000   90d   7.0   3.5   DX, DS
   15.0     0    1440.0   1.5d   2.0e-6     GAUGHT, GAUGSQ, GAUGWD, CANT, CURV
  'UIC60'   0     1.0   0.0                 RFNAME
     0.5    0.0   0.000
     0.0   0.0   0.000                      DY, DZ, ROLL, VY, VZ, VROLL
  1362.0  -71.0   450.0                     FBDIST, FBPOS, NOMRAD
  'S1002'   0     1.0   0.0                 WFNAME
  0.0  3.0  90000.  0.0002 0.004r  0.0      S, Y, FZ
 30000. 0.0    0.0   0.0        0.0  -66.5  VS

 1203110    C-P-B-T-N-F-S
 0111002    V-L-D-C-M-Z-E
 0101321    H-G-I-A-O-W-R
  0.0  0.0  80000.  0.0 0.0  0.0
 20000. 5.0    0.0   0.0        0.0  -900.0
  0 MODULE
)";

CaseSpec spec_of(const std::string& text, int number = 0) {
  return parse_case(read_contact_input(text, {"wheel.inp", number}).case_text, "wheel.inp").spec;
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

std::string input_refusal(const std::string& text, int number = 0) {
  try {
    spec_of(text, number);
  } catch (const CaseError& e) {
    return e.what();
  }
  return "taken";
}

}  // namespace

TEST(ContactInput, ARightWheelBecomesTheCaseOfItsNumbers) {
  const CaseSpec spec = spec_of(kTwoPositions);
  const GeometrySpec& g = spec.geometry;
  EXPECT_EQ(spec.title, "wheel.inp, case 1");
  EXPECT_EQ(g.rail_profile, "UIC60");
  EXPECT_EQ(g.wheel_profile, "S1002");
  EXPECT_DOUBLE_EQ(g.gauge, 1.44);
  EXPECT_DOUBLE_EQ(g.gauge_depth, 0.015);
  EXPECT_DOUBLE_EQ(g.cant, std::tan(1.5 * std::numbers::pi / 180));
  EXPECT_DOUBLE_EQ(g.back_to_back, 1.362);
  EXPECT_DOUBLE_EQ(g.flange_back_to_tape, 0.071);
  EXPECT_DOUBLE_EQ(g.wheel_radius, 0.45);
  EXPECT_DOUBLE_EQ(g.yaw, std::tan(0.004));
  EXPECT_DOUBLE_EQ(g.roll, -std::tan(0.0002));
  const double tape = 0.681 + 0.071;
  EXPECT_NEAR(g.lateral_shift, 2.5e-3 + tape * (std::cos(2e-4) * std::cos(4e-3) - 1) - 0.45 * std::sin(2e-4), 1e-15);
  ASSERT_TRUE(g.curve_radius);
  EXPECT_NEAR(*g.curve_radius, 500, 1e-9) << "to the right: its centre lies on the field side of a right wheel";
  EXPECT_NEAR(spec.vehicle.load(), 90e3, 1e-9);
  EXPECT_DOUBLE_EQ(spec.drive.speed, 30);
  EXPECT_EQ(spec.drive.creepage_of, CreepageOf::wheel);
  ASSERT_TRUE(spec.drive.creepage);
  EXPECT_NEAR(*spec.drive.creepage, 1 - tape / 500 - 66.5 * 0.45 * std::cos(0.004) / 30, 1e-15);
  EXPECT_FALSE(spec.drive.lateral_creepage) << "of the yaw alone it follows from the geometry";
  EXPECT_DOUBLE_EQ(spec.drive.friction_coefficient, 0.32);
  EXPECT_DOUBLE_EQ(spec.rail_material.young, 2 * 80e9 * 1.3);
  EXPECT_DOUBLE_EQ(spec.rail_material.poisson, 0.3);
  EXPECT_DOUBLE_EQ(spec.wheel_material.young, 2 * 81e9 * 1.28);
  EXPECT_EQ(spec.bem.spin_angle, SpinAngle::patch);
}

TEST(ContactInput, ACaseKeepsWhatItDoesNotGive) {
  const CaseSpec spec = spec_of(kTwoPositions, 2);
  EXPECT_DOUBLE_EQ(spec.geometry.gauge, 1.44);
  EXPECT_DOUBLE_EQ(spec.drive.friction_coefficient, 0.32);
  EXPECT_NEAR(spec.vehicle.load(), 80e3, 1e-9);
  EXPECT_FALSE(spec.drive.creepage);
  EXPECT_DOUBLE_EQ(spec.drive.traction_coefficient, 900.0 / 80000) << "a force on the rail backwards drives the wheel";
  ASSERT_TRUE(spec.drive.lateral_creepage);
  EXPECT_DOUBLE_EQ(*spec.drive.lateral_creepage, 5.0 / 20000);
}

TEST(ContactInput, ALeftWheelIsTheMirrorOfARightOne) {
  std::string left = changed(kTwoPositions, " 12031", " 02031");
  left = changed(left, "2.0e-6", "-2.0e-6");
  left = changed(left, "     0.5 ", "    -0.5 ");
  left = changed(left, "0.0  3.0  90000.  0.0002 0.004r", "0.0  -3.0  90000.  -0.0002 -0.004r");
  left = changed(left, "20000. 5.0", "20000. -5.0");
  for (const int number : {1, 2})
    EXPECT_EQ(resolved_case(spec_of(left, number)), resolved_case(spec_of(kTwoPositions, number)));
}

TEST(ContactInput, AConformalContactHasTheNormalsOfItsRows) {
  const CaseSpec plane = spec_of(changed(kTwoPositions, "0022033", "0032033"));
  EXPECT_EQ(plane.bem.normals, ContactNormals::plane);
  EXPECT_EQ(plane.bem.spin_angle, SpinAngle::local);
  const std::string conformal = changed(kTwoPositions, "0022033", "0042033");
  for (const int number : {1, 2}) {
    EXPECT_EQ(spec_of(conformal, number).bem.normals, ContactNormals::local) << "D = 1 keeps the discretisation";
    EXPECT_EQ(spec_of(conformal, number).bem.spin_angle, SpinAngle::local);
  }
}

TEST(ContactInput, FrictionFallsAndAFilmLiesBetween) {
  std::string text = changed(kTwoPositions, "0022033", "0422433");
  text = changed(text, "  0.350   0.320 ", "  0.14 0.19 1250. 0.0 1.0 0.02 1.0 ");
  text = changed(text, "80000.  81000.            POISS 1,2,  GG 1,2", "80000.  81000.\n 6560. 1.0 30. 2.0");
  const CaseSpec spec = spec_of(text);
  EXPECT_DOUBLE_EQ(spec.drive.friction_coefficient, 0.33);
  EXPECT_EQ(spec.friction.law, FrictionForm::falling_exponential);
  EXPECT_DOUBLE_EQ(*spec.friction.kinetic_coefficient, 0.14);
  EXPECT_DOUBLE_EQ(*spec.friction.half_velocity, 1.25);
  EXPECT_DOUBLE_EQ(spec.friction.memory_distance, 2e-5);
  EXPECT_DOUBLE_EQ(*spec.third_body.shear_modulus, 6560e6);
  EXPECT_DOUBLE_EQ(*spec.third_body.yield_shear, 30e6);
  const CaseSpec polach =
      spec_of(changed(changed(kTwoPositions, "0022033", "0522033"), "0.350   0.320 ", "0.4 0.3 2e-3"));
  EXPECT_DOUBLE_EQ(*polach.friction.kinetic_coefficient, 0.12);
  EXPECT_NEAR(*polach.friction.half_velocity, std::numbers::ln2 / 2, 1e-12);
}

TEST(ContactInput, WhatACaseCannotSayIsRefusedByItsLine) {
  struct Fault {
    const char *from, *to, *words;
  };
  const std::vector<Fault> faults{
      {" 1203100", " 1203000", "wheel.inp:3: NORM = 0"},
      {" 1203100", " 4203100", "wheel.inp:3: CONFIG = 4"},
      {" 1203100", " 1201100", "wheel.inp:3: TANG = 1"},
      {" 1203100", " 120x100", "wheel.inp:3: \"120x100\" are not the digits"},
      {"0022033", "1022033", "wheel.inp:4: VARFRC = 1"},
      {"0022033", "0022133", "wheel.inp:4: MATER = 1"},
      {"15.0     0", "-1.0     0", "wheel.inp:10: GAUGHT = -1"},
      {"'UIC60'", "'crossing.slcs'", "wheel.inp:11: crossing.slcs: profiles that vary"},
      {"'UIC60'", "UIC60", "wheel.inp:11: no name of a profile"},
      {"0.5    0.0   0.000", "0.5    0.0   0.010", "wheel.inp:12: ROLL"},
      {"  1362.0", "  FBDIST", "wheel.inp:14: no number where FBDIST"},
      {" 30000.", " -30000.", "wheel.inp:17: VS = -30000"},
      {" 30000. 0.0    0.0   0.0        0.0  -66.5  VS\n", "", "the case ends before VS, VY"},
      {"0022033", "0022030", "wheel.inp:3: neither this case nor one before it gives a wheelset"},
  };
  for (const Fault& f : faults)
    EXPECT_NE(input_refusal(changed(kTwoPositions, f.from, f.to)).find(f.words), std::string::npos)
        << f.words << "\n  was: " << input_refusal(changed(kTwoPositions, f.from, f.to));
  EXPECT_NE(input_refusal(kTwoPositions, 3).find("no case 3: the number of cases is 2"), std::string::npos);
  EXPECT_NE(input_refusal(changed(kTwoPositions, "1 MODULE", "3 MODULE")).find("no case of module 1"),
            std::string::npos);
}

TEST(ContactInput, TheNameSaysWhichCase) {
  EXPECT_FALSE(contact_input_name("cases/quick/case.toml"));
  EXPECT_EQ(contact_input_name("a/wheel.INP")->number, 0);
  EXPECT_EQ(contact_input_name("a/wheel.inp#12")->number, 12);
  EXPECT_EQ(contact_input_name("a/wheel.inp#12")->file, std::filesystem::path("a/wheel.inp"));
  for (const char* wrong : {"a.inp#", "a.inp#0", "a.inp#x", "a.inp#2 "})
    EXPECT_THROW(contact_input_name(wrong), CaseError) << wrong;
}

TEST(ContactInput, AFileIsReadAsAnyCaseWithItsProfilesBesideIt) {
  const TemporaryFolder folder;
  std::filesystem::copy(source_dir() / "data/profiles/uic60_60e1_head.csv", folder.path() / "my rail.csv");
  std::ofstream(folder.path() / "wheel.inp") << changed(kTwoPositions, "'UIC60'", "'.\\my rail.csv'");
  const LoadedCase first = load_case(folder.path() / "wheel.inp"), second = load_case(folder.path() / "wheel.inp#2");
  EXPECT_EQ(first.spec.geometry.rail_profile, (folder.path() / "my rail.csv").string());
  EXPECT_EQ(first.inputs.at(0), folder.path() / "wheel.inp");
  EXPECT_NE(first.notes.at(0).find("case 1 of 2 was read"), std::string::npos) << first.notes.at(0);
  EXPECT_NE(second.notes.at(1).find("0.25 mm"), std::string::npos) << second.notes.at(1);
  EXPECT_EQ(resolved_case(parse_case(first.resolved_toml, "case.toml").spec), first.resolved_toml);
  EXPECT_DOUBLE_EQ(load_case(folder.path() / "wheel.inp", {"vehicle.wheel_load=50 kN"}).spec.vehicle.load(), 50e3);
  std::ofstream(folder.path() / "bad.inp") << changed(kTwoPositions, "1362.0  -71.0", "100.0  -71.0");
  try {
    load_case(folder.path() / "bad.inp");
    ADD_FAILURE();
  } catch (const CaseError& e) {
    EXPECT_NE(std::string(e.what()).find("# line 14"), std::string::npos) << "the reader's faults quote the line\n"
                                                                          << e.what();
  }
}

}  // namespace railstrata
