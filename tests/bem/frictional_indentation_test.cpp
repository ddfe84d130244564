// Normal loading with friction of dissimilar bodies: the stick circle that Spence found, and what it asks of the
// loading's history.
#include "bem/rolling_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "half_space_pair.hpp"

namespace railstrata {
namespace {

/// A rigid indenter on a half-space. beta = (1 - 2 nu)/(2 (1 - nu)) is Dundurs' constant: the share of the normal in
/// the tangential compliance.
struct RigidOn {
  HalfSpaceMaterial body;
  PatchGrid grid;
  InfluenceOperator influence;
  double radius;  // of the punch, and nearly of the sphere's contact
  RigidOn(double beta, int cells)
      : body{100e9, (1 - 2 * beta) / (2 - 2 * beta)},
        grid(centred_grid(cells + 2, cells + 2, 1e-3 / cells, 1e-3 / cells)),
        influence(homogeneous_compliance(body), grid.nx, grid.ny, grid.dx, grid.dy),
        radius(1e-3) {}

  RollingContact punch(double friction) const {
    RollingContact c = shift(friction);
    for (int i = 0; i < grid.nx; ++i)
      for (int j = 0; j < grid.ny; ++j)
        c.gap[grid.index(i, j)] = std::hypot(grid.x(i), grid.y(j)) < radius ? 0.0 : 0.05;
    return c;
  }
  RollingContact sphere(double friction) const {
    RollingContact c = shift(friction);
    c.gap = quadratic_gap(grid, 0.5, 0.5);
    return c;
  }
  /// Loads in equal steps of the contact radius, each from the state before.
  RollingSolution load_in_steps(RollingContact c, int steps) const {
    const double full = 0.96 * 4 * body.young / (1 - body.poisson * body.poisson) * radius * radius * radius / 3;
    RollingSolution s;
    for (int n = 1; n <= steps; ++n) {
      c.target.load = full * std::pow(static_cast<double>(n) / steps, 3);
      if (n > 1) shift_on(influence, grid, s, c);
      s = solve_rolling(influence, grid, c, {}, n > 1 ? &s : nullptr);
    }
    return s;
  }

 private:
  RollingContact shift(double friction) const {
    RollingContact c;
    c.gap.resize(grid.size());
    c.target.load = 1000;
    c.friction = friction;
    c.kind = RollingKind::shift;
    return c;
  }
};

/// Stick over contact radius, from the areas.
double stick_ratio(const RollingSolution& s) {
  return std::sqrt(s.tangential.stick_area / (s.tangential.stick_area + s.tangential.slip_area));
}

/// c/a from (a/2c) ln((a + c)/(a - c)) = (f/beta) K(sqrt(1 - c²/a²)): traction that follows the pressure, not the
/// pressure that gives way to it; right to the order beta².
double uncoupled_stick_ratio(double friction, double beta) {
  double low = 1e-9, high = 1 - 1e-12;
  for (int i = 0; i < 100; ++i) {
    const double c = 0.5 * (low + high);
    (std::log((1 + c) / (1 - c)) / (2 * c) < friction / beta * std::comp_ellint_1(std::sqrt(1 - c * c)) ? low : high) =
        c;
  }
  return low;
}

// [Spence1975]. The load of a punch changes no boundary of stick and slip: one step is enough.
TEST(FrictionalIndentation, StickCircleOfAFlatPunchMeetsSpenceForWeakCoupling) {
  const double beta = 0.05;
  const RigidOn body(beta, 40);
  for (double friction : {0.5 * beta, beta, 2 * beta}) {
    const RollingSolution s = solve_rolling(body.influence, body.grid, body.punch(friction));
    EXPECT_NEAR(stick_ratio(s) / uncoupled_stick_ratio(friction, beta), 1, 0.01) << friction;
  }
}

// [Spence1968]: without slip dP/ddelta of a contact of any shape is ln((1 + beta)/(1 - beta))/(2 beta) times the
// frictionless 2 E* a. The staircase of cells cancels.
TEST(FrictionalIndentation, StickingPunchIsStifferThanASmoothOneBySpencesFactor) {
  const double beta = 2.0 / 7;  // nu = 0.3
  const RigidOn body(beta, 40);
  const double smooth = solve_rolling(body.influence, body.grid, body.punch(0)).normal.approach,
               sticking = solve_rolling(body.influence, body.grid, body.punch(3)).normal.approach;
  EXPECT_NEAR(smooth / sticking, std::log((1 + beta) / (1 - beta)) / (2 * beta), 1e-3);
}

// [Spence1975]: stick over contact radius is the same for every load and every indenter that grows self-similarly, a
// punch among them; also for strong coupling.
TEST(FrictionalIndentation, ALoadedSphereTendsToThePunchsStickRatioInFirstOrder) {
  const double friction = 0.2;
  const RigidOn body(2.0 / 7, 30);
  const double punch = stick_ratio(solve_rolling(body.influence, body.grid, body.punch(friction)));
  const double eight = stick_ratio(body.load_in_steps(body.sphere(friction), 8)),
               sixteen = stick_ratio(body.load_in_steps(body.sphere(friction), 16));
  EXPECT_NEAR((punch - eight) / (punch - sixteen), 2, 0.4) << "first order in the step";
  EXPECT_NEAR((2 * sixteen - eight) / punch, 1, 0.01);
}

TEST(FrictionalIndentation, LoadingInOneStepIsAnotherProblem) {
  const double friction = 0.2;
  const RigidOn body(2.0 / 7, 30);
  EXPECT_LT(stick_ratio(body.load_in_steps(body.sphere(friction), 1)),
            0.6 * stick_ratio(body.load_in_steps(body.sphere(friction), 16)));
}

}  // namespace
}  // namespace railstrata
