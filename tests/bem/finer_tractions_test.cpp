// Tractions that run on between the cells of a contact instead of in steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bem/subsurface.hpp"
#include "material/elastic.hpp"
#include "tests/damage/hertz_stress.hpp"

namespace railstrata {
namespace {

constexpr HalfSpaceMaterial kUnit{2.6, 0.3};
constexpr double kFriction = 0.3;

/// A circle of radius 1 that slides under the pressure of Hertz, in so many cells of its radius.
Subsurface sliding(double cells) {
  const int half = static_cast<int>(1.6 * cells);
  PatchGrid g = centred_grid(half, half, 1 / cells, 1 / cells);
  Plane p(g.size()), q_x(g.size());
  for (std::size_t k = 0; k < g.size(); ++k) {
    p[k] = std::sqrt(std::max(0.0, 1 - std::pow(g.x_of(k), 2) - std::pow(g.y_of(k), 2)));
    q_x[k] = kFriction * p[k];
  }
  return {{{}, kUnit}, g, p, q_x, Plane(g.size())};
}

/// Largest difference of a von Mises stress from the closed form along the middle at a depth, over the largest
/// pressure.
double error_of(const Subsurface& body, double depth) {
  const testing::HertzLoad load{1, 1, kFriction, kUnit.poisson};
  const StatePlane plane = body.plane(depth);
  double worst = 0;
  for (double x = -1.3; x <= 1.3; x += 0.05) {
    const Vec3 at{x, 0, depth};
    const Sym3 exact = load.stresses({at}).front(), is = body.stress_at(plane, at);
    worst = std::max(worst, std::abs(von_mises(is) - von_mises(exact)));
  }
  return worst;
}

TEST(FinerTractions, CoarseCellsHaveTheStressOfTheEdges) {
  const Subsurface coarse = sliding(7);
  const auto finer = coarse.refined(3);
  for (const double depth : {0.02, 0.05, 0.1}) {
    EXPECT_GT(error_of(coarse, depth), 0.05) << "steps lose it";
    EXPECT_LT(error_of(*finer, depth), 0.5 * error_of(coarse, depth));
    EXPECT_LT(error_of(*finer, depth), 0.05);
  }
  EXPECT_LT(error_of(*finer, 0.5), 0.015);
}

}  // namespace
}  // namespace railstrata
