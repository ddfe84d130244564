// Heights along rail and wheel: closed forms of the shapes, their slopes by differences, sums, and the wheel's turn.
#include "geometry/height_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace railstrata {
namespace {

constexpr double kRadius = 0.43;

Irregularity with(const IrregularityShape& shape, BodyId on = BodyId::rail) {
  return {.on = on, .at = 0.1, .width = {}, .offset = 0, .shape = shape};
}

HeightField field_of(const Irregularity& is) { return {{is}, is.on, kRadius}; }

Irregularity hollow() {
  Indentation h;
  h.length = 20e-3;
  h.depth = 0.2e-3;
  return with(h);
}
Irregularity waves() {
  Corrugation w;
  w.wavelength = 40e-3;
  w.depth = 20e-6;
  w.from = 0.0;
  w.to = 0.5;
  return with(w);
}
Irregularity dip(RampShape form) {
  Dip d;
  d.angle = 10e-3;
  d.shape = form;
  return with(d);
}
Irregularity step(double height, double length = 12e-3) {
  Step s;
  s.length = length;
  s.height_behind = height;
  return with(s);
}
Irregularity chord() {
  Flat f;
  f.length = 60e-3;
  return with(f, BodyId::wheel);
}
Irregularity oval() {
  OutOfRound o;
  o.depth = 0.3e-3;
  o.order = 6;
  return with(o, BodyId::wheel);
}
Irregularity rough(int seed) {
  Roughness r;
  r.rms = 3e-6;
  r.shortest = 10e-3;
  r.longest = 100e-3;
  r.seed = seed;
  return with(r);
}
Irregularity measured_levels() {
  RoughnessLevels r;
  r.wavelengths = {20e-3, 50e-3};
  r.levels = {0, 20};  // 1 and 10 um
  return with(r);
}
Irregularity points(double smoothing = 0) {
  HeightPoints p;
  p.smoothing = smoothing;
  for (int i = 0; i <= 40; ++i)
    for (const double y : {-5e-3, 5e-3}) {
      p.x.push_back(1e-3 * i);
      p.y.push_back(y);
      p.z.push_back((y > 0 ? 2e-5 : 1e-5) * std::sin(1e-3 * i / 6e-3));
    }
  return with(p);
}

TEST(RoughnessLevels, EachBandHasTheRootMeanSquareOfItsLevel) {
  const Irregularity is = measured_levels();
  const Heights height = std::visit([](const auto& shape) { return shape.height(0, 0.46); }, is.shape);
  constexpr int kPoints = 200000;
  constexpr double kStep = 0.5e-3;  // m
  // squares of bands add up
  double square = 0;
  for (int i = 0; i < kPoints; ++i) square += height(kStep * i, 0).z * height(kStep * i, 0).z / kPoints;
  EXPECT_NEAR(std::sqrt(square), std::sqrt(1e-12 + 100e-12), 0.02e-6);
  EXPECT_NEAR(std::get<RoughnessLevels>(is.shape).shortest_wave(0.46), 20e-3 / std::pow(2, 1.0 / 6), 1e-12);
}

TEST(HeightField, ShapesHaveTheirClosedForms) {
  EXPECT_NEAR(field_of(hollow()).at(0.1, 0).z, -0.2e-3, 1e-12);
  EXPECT_NEAR(field_of(hollow()).at(0.105, 7e-3).z, -0.1e-3, 1e-12);
  EXPECT_EQ(field_of(hollow()).at(0.1101, 0).z, 0);
  EXPECT_NEAR(field_of(waves()).at(0.3, 0).z, 10e-6, 1e-15) << "a crest";
  EXPECT_NEAR(field_of(waves()).at(0.02, 0).z, 5e-6, 1e-15) << "half eased in, a crest again";
  EXPECT_NEAR(field_of(dip(RampShape::parabola)).at(0.1, 0).z, -2.5e-3, 1e-12);
  EXPECT_NEAR(field_of(dip(RampShape::parabola)).at(0.6, 0).z, -0.625e-3, 1e-12);
  EXPECT_NEAR(field_of(dip(RampShape::line)).at(0.6, 0).z, -2.5e-3, 1e-12);
  EXPECT_EQ(field_of(step(0.5e-3)).at(0.094, 0).z, 0);
  EXPECT_NEAR(field_of(step(0.5e-3)).at(0.1, 0).z, 0.25e-3, 1e-12);
  EXPECT_NEAR(field_of(step(0.5e-3)).at(0.103, 0).z, 0.25e-3 * (1 + std::sqrt(0.5)), 1e-12);
  EXPECT_EQ(field_of(step(-0.5e-3)).at(0.5, 0).z, -0.5e-3) << "the next rail";
  EXPECT_NEAR(field_of(chord()).at(0.1, 0).z, -60e-3 * 60e-3 / (8 * kRadius), 1e-12);
  EXPECT_NEAR(field_of(oval()).at(0.1 + std::numbers::pi * kRadius / 6, 0).z, -0.15e-3, 1e-12);
}

// A difference over 2e-7 m errs by its square over 6 times the third derivative: below 1e-9 of the steepest here.
TEST(HeightField, SlopesAreTheDerivativesOfTheHeights) {
  constexpr double kStep = 1e-7;
  for (const Irregularity& is : {hollow(), waves(), dip(RampShape::parabola), dip(RampShape::line), step(-0.3e-3),
                                 chord(), oval(), rough(1), points()}) {
    const HeightField field = field_of(is);
    double most = 0;
    for (int i = 0; i < 400; ++i) {
      const double x = 0.0701 + 0.183e-3 * i, y = 2e-3;
      const double slope = (field.at(x + kStep, y).z - field.at(x - kStep, y).z) / (2 * kStep);
      EXPECT_NEAR(field.at(x, y).along, slope, 2e-7) << is.shape.index() << " at " << x;
      most = std::max(most, std::abs(slope));
    }
    EXPECT_LE(most, 1.001 * steepest_slope(is, kRadius)) << is.shape.index();
    EXPECT_GE(most, 0.3 * steepest_slope(is, kRadius)) << is.shape.index();
  }
}

TEST(HeightField, AcrossItFallsOffAsACosine) {
  Irregularity is = hollow();
  is.width = 30e-3;
  is.offset = 2e-3;
  const HeightField field = field_of(is);
  EXPECT_NEAR(field.at(0.1, 2e-3).z, -0.2e-3, 1e-12);
  EXPECT_NEAR(field.at(0.1, 9.5e-3).z, -0.1e-3, 1e-12);
  EXPECT_EQ(field.at(0.1, 17.1e-3).z, 0);
}

TEST(HeightField, AddsUpThoseOfOneBody) {
  const HeightField field({hollow(), waves(), oval()}, BodyId::rail, kRadius);
  EXPECT_NEAR(field.at(0.1, 0).z, -0.2e-3 + 10e-6, 1e-12);
  EXPECT_TRUE(HeightField({oval()}, BodyId::rail, kRadius).none());
}

TEST(HeightField, OnTheWheelComesAgainAfterATurn) {
  const double turn = 2 * std::numbers::pi * kRadius;
  for (const int n : {-1, 1, 3})
    EXPECT_NEAR(field_of(chord()).at(0.11 + n * turn, 0).z, field_of(chord()).at(0.11, 0).z, 1e-12);
}

// The mean square over 400 of the longest waves is good to a few per cent; with 200 waves of a density k^-2.
TEST(HeightField, RoughnessHasItsRootMeanSquareAndOneSurfaceForASeed) {
  const HeightField field = field_of(rough(1)), same = field_of(rough(1)), other = field_of(rough(2));
  double square = 0;
  constexpr int kSamples = 40000;
  for (int i = 0; i < kSamples; ++i) square += std::pow(field.at(1e-3 * i, 0).z, 2);
  EXPECT_NEAR(std::sqrt(square / kSamples), 3e-6, 0.05 * 3e-6);
  EXPECT_EQ(field.at(0.2, 0).z, same.at(0.2, 0).z);
  EXPECT_NE(field.at(0.2, 0).z, other.at(0.2, 0).z);
}

// Cubics through a sine of 37.7 mm at 1 mm: the error is of third order at the ends, 1e-3 of the amplitude.
TEST(HeightField, AFileIsInterpolatedAndItsEndsGoOn) {
  const HeightField field = field_of(points());
  EXPECT_NEAR(field.at(0.1 + 9.5e-3, 5e-3).z, 2e-5 * std::sin(9.5 / 6), 2e-8);
  EXPECT_NEAR(field.at(0.1 + 9.5e-3, 0).z, 1.5e-5 * std::sin(9.5 / 6), 2e-8);
  EXPECT_EQ(field.at(0.3, 5e-3).z, field.at(0.14, 5e-3).z);
  // the mean of cos(k x) with weights 1 + cos(2 pi x/L): sin(u)/u / (1 - (u/pi)^2), u = k L/2
  const double u = 0.5, factor = std::sin(u) / u / (1 - u * u / (std::numbers::pi * std::numbers::pi));
  EXPECT_NEAR(field_of(points(6e-3)).at(0.1 + 15e-3, 5e-3).z, factor * 2e-5 * std::sin(2.5), 1e-3 * 2e-5);
}

// A rigid wheel touches a sharp step of 0.5 mm from sqrt(2 R h) before it on; one of a long ramp where its slope is.
TEST(HeightField, AWheelReachesForAStep) {
  EXPECT_NEAR(contact_reach({step(0.5e-3)}, kRadius), std::sqrt(2 * kRadius * 0.5e-3), 1e-12);
  EXPECT_NEAR(contact_reach({step(-0.5e-3)}, kRadius), std::sqrt(2 * kRadius * 0.5e-3), 1e-12);
  const Irregularity ramp = step(0.5e-3, 0.1);
  EXPECT_NEAR(contact_reach({ramp}, kRadius), kRadius * steepest_slope(ramp, kRadius), 1e-12);
}

}  // namespace
}  // namespace railstrata
