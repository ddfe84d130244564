// Edge cracks through layers against another program: CalculiX, by calculix_edge_crack.py next to this file.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "crack/crack_faces.hpp"
#include "crack/layered_dislocation.hpp"

namespace railstrata {
namespace {

using std::numbers::pi;

constexpr double kLayer = 1e-3, kYoung = 210e9;

/// K_I over sigma sqrt(pi c) of a crack normal to the surface, the body stretched along it: sigma below, sigma E1/E0 in
/// the layer.
double stretched(double length, double ratio, int points) {
  const LayeredHalfSpace body{{{.thickness = kLayer, .material = {ratio * kYoung, 0.3}}}, {kYoung, 0.3}};
  CrackFaces faces({.kind = CrackKind::mouth, .angle = pi / 2, .length = length}, body, points);
  std::vector<LineTraction> applied;
  for (const double place : faces.places()) applied.push_back({place < kLayer ? 1e6 * ratio : 1e6, 0});
  return faces.load(applied, 0, 0).end.I / (1e6 * std::sqrt(pi * length));
}

TEST(CrackLayers, AgreeWithFiniteElements) {
  struct Row {
    double length, ratio, elements, within;
  };
  // across a border elements are 3 % wide there, and the density of dislocations has a kink
  for (const Row& row : {Row{0.5e-3, 0.5, 0.5251, 0.005}, Row{0.5e-3, 2, 2.4251, 0.002}, Row{0.9e-3, 2, 2.7529, 0.002},
                         Row{1.5e-3, 1.2, 1.2030, 0.01}, Row{1.5e-3, 2, 1.5031, 0.02}})
    EXPECT_NEAR(stretched(row.length, row.ratio, 24), row.elements, row.within * row.elements)
        << row.length << " " << row.ratio;
}

TEST(CrackLayers, PointsConvergeInsideALayer) {
  for (const double ratio : {0.5, 1.2, 2.0})
    EXPECT_NEAR(stretched(0.9e-3, ratio, 12), stretched(0.9e-3, ratio, 32), 1e-3) << ratio;
}

/// A cover of no stiffness is a free surface at its foot.
TEST(CrackLayers, SoftCoverIsAFreeSurface) {
  const LayeredHalfSpace covered{{{.thickness = 0.3e-3, .material = {2e3, 0.3}}}, {kYoung, 0.3}},
      bare{{}, {kYoung, 0.3}};
  const auto inside = [](double depth) {
    return CrackLine{.kind = CrackKind::inside, .angle = 0.5, .length = 1e-3, .depth = depth};
  };
  CrackFaces a(inside(0.6e-3), covered, 16), b(inside(0.3e-3), bare, 16);
  const std::vector<LineTraction> applied(a.places().size(), {1e6, 0.5e6});
  const CrackFaces::Faces under = a.load(applied, 0, 0), free = b.load(applied, 0, 0);
  EXPECT_NEAR(under.end.I, free.end.I, 1e-4 * free.end.I);
  EXPECT_NEAR(under.end.II, free.end.II, 1e-4 * free.end.I);
}

TEST(CrackLayers, LayersOfOneMetalAddNothing) {
  const LayeredHalfSpace same{{{.thickness = kLayer, .material = {kYoung, 0.3}}}, {kYoung, 0.3}};
  EXPECT_EQ(layers_traction(same, 1, {{0, 1e-3}}, {{0, 2e-3}}, 1e-4).size(), 0);
}

}  // namespace
}  // namespace railstrata
