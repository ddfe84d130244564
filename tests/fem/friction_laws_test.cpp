// Laws of friction under a rolling ball, third-body films among them, and the start of a wheel that spins on its
// contact.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/faults.hpp"
#include "fem/lateral_start.hpp"
#include "fem/rolling_run.hpp"
#include "halfspace/creep_theories.hpp"
#include "small_rolling.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

/// On a shorter way.
CaseSpec short_ball_case() {
  CaseSpec s = ball_case();
  s.run.positions = {0.02};
  s.run.run_up = 0.015;
  return s;
}

}  // namespace

// Under a film much more flexible than the bodies each point is sheared by eta times its distance from the leading
// edge: traction grows along each column by (G/h) eta.
TEST(SlowFrictionLaws, ASoftFilmIsShearedInProportionToTheDistanceFromTheLeadingEdge) {
  CaseSpec spec = short_ball_case();
  spec.mesh.element_size = 2e-3;
  spec.mesh.fine_depth = 4e-3;
  const double creepage = 1e-2, stiffness = 1e11;  // Pa/m
  spec.drive.lateral_creepage = creepage;
  spec.third_body.thickness = 100e-6;
  spec.third_body.shear_modulus = 100e-6 * stiffness;
  const RollingSystem system = small_system(spec);
  const RunResult run = run_rolling(system, {});
  const int columns = system.rail_surface().columns, middle = columns / 2;
  double slope = 0;
  int pairs = 0;
  for (const RollingSample& s : run.positions.back().samples)
    for (int j = 0; j < s.rail.stations; ++j) {
      const NodeTraction &behind = s.tractions[j * columns + middle], &ahead = s.tractions[(j + 1) * columns + middle];
      if (std::min(behind.p, ahead.p) < 0.3 * system.model.hertz.p0) continue;
      slope += (behind.q2 - ahead.q2) / (s.rail.along[j + 1] - s.rail.along[j]);
      ++pairs;
      EXPECT_FALSE(behind.slips());
    }
  ASSERT_GT(pairs, 10);
  EXPECT_NEAR(slope / pairs / (stiffness * creepage), 1, 0.02);
}

// A film that yields at once bears its yield shear wherever the surfaces touch, and slips there.
TEST(FrictionLaws, AWeakFilmBearsItsYieldShear) {
  CaseSpec spec = short_ball_case();
  spec.drive.lateral_creepage = 0.02;
  spec.third_body.thickness = 10e-6;
  spec.third_body.shear_modulus = 1e9;
  spec.third_body.yield_shear = 20e6;
  const RollingSystem system = small_system(spec);
  EXPECT_NEAR(std::abs(system.options.lateral_friction),
              20e6 * std::numbers::pi * system.model.hertz.a * system.model.hertz.b, 1.0);
  const RunResult run = run_rolling(system, {});
  int yielding = 0;
  for (const NodeTraction& t : run.positions.back().samples.back().tractions) {
    if (t.p < 0.3 * system.model.hertz.p0) continue;
    ++yielding;
    EXPECT_TRUE(t.slips());
    EXPECT_NEAR(std::hypot(t.q1, t.q2), 20e6, 1.0);
    EXPECT_GT(t.plastic, 0);
  }
  EXPECT_GT(yielding, 3);
}

TEST(FrictionLaws, FrictionThatFallsWithSlipNeedsAMemory) {
  CaseSpec spec = short_ball_case();
  spec.friction.law = FrictionForm::falling_rational;
  spec.friction.kinetic_coefficient = 0.4;
  spec.friction.half_velocity = 90;
  EXPECT_THROW(small_system(spec), CaseError);
  spec.friction.memory_distance = 20e-6;
  EXPECT_NO_THROW(small_system(spec));
}

// A wheel that slides as a whole carries the coefficient of its slip velocity: its memory is short against the way that
// each point slides. Of a vibration of the mesh as large as the slip velocity itself the law sees nothing.
TEST(FrictionLaws, FullSlidingCarriesTheCoefficientOfItsSlip) {
  CaseSpec spec = short_ball_case();
  spec.drive.lateral_creepage = 0.03;
  spec.friction.law = FrictionForm::falling_exponential;
  spec.friction.kinetic_coefficient = 0.2;
  spec.friction.half_velocity = 2;
  spec.friction.memory_distance = 10e-6;
  const RollingSystem system = small_system(spec);
  const RunResult run = run_rolling(system, {});
  double q = 0, p = 0;
  for (const RollingSample& s : run.positions.back().samples)
    for (const NodeTraction& t : s.tractions) {
      q += t.q2;
      p += t.p;
    }
  const double v = 0.03 * spec.drive.speed, share = 0.4 + 0.6 * std::exp2(-v / 2);
  EXPECT_NEAR(std::abs(q) / (kBallFriction * share * p), 1, 0.015);
}

// Across the rail each column has the coefficient of its place, across rolling the ellipse's.
TEST(FrictionLaws, FullSlidingCarriesTheCoefficientsAcross) {
  CaseSpec spec = short_ball_case();
  spec.drive.lateral_creepage = 0.03;
  spec.friction.lateral_table = {{-4e-3, 0.1}, {4e-3, 0.5}};
  spec.friction.lateral_coefficient = 0.25;  // half of that along
  const RollingSystem system = small_system(spec);
  const RunResult run = run_rolling(system, {});
  const RollingSample& sample = run.positions.back().samples.back();
  const int columns = system.rail_surface().columns;
  int sliding = 0;
  for (std::size_t k = 0; k < sample.tractions.size(); ++k) {
    const NodeTraction& t = sample.tractions[k];
    if (t.p < 0.3 * system.model.hertz.p0) continue;
    ++sliding;
    const double y = system.rail_surface().at_contact(static_cast<int>(k) % columns).y;
    EXPECT_NEAR(std::hypot(t.q1, 2 * t.q2) / t.p, over_table(spec.friction.lateral_table, y), 1e-6) << y;
    EXPECT_GT(std::abs(t.q2), 0.9 * 0.5 * std::hypot(t.q1, 2 * t.q2));
  }
  EXPECT_GT(sliding, 3);
}

// A guided wheel on an inclined plane spins on its contact and starts with the friction of that: Kalker's linear theory
// for a small spin.
TEST(LateralStart, OfAGuidedWheelHasTheFrictionOfItsSpin) {
  CaseSpec spec = short_ball_case();
  EXPECT_EQ(lateral_start(build_model(spec, ".")).friction, 0) << "level";
  spec.geometry.cant = 0.02;
  const Model model = build_model(spec, ".");
  const RigidContact& contact = model.placement.contact;
  ASSERT_NEAR(std::abs(contact.angle), 0.02, 1e-4);
  const HalfSpaceMaterial steel{model.spec.rail_material.young, model.spec.rail_material.poisson};
  const RollingEllipse ellipse = rolling_ellipse(model.hertz, kBallFriction, steel, steel);
  const LateralStart start = lateral_start(model);
  EXPECT_EQ(start.creepage, 0);
  EXPECT_NEAR(start.friction / linear_theory(ellipse, {0, 0, wheel_spin(contact)}).y, 1, 0.1);
  const RollingSystem system = small_system(spec);
  EXPECT_EQ(system.options.lateral_speed, 0);
  EXPECT_EQ(system.options.lateral_friction, start.friction);
}

}  // namespace railstrata
