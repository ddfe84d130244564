// Fits of tests as people bring them: half loops, loops the wrong way round, compression, percents, further columns.
#include "calibrate/material_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "calibrate/test_curves.hpp"
#include "core/faults.hpp"
#include "reader/case_file.hpp"

namespace railstrata {
namespace {

constexpr double kMPa = 1e6, kYoung = 210e9, kAmplitude = 0.004;

PlasticParameters<double> known_law() { return {0, 300 * kMPa, 0, 0, {80000 * kMPa}, {900}}; }

/// The stabilised loop of the law, from its lower tip once around.
std::vector<CurvePoint> loop(bool rising = true, bool falling = true) {
  constexpr int kPoints = 40;
  std::vector<CurvePoint> out;
  for (const double sign : {1.0, -1.0}) {
    if (!(sign > 0 ? rising : falling)) continue;
    for (int i = 0; i <= kPoints; ++i) {
      const double e = kAmplitude * (2.0 * i / kPoints - 1);
      out.push_back({sign * e, sign * loop_stress(known_law(), kAmplitude, e)});
    }
  }
  return out;
}

MaterialCurves curves(std::vector<CurvePoint> cyclic, bool of_loop = true) {
  MaterialCurves out;
  out.cyclic = std::move(cyclic);
  out.of_loop = of_loop;
  out.cyclic_place = "loop.csv";
  out.monotonic_place = "tension.csv";
  out.backstresses = 1;
  return out;
}

std::vector<CurvePoint> tension(double rate, double sign = 1) {
  PlasticParameters<double> law = known_law();
  law.yield -= 60 * kMPa;
  law.saturation = 60 * kMPa;
  law.rate = rate;
  std::vector<CurvePoint> out;
  for (double e = 1e-3; e < 0.04; e *= 1.2) out.push_back({sign * e, sign * monotonic_stress(law, e)});
  return out;
}

std::string refusal(const MaterialCurves& given) {
  try {
    fit_curves(given);
  } catch (const CaseError& e) {
    return e.what();
  }
  return "";
}

TEST(MaterialFit, HalfALoopIsRefused) {
  EXPECT_NE(refusal(curves(loop(true, false))).find("the points go up only: give both branches"), std::string::npos);
  EXPECT_NE(refusal(curves(loop(false, true))).find("the points go down only: give both branches"), std::string::npos);
  EXPECT_EQ(refusal(curves(loop())), "");
}

TEST(MaterialFit, ALoopIsTakenInEitherSenseAndFromAnyPoint) {
  const MaterialFit forward = fit_curves(curves(loop()));
  EXPECT_NEAR(forward.whole.law.yield, 300 * kMPa, 3 * kMPa);
  std::vector<CurvePoint> back = loop();
  std::reverse(back.begin(), back.end());
  std::rotate(back.begin(), back.begin() + 13, back.end());
  const MaterialFit backward = fit_curves(curves(back));
  EXPECT_NEAR(backward.whole.law.yield, forward.whole.law.yield, 1e-6 * kMPa);
  EXPECT_NEAR(backward.whole.law.modulus[0], forward.whole.law.modulus[0], kMPa);
}

TEST(MaterialFit, ACardThatACaseRefusesIsNotWritten) {
  PlasticParameters<double> law = known_law();
  EXPECT_NO_THROW(parse_case(material_card({}, law, {}), "a.toml"));
  law.yield = 0.078 * kMPa;
  EXPECT_THROW(material_card({}, law, {}), CaseError);
}

TEST(MaterialFit, CompressionIsTakenByItsMagnitude) {
  MaterialCurves pulled = curves(loop()), pressed = curves(loop());
  pulled.monotonic = tension(100);
  pressed.monotonic = tension(100, -1);
  const MaterialFit a = fit_curves(pulled), b = fit_curves(pressed);
  EXPECT_EQ(a.whole.law.saturation, b.whole.law.saturation);
  EXPECT_NEAR(a.whole.law.saturation, 60 * kMPa, 3 * kMPa);
  EXPECT_TRUE(a.notes.empty()) << a.notes.front();
  ASSERT_EQ(b.notes.size(), 1u);
  EXPECT_NE(b.notes[0].find("compression"), std::string::npos);
}

TEST(MaterialFit, ARateAtTheEdgeOfItsSearchIsTold) {
  MaterialCurves given = curves(loop());
  given.monotonic = tension(0.2);  // hardly begins to settle within 4 %
  const MaterialFit fit = fit_curves(given);
  ASSERT_EQ(fit.notes.size(), 1u) << fit.whole.law.rate;
  EXPECT_NE(fit.notes[0].find("edge of its search"), std::string::npos) << fit.notes[0];
}

TEST(MaterialFit, StrainsThatLookLikePercentsAreTold) {
  std::vector<CurvePoint> amplitudes;
  for (const double e : {0.02, 0.03, 0.04, 0.07}) amplitudes.push_back({e, amplitude_of(known_law(), e)});
  const MaterialFit doubtful = fit_curves(curves(amplitudes, false));
  ASSERT_EQ(doubtful.notes.size(), 1u);
  EXPECT_NE(doubtful.notes[0].find("some per cent off; percents need their unit"), std::string::npos);
  amplitudes.push_back({0.45, amplitude_of(known_law(), 0.45)});
  const MaterialFit none = fit_curves(curves(amplitudes, false));
  ASSERT_EQ(none.notes.size(), 1u);
  EXPECT_NE(none.notes[0].find("no claim"), std::string::npos);
}

TEST(MaterialFit, FurtherColumnsAreLeftAndNamed) {
  std::vector<std::string> notes;
  const std::vector<CurvePoint> points = read_test_curve("specimen, time_s, strain, stress_MPa\nA1, 0, 0.002, 210\n",
                                                         "a.csv", TestCurve::curve, kYoung, &notes);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_DOUBLE_EQ(points[0].plastic_strain, 0.001);
  EXPECT_EQ(notes, std::vector<std::string>{"a.csv: not read: specimen, time_s"});
  read_test_curve("strain, stress_MPa\n0.005, 400\n", "a.csv", TestCurve::amplitudes, kYoung, &notes);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("strain, stress_MPa are taken as amplitudes"), std::string::npos) << notes[0];
}

TEST(MaterialFit, AWrongColumnIsAnsweredWithThisTablesColumns) {
  for (const char* text : {"strain, stres_MPa\n0.005, 400\n", "0.005, 400\n0.006, 500\n"}) {
    try {
      read_test_curve(text, "a.csv", TestCurve::curve, kYoung);
      FAIL() << text;
    } catch (const CaseError& e) {
      EXPECT_NE(std::string(e.what()).find("strain, stress_MPa"), std::string::npos) << e.what();
      EXPECT_EQ(std::string(e.what()).find("tractive_force"), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace railstrata
