// Rolling under friction that falls with slip, against closed forms of our own.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "bem/rolling_contact.hpp"
#include "core/faults.hpp"
#include "half_space_pair.hpp"
#include "tests/halfspace/classical_rolling.hpp"

namespace railstrata {
namespace {

const FrictionForm kForms[] = {FrictionForm::falling_exponential, FrictionForm::falling_rational};

// Far beyond saturation every cell slips by nearly the creepage: F = f(V xi) N.
TEST(FallingFriction, FullSlidingCarriesTheCoefficientOfItsSlip) {
  const ReferenceContact c(1.2, 0.9, 0.5e-3);
  for (const FrictionForm form : kForms)
    for (const double creepage : {-0.6, 0.9}) {
      TangentialProblem p = c.rolling();
      p.falling = {form, 0.4, 2.0};
      p.speed = 10;
      p.x.creepage = creepage;
      const TangentialSolution s = solve_tangential(c.influence, c.grid, p);
      const double share = friction_share(p.falling, 10 * std::abs(creepage)).value;
      EXPECT_EQ(s.stick_area, 0);
      EXPECT_NEAR(s.force_x / (std::copysign(1, creepage) * share * c.kFriction * c.kLoad), 1, 1e-4) << creepage;
    }
}

/// Carter's cylinder, creepage over that of saturation in [0, 1], under friction that has lost the share `lost` of
/// itself at the slip s (over the creepage of saturation too), to first order in the loss: F/(f N).
///
/// With x = t a, Carter's stick zone is [2 xi - 1, 1] =: [c, 1], and behind it the surfaces slip by s(t) = sqrt((1 - t)
/// (c - t)). A traction Q taken away at t < c is answered by the stick zone: of the complex potential R(z)/(R(t) (z -
/// t)), R(z) = sqrt((z - 1)/(z - c)), has no real part on it, the traction is bounded at the leading edge and may have
/// the singularity of a moving front at c. Its behaviour at infinity gives the force Q/R(t), so that
///   F/(f N) = 1 - (1 - xi)² - (2/pi) ∫_{-1}^{c} lost(s(t)) sqrt(1 - t²) sqrt((c - t)/(1 - t)) dt.
template <class Lost>
double carter_with_falling_friction(double xi, Lost&& lost) {
  constexpr int n = 2000;
  const double c = 2 * xi - 1;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double t = -1 + (c + 1) * (i + 0.5) / n;
    sum += lost(std::sqrt((1 - t) * (c - t))) * std::sqrt((1 + t) * (c - t));
  }
  return 1 - (1 - xi) * (1 - xi) - 2 / std::numbers::pi * sum * (c + 1) / n;
}

/// The middle of a patch thirty times as wide as long is plane strain.
struct LongPatch {
  static constexpr double kA = 2e-3, kB = 60e-3, kLoad = 2e5, kFriction = 0.3;
  HertzGap gap = hertz_gap(kA, kB, contact_modulus(kSteel, kSteel), kLoad);
  PatchGrid grid = centred_grid(42, 40, kA / 40, kB / 38);
  InfluenceOperator influence{pair_of(kSteel, kSteel), grid.nx, grid.ny, grid.dx, grid.dy};
  double p0 = hertz_contact(gap.A, gap.B, contact_modulus(kSteel, kSteel), kLoad).p0;
  double saturation = -carter_rolling(kA, p0, 2 * gap.A, kFriction, 1).creepage;
  TangentialProblem problem;
  LongPatch() {
    problem.traction_bound =
        solve_normal(influence, grid, quadratic_gap(grid, gap.A, gap.B), {.load = kLoad, .approach = {}}).pressure;
    for (double& v : problem.traction_bound) v *= kFriction;
    problem.speed = 1 / saturation;  // so that velocities are creepages over that of saturation
  }
  double force(double xi, const FallingFriction& law) {
    problem.falling = law;
    problem.x.creepage = -xi * saturation;
    const TangentialSolution s = solve_tangential(influence, grid, problem);
    double sum = 0;
    for (int i = 0; i < grid.nx; ++i) sum -= s.q_x[grid.index(i, grid.ny / 2)] * grid.dx;
    return sum / (kFriction * p0 * kA * std::numbers::pi / 2);
  }
};

// The first order in the loss, from two losses: what is left is of the grid.
TEST(FallingFriction, CartersForceFallsAsTheClosedFormSays) {
  LongPatch patch;
  for (const FrictionForm form : kForms)
    for (const double xi : {0.5, 0.7, 0.9}) {
      const auto lost = [&](double share) {
        return patch.force(xi, {form, share, 1}) - patch.force(xi, FallingFriction{});
      };
      const double first_order = 4 * lost(0.95) - lost(0.9),  // of a loss of 0.1
          exact = carter_with_falling_friction(xi,
                                               [&](double s) {
                                                 return 1 - friction_share({form, 0.9, 1}, {s}).value;
                                               }) -
                  (1 - (1 - xi) * (1 - xi));
      EXPECT_NEAR(first_order / exact, 1, 0.02) << xi;
    }
}

// Where friction falls the creep curve has a largest force short of saturation.
TEST(FallingFriction, LargestForceAndItsCreepageMeetTheClosedForm) {
  LongPatch patch;
  const FallingFriction law{FrictionForm::falling_exponential, 0.8, 1};
  const auto largest = [](auto&& force) {
    double at = 0, best = 0;
    for (double xi = 0.7; xi < 1; xi += 0.01)
      if (const double f = force(xi); f > best) {
        best = f;
        at = xi;
      }
    return std::pair(at, best);
  };
  const auto [xi, force] = largest([&](double v) { return patch.force(v, law); });
  const auto [exact_xi, exact] = largest([&](double v) {
    return carter_with_falling_friction(v, [&](double s) { return 1 - friction_share(law, s).value; });
  });
  EXPECT_LT(exact_xi, 0.95);
  EXPECT_NEAR(xi, exact_xi, 0.03);
  EXPECT_NEAR(force, exact, 0.01);
}

// What the creepages and the spin put in is what friction takes.
TEST(FallingFriction, PowerOfForcesAndSpinIsDissipated) {
  const ReferenceContact c(1.2, 0.9, 0.5e-3);
  RollingContact p;
  p.gap = quadratic_gap(c.grid, 1.2, 0.9);
  p.target.load = c.kLoad;
  p.friction = c.kFriction;
  p.falling = {FrictionForm::falling_rational, 0.4, 0.15};
  p.speed = 20;
  p.x.creepage = -2e-3;
  p.y.creepage = 1.5e-3;
  p.spin = 0.4;
  const TangentialSolution s = solve_rolling(c.influence, c.grid, p).tangential;
  const double in = s.force_x * p.x.creepage + s.force_y * p.y.creepage + s.moment * p.spin;
  EXPECT_NEAR(s.dissipation / in, 1, 1e-3);
  EXPECT_GT(s.stick_area, 0);
  EXPECT_GT(s.slip_area, s.stick_area);
}

// The law holds in every cell of both schemes: what slips carries the coefficient of its own slip, what sticks at most
// that at rest.
TEST(FallingFriction, EveryCellObeysTheLaw) {
  const ReferenceContact c(1.2, 0.9, 0.5e-3);
  for (const LeadingEdge edge : {LeadingEdge::sub_cell, LeadingEdge::whole_cell})
    for (const FrictionForm form : kForms)
      for (const double spin : {0.0, 0.5}) {
        RollingContact p;
        p.gap = quadratic_gap(c.grid, 1.2, 0.9);
        p.target.load = c.kLoad;
        p.friction = c.kFriction;
        p.falling = {form, 0.3, 0.15};
        p.speed = 20;
        p.x.creepage = -1e-3;
        p.spin = spin;
        p.leading_edge = edge;
        const RollingSolution s = solve_rolling(c.influence, c.grid, p);
        const TangentialSolution& t = s.tangential;
        double largest = 0;
        for (std::size_t k = 0; k < c.grid.size(); ++k) {
          const double q = std::hypot(t.q_x[k], t.q_y[k]), slip = std::hypot(t.slip.x[k], t.slip.y[k]),
                       bound = p.friction * s.normal.pressure[k];
          if (t.state[k] == ContactState::stick) {
            EXPECT_LE(q, bound * (1 + 1e-9));
          }
          if (t.state[k] != ContactState::slip) continue;
          EXPECT_NEAR(q / (bound * friction_share(p.falling, p.speed * slip).value), 1, 1e-4);
          largest = std::max(largest, slip);
        }
        EXPECT_LT(friction_share(p.falling, p.speed * largest).value, 0.9) << "the law matters here";
      }
}

TEST(FallingFriction, AForceBelowTheLargestGivesItsCreepageBackAndOneAboveItIsRefused) {
  const ReferenceContact c(1.2, 0.9, 0.5e-3);
  TangentialProblem p = c.rolling();
  p.falling = {FrictionForm::falling_exponential, 0.4, 0.15};
  p.speed = 20;
  p.x.creepage = -1.5e-3;
  const TangentialSolution given = solve_tangential(c.influence, c.grid, p);
  p.x.force = given.force_x;
  EXPECT_NEAR(solve_tangential(c.influence, c.grid, p).creepage_x / -1.5e-3, 1, 1e-3);
  p.x.force = -0.97 * c.kFriction * c.kLoad;
  try {
    solve_tangential(c.influence, c.grid, p);
    ADD_FAILURE() << "carried";
  } catch (const CaseError& e) {
    EXPECT_NE(std::string(e.what()).find("no steady state was found under the given force"), std::string::npos);
  }
}

std::string refusal(const ReferenceContact& c, const InfluenceOperator& influence, const TangentialProblem& p) {
  try {
    solve_tangential(influence, c.grid, p);
  } catch (const CaseError& e) {
    return e.what();
  }
  ADD_FAILURE() << "solved";
  return {};
}

TEST(FallingFriction, WhatHasSeveralAnswersIsRefusedWithWords) {
  const ReferenceContact c(1.2, 0.9, 1e-3);
  TangentialProblem p = c.rolling();
  p.falling = {FrictionForm::falling_rational, 0.4, 0.01};
  p.speed = 30;
  p.x.creepage = -1e-3;
  constexpr const char* kTooSteep = "friction falls too steeply with slip: below a half-value velocity of";
  EXPECT_NE(refusal(c, c.influence, p).find(kTooSteep), std::string::npos);
  p.falling.half_velocity = 1;
  EXPECT_NO_THROW(solve_tangential(c.influence, c.grid, p));
  p.third_body = {20e-6, 100e6, 0, 0};
  const InfluenceOperator with_film(pair_of(kSteel, kSteel), c.grid.nx, c.grid.ny, 1e-3, 1e-3,
                                    p.third_body.flexibility());
  EXPECT_NE(refusal(c, with_film, p).find(kTooSteep), std::string::npos);
  p.third_body = {};
  p.kind = RollingKind::shift;
  EXPECT_NE(refusal(c, c.influence, p).find("no meaning in a shift, whose slip has no velocity"), std::string::npos);
}

/// A wheel that rolls from rest under falling friction, gentle enough for massless surfaces.
struct RollingFromRest {
  static constexpr double kSpeed = 5;
  ReferenceContact c{1.2, 0.9, 0.6e-3};
  FallingFriction law{FrictionForm::falling_exponential, 0.5, 1.0};
  RollingContact contact(LeadingEdge edge) const {
    RollingContact p;
    p.gap = quadratic_gap(c.grid, 1.2, 0.9);
    p.target.load = c.kLoad;
    p.friction = c.kFriction;
    p.falling = law;
    p.speed = kSpeed;
    p.x.creepage = -4e-3;
    p.y.creepage = 2e-3;
    p.spin = 0.2;
    p.leading_edge = edge;
    return p;
  }
  RollingSolution at_rest() const {
    RollingContact p = contact(LeadingEdge::whole_cell);
    p.kind = RollingKind::shift;
    p.falling = {};
    p.x = p.y = {};
    p.spin = 0;
    return solve_rolling(c.influence, c.grid, p);
  }
};

TEST(FallingFriction, RollingFromRestEndsInTheSteadyState) {
  const RollingFromRest r;
  for (const LeadingEdge edge : {LeadingEdge::whole_cell, LeadingEdge::sub_cell})
    for (const bool by_force : {false, true}) {
      RollingContact p = r.contact(edge);
      if (by_force) p.x.force = -0.5 * r.c.kFriction * r.c.kLoad;
      const TangentialSolution steady = solve_rolling(r.c.influence, r.c.grid, p).tangential;
      EXPECT_GT(steady.slip_area, 0.3 * steady.stick_area);
      RollingSolution s = r.at_rest();
      for (int i = 0; i < 80; ++i) {
        roll_on_one_cell(r.c.influence, r.c.grid, s, p);
        s = solve_rolling(r.c.influence, r.c.grid, p, {}, &s);
      }
      EXPECT_NEAR(s.tangential.force_x / steady.force_x, 1, 1e-3);
      EXPECT_NEAR(s.tangential.force_y / steady.force_y, 1, 1e-3);
      EXPECT_NEAR(s.tangential.creepage_x / steady.creepage_x, 1, 2e-3);
    }
}

// A step by whole cells, q~ the tractions of the state before, rolled on by a cell: what the creepages put in with the
// mean of both is what friction takes and what the elastic energy E = q·A q/2 gains (bem/cell_slip.hpp).
TEST(FallingFriction, WorkOfAStepIsFrictionAndEnergy) {
  const RollingFromRest r;
  const PatchGrid& g = r.c.grid;
  RollingContact p = r.contact(LeadingEdge::whole_cell);
  p.spin = 0;
  const auto energy = [&](const Plane& q_x, const Plane& q_y) {
    Plane u_x(g.size()), u_y(g.size());
    r.c.influence.tangential(q_x.data(), q_y.data(), u_x.data(), u_y.data(), g.nx);
    return 0.5 * (dot(q_x, u_x) + dot(q_y, u_y)) * g.cell_area();
  };
  RollingSolution s = r.at_rest();
  double most_fallen = 1;
  for (int i = 0; i < 12; ++i) {
    const Plane before_x = rolled_on(g, s.tangential.q_x), before_y = rolled_on(g, s.tangential.q_y);
    roll_on_one_cell(r.c.influence, g, s, p);
    RollingOptions sharp;
    sharp.tangential.tolerance = 1e-8;
    s = solve_rolling(r.c.influence, g, p, sharp, &s);
    const TangentialSolution& t = s.tangential;
    const auto mean_force = [&](double now, const Plane& before) {
      return 0.5 * (now + std::accumulate(before.begin(), before.end(), 0.0) * g.cell_area());
    };
    const double in =
        (mean_force(t.force_x, before_x) * p.x.creepage + mean_force(t.force_y, before_y) * p.y.creepage) * g.dx;
    EXPECT_NEAR((t.dissipation * g.dx + energy(t.q_x, t.q_y) - energy(before_x, before_y)) / in, 1, 1e-5);
    for (std::size_t k = 0; k < g.size(); ++k) {
      if (t.state[k] != ContactState::slip) continue;
      const double share = friction_share(r.law, r.kSpeed * std::hypot(t.slip.x[k], t.slip.y[k])).value;
      EXPECT_NEAR(std::hypot(t.q_x[k], t.q_y[k]) / (share * r.c.kFriction * s.normal.pressure[k]), 1, 1e-5);
      most_fallen = std::min(most_fallen, share);
    }
  }
  EXPECT_LT(most_fallen, 0.995);
}

// Too steep a fall lets massless surfaces jump, and a shift has no velocity.
TEST(FallingFriction, HistoriesAreRefusedWhereTheyHaveNoAnswer) {
  const RollingFromRest r;
  RollingContact p = r.contact(LeadingEdge::whole_cell);
  const RollingSolution rest = r.at_rest();
  roll_on_one_cell(r.c.influence, r.c.grid, rest, p);
  p.falling.half_velocity = 0.02;
  try {
    solve_rolling(r.c.influence, r.c.grid, p);
    FAIL();
  } catch (const CaseError& e) {
    EXPECT_NE(std::string(e.what()).find("jump from step to step"), std::string::npos) << e.what();
  }
  RollingContact shift = r.contact(LeadingEdge::whole_cell);
  shift.kind = RollingKind::shift;
  EXPECT_THROW(solve_rolling(r.c.influence, r.c.grid, shift), CaseError);
}

}  // namespace
}  // namespace railstrata
