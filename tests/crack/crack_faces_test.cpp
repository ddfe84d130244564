// Closed forms and tables of straight cracks: [Murakami1987] for the inclined edge crack.
#include "crack/crack_faces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace railstrata {
namespace {

using std::numbers::pi;

const LayeredHalfSpace kSteel{{}, {210e9, 0.3}};

CrackFaces::Faces under(const CrackLine& line, int points, const PlaneStress& stress, double friction = 0,
                        double fluid = 0) {
  CrackFaces faces(line, kSteel, points);
  const std::vector<LineTraction> applied(faces.places().size(), traction_on(stress, line.angle));
  return faces.load(applied, friction, fluid);
}

CrackLine edge(double degrees) { return {.kind = CrackKind::mouth, .angle = degrees * pi / 180, .length = 1e-3}; }

CrackLine deep_inside(double degrees) {
  return {.kind = CrackKind::inside, .angle = degrees * pi / 180, .length = 2e-3, .depth = 1e3};
}

TEST(CrackFaces, EdgeCrackUnderTension) {
  constexpr double kExact = 1.12152226;  // of sigma sqrt(pi a) [TadaParisIrwin2000]
  const double unit = 1e6 * std::sqrt(pi * 1e-3);
  EXPECT_NEAR(under(edge(90), 8, {1e6, 0, 0}).end.I / unit, kExact, 1e-4);
  EXPECT_NEAR(under(edge(90), 16, {1e6, 0, 0}).end.I / unit, kExact, 2e-6);
  EXPECT_NEAR(under(edge(90), 24, {1e6, 0, 0}).end.II, 0, 1);
}

TEST(CrackFaces, InclinedEdgeCrackAgainstTables) {
  struct Row {
    double degrees, I, II;
  };
  const double unit = 1e6 * std::sqrt(pi * 1e-3);
  for (const Row& row : {Row{60, 0.921, 0.305}, Row{45, 0.705, 0.364}, Row{30, 0.462, 0.336}}) {
    const CrackFaces::Faces found = under(edge(row.degrees), 24, {1e6, 0, 0});
    EXPECT_NEAR(found.end.I / unit, row.I, 0.01 * row.I) << row.degrees;
    EXPECT_NEAR(-found.end.II / unit, row.II, 0.01 * row.II) << row.degrees;
  }
}

TEST(CrackFaces, PointsConverge) {
  const CrackFaces::Faces fine = under(edge(25), 48, {1e6, 0, 0});
  double last = 1;
  for (const int points : {8, 12, 18, 27}) {
    const CrackFaces::Faces found = under(edge(25), points, {1e6, 0, 0});
    const double error = std::hypot(found.end.I - fine.end.I, found.end.II - fine.end.II) / fine.end.I;
    EXPECT_LT(error, last);
    last = error;
  }
  EXPECT_LT(last, 1e-4);
}

TEST(CrackFaces, CentreCrackUnderTensionAndShear) {
  const double unit = 1e6 * std::sqrt(pi * 1e-3);
  const CrackFaces::Faces found = under(deep_inside(0), 12, {0, 1e6, 2e6});
  ASSERT_TRUE(found.start);
  EXPECT_NEAR(found.end.I / unit, 1, 1e-6);
  EXPECT_NEAR(found.start->I / unit, 1, 1e-6);
  EXPECT_NEAR(found.end.II / unit, 2, 1e-6);
  EXPECT_NEAR(found.open, 1, 1e-12);
}

TEST(CrackFaces, FrictionOfACentreCrack) {
  const double unit = 1e6 * std::sqrt(pi * 1e-3), f = 0.3;
  const CrackFaces::Faces slips = under(deep_inside(0), 12, {0, -100e6, 80e6}, f);
  EXPECT_NEAR(slips.end.II / unit, 80 - f * 100, 1e-5);
  EXPECT_EQ(slips.end.I, 0);
  EXPECT_NEAR(slips.slipping, 1, 1e-12);
  EXPECT_EQ(under(deep_inside(0), 12, {0, -100e6, 25e6}, f).end.II, 0);
}

/// Back to no load friction keeps half of what the load has brought: τ - f p falls by 2 f p before it slips back.
TEST(CrackFaces, SlipRemembers) {
  const double f = 0.3;
  CrackFaces faces(deep_inside(0), kSteel, 12);
  const auto load = [&](double shear) {
    return faces.load(std::vector<LineTraction>(faces.places().size(), {-100e6, shear}), f, 0).end.II /
           (1e6 * std::sqrt(pi * 1e-3));
  };
  EXPECT_NEAR(load(80e6), 50, 1e-4);
  EXPECT_NEAR(load(40e6), 50, 1e-4);   // 40 = 80 - 40 < 2 f p: it sticks
  EXPECT_NEAR(load(-20e6), 10, 1e-4);  // -20 + f p = 10
}

TEST(CrackFaces, FluidOpensAsTensionDoes) {
  const CrackFaces::Faces wet = under(edge(30), 16, {}, 0.2, 50e6), pulled = under(edge(30), 16, {50e6, 50e6, 0}, 0.2);
  EXPECT_NEAR(wet.end.I, pulled.end.I, 1e-9 * pulled.end.I);
  EXPECT_NEAR(wet.end.II, pulled.end.II, 1e-9 * pulled.end.I);
  EXPECT_GT(wet.volume, 0);
}

/// A crack of one metal does not know how the layers' moduli are called.
TEST(CrackFaces, LayersOfOneMetalChangeNothing) {
  const LayeredHalfSpace same{{{.thickness = 0.3e-3, .material = {210e9, 0.3}}}, {210e9, 0.3}};
  CrackFaces a(edge(40), same, 16), b(edge(40), kSteel, 16);
  const std::vector<LineTraction> applied(a.places().size(), {1e6, 0.3e6});
  EXPECT_NEAR(a.load(applied, 0.2, 0).end.II, b.load(applied, 0.2, 0).end.II, 1e-6);
}

}  // namespace
}  // namespace railstrata
