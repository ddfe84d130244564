#include "text/units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace railstrata {
namespace {

using namespace dimension;

struct Written {
  const char* text;
  Dimension dimension;
  double si;
};

TEST(Units, EveryWayOfWritingGivesTheVeryDoubleOfItsSiLiteral) {
  const Written all[] = {{"210 GPa", kPressure, 210e9},
                         {"0.2 mm", kLength, 0.2e-3},
                         {"27.78 m/s", kSpeed, 27.78},
                         {"8000 kg", kMass, 8000},
                         {"0.95 MN/m", kStiffness, 0.95e6},
                         {"10.4 kN s/m", kDamping, 10.4e3},
                         {"10.4 kN·s/m", kDamping, 10.4e3},
                         {"10.4 kN*s/m", kDamping, 10.4e3},
                         {"7800 kg/m^3", kDensity, 7800},
                         {"7800 kg/m³", kDensity, 7800},
                         {"7.8 g/cm^3", kDensity, 7.8e3},
                         {"1.5 ms", kTime, 1.5e-3},
                         {"2000 1/s", kRate, 2000},
                         {"2 kHz", kRate, 2000},
                         {"1:40", kSlope, 1.0 / 40},
                         {"0.025", kSlope, 0.025},
                         {"20 %", kNumber, 0.2},
                         {"0.2", kNumber, 0.2},
                         {"50 µm", kLength, 50e-6},
                         {"50um", kLength, 50e-6},
                         {"+3.5e2 mm", kLength, 0.35},
                         {"-1.5 mm", kLength, -1.5e-3},
                         {" 8 t ", kMass, 8000},
                         {"2.5 %", kSlope, 0.025},
                         {"1 : 20", kSlope, 0.05},
                         {"84.9546 kN", kForce, 84954.6},
                         {"0.12 1/m", kSpin, 0.12},
                         {"0.00012 rad/mm", kSpin, 0.12},
                         {"15 MPa √m", kToughness, 15e6},
                         {"15 MPa√m", kToughness, 15e6},
                         {"15 MPa m^0.5", kToughness, 15e6},
                         {"50 W/(m K)", kConductivity, 50},
                         {"0.46 kJ/(kg K)", kHeatCapacity, 460},
                         {"700 K", kTemperature, 700},
                         {"380 HV", kHardness, 380},
                         {"1/40", kSlope, 1.0 / 40}};
  for (const Written& w : all) EXPECT_EQ(parse_quantity(w.text, w.dimension), w.si) << w.text;
}

TEST(Units, HundredKilometresPerHourAreTheirSiValueToRoundOff) {
  EXPECT_DOUBLE_EQ(parse_quantity("100 km/h", kSpeed), 100e3 / 3600);
  EXPECT_DOUBLE_EQ(parse_quantity("23 mrad", kSlope), std::tan(0.023));
  EXPECT_DOUBLE_EQ(parse_quantity("45 deg", kSlope), 1.0);
  EXPECT_DOUBLE_EQ(parse_quantity("285 HBW", kHardness), 300);
  for (const char* upright : {"90 deg", "-181 deg", "1.6 rad"})
    EXPECT_THROW(parse_quantity(upright, kSlope), UnitError) << upright;
}

TEST(Units, OfTheTradeAndOfOtherCountriesAreRead) {
  EXPECT_EQ(parse_quantity("388 HV10", dimension::kHardness), 388);
  EXPECT_EQ(parse_quantity("388 HV0.5", dimension::kHardness), 388);
  EXPECT_EQ(parse_quantity("10 \u03BCm", dimension::kLength), 10e-6);
  EXPECT_EQ(parse_quantity("10 \u00B5m", dimension::kLength), 10e-6);
  EXPECT_EQ(parse_quantity("\u22125\u00A0mm", dimension::kLength), -5e-3);
  EXPECT_DOUBLE_EQ(parse_quantity("36 in", dimension::kLength), 0.9144);
  EXPECT_DOUBLE_EQ(parse_quantity("60 mph", dimension::kSpeed), 26.8224);
  EXPECT_NEAR(parse_quantity("145 ksi", dimension::kPressure), 999.74e6, 1e4);
  EXPECT_NEAR(parse_quantity("36 kip", dimension::kForce), 160.14e3, 10);
  EXPECT_THROW(parse_quantity("40 HRC", dimension::kHardness), UnitError);
}

TEST(Units, WhatIsShownReadsBackToTheSameBits) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> exponent(-9, 12);
  for (const Dimension& d : {kNumber,   kLength,    kMass,         kTime,         kSpeed,
                             kRate,     kPressure,  kDensity,      kStiffness,    kDamping,
                             kSlope,    kToughness, kConductivity, kHeatCapacity, kTemperature,
                             kHardness, kRotation,  kSpin,         kForce,        kPressureGradient})
    for (int i = 0; i < 500; ++i) {
      const double value = std::pow(10.0, exponent(random));
      EXPECT_EQ(parse_quantity(format_quantity(value, d), d), value) << format_quantity(value, d);
    }
}

TEST(Units, ValuesAreShownInTheCustomaryUnit) {
  EXPECT_EQ(format_quantity(0.2e-3, kLength), "0.2 mm");
  EXPECT_EQ(format_quantity(1.435, kLength), "1435 mm");
  EXPECT_EQ(format_quantity(210e9, kPressure), "210 GPa");
  EXPECT_EQ(format_quantity(10.4e3, kDamping), "10.4 kN s/m");
  EXPECT_EQ(format_quantity(0.025, kSlope), "0.025");
  EXPECT_EQ(format_quantity(0, kLength), "0 mm");
}

struct Refused {
  const char* text;
  Dimension dimension;
  const char *rule, *remedy;
};

TEST(Units, EveryBadTextIsRefusedWithItsRuleAndRemedy) {
  const Refused all[] = {
      {"0.2", kLength, "has no unit", "write a length, e.g. \"0.2 mm\""},
      {"210 GPa", kLength, "\"GPa\" is not the unit of a length",
       "write a length, e.g. \"0.2 mm\" (units: mm, m, µm, cm)"},
      {"210 gpa", kPressure, "unknown unit \"gpa\"", "did you mean GPa?"},
      {"3 furlong", kLength, "unknown unit \"furlong\"", "write a length, e.g. \"0.2 mm\" (units: mm, m, µm, cm)"},
      {"20 °C", kTemperature, "unknown unit \"°C\"",
       "write the same number in K, \"20 K\" for 20 °C: only differences count"},
      {"50 knots", kSpeed, "unknown unit \"knots\"", "write a speed, e.g. \"100 km/h\" (units: m/s, km/h)"},
      {"100 kmh", kSpeed, "unknown unit \"kmh\"", "did you mean km/h?"},
      {"0,5 mm", kLength, "has a comma in the number", "numbers have a decimal point: write \"0.5 mm\""},
      {"0,2", kNumber, "has a comma in the number", "numbers have a decimal point: write \"0.2\""},
      {"8,000 kg", kMass, "has a comma in the number", "write \"8.000 kg\", or \"8000 kg\" if thousands are meant"},
      {"thick", kLength, "does not start with a number", "write a length, e.g. \"0.2 mm\""},
      {"", kLength, "does not start with a number", "write a length, e.g. \"0.2 mm\""},
      {"10 N/m s", kDamping, "the unit \"N/m s\" is ambiguous", "put the divided unit last, e.g. \"kN s/m\""},
      {"9.81 m/s/s", kSpeed, "the unit \"m/s/s\" has two solidi", "write one, e.g. \"kg/m^3\""},
      {"2 mm", kNumber, "\"mm\" is not the unit of a number", "write a number, e.g. 0.2"},
      {"1:0", kSlope, "unknown unit \":0\"", "write an inclination, e.g. \"1:40\" (units: mrad, rad, deg)"},
      {"1/0", kSlope, "unknown unit \"/0\"", "write an inclination, e.g. \"1:40\" (units: mrad, rad, deg)"},
      {"380", kHardness, "has no unit", "write a hardness, e.g. \"380 HV\""},
      {"15 MPa", kToughness, "\"MPa\" is not the unit of a fracture toughness",
       "write a fracture toughness, e.g. \"15 MPa √m\" (units: MPa √m, MPa m^0.5)"},
      {"5 m/", kSpeed, "unknown unit \"m/\"", "did you mean m/s?"}};
  for (const Refused& r : all) {
    try {
      parse_quantity(r.text, r.dimension);
      ADD_FAILURE() << "accepted: " << r.text;
    } catch (const UnitError& e) {
      EXPECT_STREQ(e.what(), r.rule);
      EXPECT_EQ(e.remedy, r.remedy);
    }
  }
}

TEST(Units, AModulusInMegapascalIsAnsweredWithGigapascal) {
  const auto within = [](double min, double max) { return [=](double v) { return v >= min && v <= max; }; };
  EXPECT_EQ(suggest_quantity("210 MPa", kPressure, within(1e9, 2000e9)), "210 GPa");
  EXPECT_EQ(suggest_quantity("430 m", kLength, within(0.1, 1.0)), "430 mm");
  EXPECT_EQ(suggest_quantity("-3 mm", kLength, within(0.1, 1.0)), "");
  EXPECT_EQ(suggest_quantity("500 mm", kLength, within(-0.05, 0.05)), "") << "not 500 µm: a length was meant";
  EXPECT_EQ(suggest_quantity("0 km/h", kSpeed, within(0, 200)), "") << "zero has no other unit";
}

TEST(Units, ExponentsBeyondAllBoundsAreInfiniteOrZeroAndNeverForgotten) {
  EXPECT_EQ(parse_quantity("1e99999999999 mm", kLength), std::numeric_limits<double>::infinity());
  EXPECT_EQ(parse_quantity("-2e2147483647 GPa", kPressure), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(parse_quantity("1e-99999999999 mm", kLength), 0);
  EXPECT_EQ(parse_quantity("0e99999999999 mm", kLength), 0);
  EXPECT_EQ(parse_quantity("1" + std::string(400, '0') + " mm", kLength), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace railstrata
