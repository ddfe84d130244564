// Level cracks, in one metal and along an interface, against closed forms [RiceSih1965; HutchinsonSuo1992] and another
// program: CalculiX, by calculix_interface_crack.py next to this file.
#include "crack/level_crack.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "crack/crack_faces.hpp"

namespace railstrata {
namespace {

using std::numbers::pi;

constexpr double kDepth = 1e-3;
const HalfSpaceMaterial kSteel{210e9, 0.3};

LayeredHalfSpace below_layer(double ratio, double depth = kDepth) {
  return {{{.thickness = depth, .material = {ratio * kSteel.young, kSteel.poisson}}}, kSteel};
}

CrackLine level(double length, double depth = kDepth) {
  return {.kind = CrackKind::inside, .angle = 0, .length = length, .depth = depth};
}

struct Found {
  CrackFaces::Faces faces;
  double release = 0, phase = 0;  ///< J/m², rad, at the end
};
Found under(const CrackLine& line, const LayeredHalfSpace& body, const LineTraction& load, double friction = 0) {
  CrackFaces faces(line, body, 24);
  Found out{faces.load(std::vector<LineTraction>(faces.places().size(), load), friction, 0)};
  const StressIntensity& k = out.faces.end;
  out.release = (k.I * k.I + k.II * k.II) / faces.modulus();
  out.phase = std::atan2(k.II, k.I);
  return out;
}

TEST(LevelCrack, InOneMetalItIsACrackInsideAtNoAngle) {
  for (const double length : {0.5e-3, 2e-3, 4e-3}) {
    CrackLine inclined = level(length);
    inclined.angle = 1e-7;
    const Found a = under(level(length), below_layer(1), {1e6, 0.5e6}), b = under(inclined, {{}, kSteel}, {1e6, 0.5e6});
    EXPECT_NEAR(a.faces.end.I, b.faces.end.I, 1e-5 * b.faces.end.I);
    EXPECT_NEAR(a.faces.end.II, b.faces.end.II, 1e-5 * b.faces.end.I);
    EXPECT_NEAR(a.faces.start->I, b.faces.start->I, 1e-5 * b.faces.end.I);
    EXPECT_NEAR(a.faces.start->II, b.faces.start->II, 1e-5 * b.faces.end.I);
  }
}

/// K L^(iε) = σ sqrt(πa) (1 + 2iε) (L/2a)^(iε), G = (1 - β²) |K|²/E*.
TEST(LevelCrack, BetweenTwoHalfPlanesOfUnlikeMetals) {
  const double a = 1e-3, nu = kSteel.poisson;
  for (const double ratio : {0.5, 1.2, 2.0, 5.0, 20.0}) {
    const CrackLine line = level(2 * a, 1e3);
    const LayeredHalfSpace body = below_layer(ratio, 1e3);
    const double beta = (ratio - 1) / (ratio + 1) * (1 - 2 * nu) / (2 * (1 - nu)),
                 epsilon = std::log((1 - beta) / (1 + beta)) / (2 * pi);
    const double star = 2 * kSteel.young / ((1 - nu * nu) * (1 + 1 / ratio));
    EXPECT_NEAR(CrackFaces(line, body, 12).modulus() * (1 - beta * beta) / star, 1, 1e-9);
    const double exact = (1 - beta * beta) / star * 1e12 * pi * a * (1 + 4 * epsilon * epsilon);
    const Found tension = under(line, body, {1e6, 0});
    EXPECT_NEAR(tension.release, exact, 0.003 * exact) << ratio;
    // here K_II moves the lower side to the end: the other way round
    const double phase = std::atan(2 * epsilon) + epsilon * std::log(reference_length(line) / (2 * a));
    EXPECT_NEAR(-tension.phase, phase, 0.01) << ratio;
  }
}

/// Where shear presses the faces together, they slip.
TEST(LevelCrack, FrictionTakesShearAway) {
  const double unit = 1e6 * std::sqrt(pi * 1e-3), f = 0.3;
  const Found slips = under(level(2e-3, 1e3), below_layer(1, 1e3), {-100e6, 80e6}, f);
  EXPECT_NEAR(slips.faces.end.II / unit, 80 - f * 100, 1e-5);
  EXPECT_EQ(under(level(2e-3), below_layer(2), {-100e6, 20e6}, f).release, 0);
}

/// The limit for long cracks from lengths of 5, 10 and 20 depths, each half of the next: with y = y0 + y1 h/l + y2
/// (h/l)².
double long_limit(const std::array<double, 3>& of) { return (4 * (2 * of[2] - of[1]) - (2 * of[1] - of[0])) / 3; }

/// A clamped plate above a half-plane: G = 6 M²/(Ē1 h³), M = p l²/12; in one metal the phase is 90 degrees - 52.07.
TEST(LevelCrack, LongCracksAreThoseOfAPlate) {
  constexpr double kPhase = (90 - 52.07) * pi / 180, p = 1e6;
  for (const double ratio : {1.0, 2.0}) {
    const double plane = ratio * kSteel.young / (1 - kSteel.poisson * kSteel.poisson);
    std::array<double, 3> bent{}, phase{};
    for (std::size_t i = 0; i < 3; ++i) {
      const double length = kDepth * 5 * (1 << i), M = p * length * length / 12;
      const Found opens = under(level(length), below_layer(ratio), {p, 0});
      bent[i] = std::pow(opens.release / (6 * M * M / (plane * kDepth * kDepth * kDepth)), 0.25);
      phase[i] = std::abs(opens.phase);
    }
    EXPECT_NEAR(std::pow(long_limit(bent), 4), 1, 0.02) << ratio;
    if (ratio == 1) {
      EXPECT_NEAR(long_limit(phase), kPhase, 0.01);
    }
  }
}

struct Pressed {
  double half, ratio, elements;
};
TEST(LevelCrack, FacesPressedApartAgreeWithFiniteElements) {
  for (const Pressed& row : {Pressed{0.25e-3, 1, 1.0902}, Pressed{1e-3, 1, 2.3101}, Pressed{1e-3, 0.5, 3.7314},
                             Pressed{1e-3, 2, 1.5550}, Pressed{2e-3, 2, 3.7956}}) {
    const Found found = under(level(2 * row.half), below_layer(row.ratio), {1e6, 0});
    const double unit = 1e12 * pi * row.half * (1 - kSteel.poisson * kSteel.poisson) / kSteel.young;
    EXPECT_NEAR(found.release / unit, row.elements, 0.01 * row.elements) << row.half << " " << row.ratio;
  }
}

TEST(LevelCrack, AStripInTensionGivesUpAllOfItsEnergy) {
  EXPECT_NEAR(strip_release(kSteel, 2e-3, 150e6), 150e6 * 150e6 * 2e-3 * 0.91 / (2 * 210e9), 1e-9);
}

}  // namespace
}  // namespace railstrata
