// Rolling under friction that follows its falling law over a distance of sliding.
#include <gtest/gtest.h>

#include <cmath>

#include "bem/rolling_contact.hpp"
#include "bem/transient.hpp"
#include "core/faults.hpp"
#include "friction/friction_memory.hpp"
#include "half_space_pair.hpp"

namespace railstrata {
namespace {

const FrictionForm kForms[] = {FrictionForm::falling_exponential, FrictionForm::falling_rational};

/// Driven, pushed and turned, beyond what a law without a memory may fall at this speed.
RollingContact driven(const ReferenceContact& c, const FallingFriction& law, LeadingEdge edge = LeadingEdge::sub_cell) {
  RollingContact p;
  p.gap = quadratic_gap(c.grid, 1.2, 0.9);
  p.target.load = c.kLoad;
  p.friction = c.kFriction;
  p.falling = law;
  p.speed = 20;
  p.x.creepage = -2e-3;
  p.y.creepage = 1.5e-3;
  p.spin = 0.4;
  p.leading_edge = edge;
  return p;
}

/// Of a patch that slides as a whole by xi, a particle at the distance s behind the leading edge has slid by xi s:
/// F = f sum p (m_s + (1 - m_s) exp(-xi s/d)), over Hertz's ellipse.
double sliding_force(const HertzContact& h, const FallingFriction& law, double xi, double speed) {
  constexpr int n = 400;
  const double m = friction_share(law, speed * xi).value, a = h.a, b = h.b;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double y = -1 + (2 * j + 1.0) / n, edge = std::sqrt(1 - y * y), t = -1 + (2 * i + 1.0) / n;
      const double slid = xi * a * edge * (1 - t);
      sum += edge * edge * std::sqrt(1 - t * t) * (m + (1 - m) * std::exp(-slid / law.memory_distance));
    }
  return sum * h.p0 * a * b * 4 / (n * n);
}

}  // namespace

TEST(FrictionMemoryRolling, FullSlidingForgetsOnItsWayThroughThePatch) {
  const ReferenceContact c(1.2, 0.9, 0.25e-3);
  for (const FrictionForm form : kForms)
    for (const double distance : {0.05e-3, 0.5e-3, 5e-3}) {
      RollingContact p = driven(c, {form, 0.4, 1.0, distance, 1e-3});
      p.speed = 10;
      p.x.creepage = 0.4;
      p.y.creepage = p.spin = 0;
      const TangentialSolution s = solve_rolling(c.influence, c.grid, p).tangential;
      EXPECT_EQ(s.stick_area, 0);
      EXPECT_NEAR(s.force_x / (c.kFriction * sliding_force(c.hertz, p.falling, 0.4, 10)), 1, 6e-3) << distance;
    }
}

TEST(FrictionMemoryRolling, LiesBetweenTheLawAtOnceAndCoulombs) {
  const ReferenceContact c(1.2, 0.9, 0.5e-3);
  for (const LeadingEdge edge : {LeadingEdge::sub_cell, LeadingEdge::whole_cell}) {
    const FallingFriction law{FrictionForm::falling_rational, 0.4, 0.15, 0, 1e-3};
    FallingFriction shortest = law, longest = law;
    shortest.memory_distance = 1e-12;
    longest.memory_distance = 1e6;
    const auto solved = [&](const FallingFriction& of) {
      return solve_rolling(c.influence, c.grid, driven(c, of, edge)).tangential;
    };
    const TangentialSolution at_once = solved(law), coulomb = solved({}), soon = solved(shortest),
                             never = solved(longest);
    EXPECT_NEAR(soon.force_x / at_once.force_x, 1, 1e-5);
    EXPECT_NEAR(soon.force_y / at_once.force_y, 1, 1e-5);
    EXPECT_EQ(soon.slip_area, at_once.slip_area);
    EXPECT_NEAR(never.force_x / coulomb.force_x, 1, 1e-5);
    EXPECT_EQ(never.slip_area, coulomb.slip_area);
    EXPECT_LT(std::abs(at_once.force_x), 0.95 * std::abs(coulomb.force_x)) << "the law matters here";
  }
}

// Each particle's coefficient is the one ahead of it, followed over its own step.
TEST(FrictionMemoryRolling, EveryCellObeysTheLaw) {
  const ReferenceContact c(1.2, 0.9, 0.5e-3);
  for (const FrictionForm form : kForms) {
    const FallingFriction law{form, 0.4, 0.02, 10e-6, 1e-3};
    const RollingContact p = driven(c, law, LeadingEdge::whole_cell);
    const RollingSolution s = solve_rolling(c.influence, c.grid, p);
    const TangentialSolution& t = s.tangential;
    double most = 0;
    for (int j = 0; j < c.grid.ny; ++j) {
      double lost = 0;
      for (int i = c.grid.nx - 1; i >= 0; --i) {
        const std::size_t k = c.grid.index(i, j);
        if (t.state[k] == ContactState::separated) {
          lost = 0;
          continue;
        }
        const double slip = std::hypot(t.slip.x[k], t.slip.y[k]);
        lost = lost_after(law, lost, p.speed * slip, c.grid.dx / p.speed);
        const double q = std::hypot(t.q_x[k], t.q_y[k]), bound = (1 - lost) * p.friction * s.normal.pressure[k];
        if (t.state[k] == ContactState::slip)
          EXPECT_NEAR(q / bound, 1, 1e-4);
        else
          EXPECT_LE(q, bound * (1 + 1e-9));
        EXPECT_NEAR(t.lost_friction[k], lost, 1e-6);
        most = std::max(most, lost);
      }
    }
    EXPECT_GT(most, 0.3) << "the memory is used";
    EXPECT_GT(t.stick_area, 0);
  }
}

TEST(FrictionMemoryRolling, PowerOfForcesAndSpinIsDissipated) {
  const ReferenceContact c(1.2, 0.9, 0.5e-3);
  const RollingContact p = driven(c, {FrictionForm::falling_exponential, 0.4, 0.02, 20e-6, 1e-3});
  const TangentialSolution s = solve_rolling(c.influence, c.grid, p).tangential;
  EXPECT_NEAR(s.dissipation / (s.force_x * p.x.creepage + s.force_y * p.y.creepage + s.moment * p.spin), 1, 2e-3);
}

// From rest to the steady state, with a law that without a memory would let massless surfaces jump.
TEST(FrictionMemoryRolling, FromRestEndsInTheSteadyState) {
  const ReferenceContact c(1.2, 0.9, 0.6e-3);
  FallingFriction law{FrictionForm::falling_exponential, 0.5, 0.02, 50e-6, 1e-3};
  for (const LeadingEdge edge : {LeadingEdge::whole_cell, LeadingEdge::sub_cell}) {
    RollingContact p = driven(c, law, edge);
    const TangentialSolution steady = solve_rolling(c.influence, c.grid, p).tangential;
    RollingContact rest = driven(c, {}, LeadingEdge::whole_cell);
    rest.kind = RollingKind::shift;
    rest.x = rest.y = {};
    rest.spin = 0;
    RollingSolution s = solve_rolling(c.influence, c.grid, rest);
    double lost_early = 0;
    for (int i = 0; i < 120; ++i) {
      roll_on_one_cell(c.influence, c.grid, s, p);
      s = solve_rolling(c.influence, c.grid, p, {}, &s);
      if (i == 5) lost_early = peak(s.tangential.lost_friction);
    }
    EXPECT_LT(lost_early, 0.6 * peak(s.tangential.lost_friction));
    EXPECT_NEAR(s.tangential.force_x / steady.force_x, 1, 1e-3);
    EXPECT_NEAR(s.tangential.force_y / steady.force_y, 1, 1e-3);
    EXPECT_NEAR(s.tangential.slip_area / steady.slip_area, 1, 0.02);
  }
  RollingContact at_once = driven(c, law, LeadingEdge::whole_cell);
  at_once.falling.memory_distance = 0;
  EXPECT_THROW(solve_rolling(c.influence, c.grid, at_once), CaseError);
}

// A case that rolls from rest: the shift it begins with is made at rest, whatever the law says of sliding.
TEST(FrictionMemoryRolling, OfACaseFromRestEndsInItsSteadyState) {
  CaseSpec spec;
  spec.geometry.rail_profile = "flat";
  spec.geometry.wheel_profile = "arc:R=430 mm";
  spec.geometry.cant = 0;
  spec.drive.creepage = -3e-3;
  spec.friction.law = FrictionForm::falling_exponential;
  spec.friction.kinetic_coefficient = 0.2;
  spec.friction.half_velocity = 0.1;
  spec.friction.memory_distance = 50e-6;
  BemOptions options;
  options.cell = 0.75e-3;
  const Placement placement = place(spec, {});
  const double steady = solve_bem(spec, placement, options).force.x;
  spec.transient.kind = TransientKind::rolling;
  spec.transient.distance = 50e-3;
  EXPECT_NEAR(solve_transient(spec, placement, options).result.force.x / steady, 1, 1e-3);
}

// The remedy names the distance that is enough.
TEST(FrictionMemoryRolling, TooShortAMemoryIsRefusedWithOneThatDoes) {
  const ReferenceContact c(1.2, 0.9, 1e-3);
  TangentialProblem p = c.rolling();
  p.falling = {FrictionForm::falling_exponential, 0.2, 0.01, 0.5e-6, 1e-3};
  p.speed = 30;
  p.x.creepage = -1e-3;
  std::string text;
  try {
    solve_tangential(c.influence, c.grid, p);
  } catch (const CaseError& e) {
    text = e.what();
  }
  const std::string begin = "friction falls too soon with slip: below a memory distance of ";
  const std::size_t at = text.find(begin);
  ASSERT_NE(at, std::string::npos) << text;
  EXPECT_NE(text.find("steady rolling has several answers here"), std::string::npos) << text;
  p.falling.memory_distance = 1.01e-6 * std::stod(text.substr(at + begin.size()));
  EXPECT_NO_THROW(solve_tangential(c.influence, c.grid, p));
}

}  // namespace railstrata
