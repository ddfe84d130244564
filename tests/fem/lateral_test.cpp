// Wheels that are yawed, moved or pushed sideways, or held at a given creepage.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fem/rolling_run.hpp"
#include "small_rolling.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

double largest_pressure(const std::vector<NodeTraction>& tractions) {
  double p = 0;
  for (const NodeTraction& t : tractions) p = std::max(p, t.p);
  return p;
}

double static_pressure(const CaseSpec& spec) {
  return largest_pressure(solve_preload(small_system(spec), 1e-8).tractions.all());
}

/// Means of the samples: forces on the wheel.
struct Rolled {
  double x = 0, y = 0, z = 0;
  double p_max = 0, creepage = 0, lateral_creepage = 0, closure = 0;
};
Rolled rolled(const CaseSpec& spec) {
  const RunResult run = run_rolling(small_system(spec), {});
  const std::vector<RollingSample>& samples = run.positions.back().samples;
  const double share = 1.0 / static_cast<double>(samples.size());
  Rolled out;
  for (const RollingSample& s : samples) {
    out.x += share * s.forces.x;
    out.y += share * s.forces.y;
    out.z += share * s.forces.z;
    out.p_max += share * largest_pressure(s.tractions);
    out.creepage += share * s.creepage;
    out.lateral_creepage += share * s.lateral_creepage;
  }
  out.closure = run.closure;
  return out;
}

}  // namespace

TEST(Lateral, AStaticBallDoesNotKnowItsYaw) {
  CaseSpec spec = ball_case();
  spec.run.rolling = false;
  const double straight = static_pressure(spec);
  spec.geometry.yaw = 0.05;
  EXPECT_NEAR(static_pressure(spec) / straight, 1, 1e-3);
}

// Displacements are those of the model frame: of the yawed wheel its elements are still free of strain where nothing
// presses them, and its samples have no rigid motion left.
TEST(Lateral, DisplacementsOfAYawedWheelAreItsDeformationAlone) {
  CaseSpec spec = ball_case();
  spec.run.rolling = false;
  const auto deepest = [&] {
    const RunResult run = run_rolling(small_system(spec), {});
    double most = 0;
    for (Vec3 u : run.positions.front().samples.front().wheel.displacement) most = std::max(most, norm(u));
    return most;
  };
  const double straight = deepest();
  spec.geometry.yaw = 0.05;
  EXPECT_NEAR(deepest() / straight, 1, 0.02);
}

// The rigid slip of a wheel that is yawed by psi is that of one which moves sideways with -V tan(psi).
TEST(SlowLateral, AYawedBallPullsLikeOneThatMovesSideways) {
  CaseSpec yawed = ball_case(), moved = ball_case();
  yawed.geometry.yaw = 2e-3;
  moved.drive.lateral_creepage = -2e-3;
  const Rolled a = rolled(yawed), b = rolled(moved);
  EXPECT_NEAR(a.lateral_creepage, -2e-3, 1e-6);
  EXPECT_NEAR(b.lateral_creepage, -2e-3, 1e-6);
  EXPECT_GT(a.y, 0.1 * kBallFriction * a.z) << "slipping to the gauge side it is pushed to the field side";
  EXPECT_NEAR(a.y / b.y, 1, 0.01);
  EXPECT_NEAR(a.p_max / b.p_max, 1, 0.005);
  EXPECT_LT(a.closure, 1e-2);
  EXPECT_LT(b.closure, 1e-2);
}

TEST(SlowLateral, ScaledMassesOfAYawedWheelsLayerGiveTheForcesOfRealOnes) {
  const auto forces = [](double mass_scaling_step) {
    CaseSpec spec = thinly_layered(small_case());
    spec.run.mass_scaling_step = mass_scaling_step;
    spec.layers.back().on = BodyId::wheel;
    spec.geometry.yaw = 0.05;
    spec.drive.creepage_start = -0.02;
    const RollingSystem system = small_system(spec);
    Stepper st(system, solve_preload(system, 1e-6));
    while (st.position() < 1.5e-3) st.step();
    return st.forces();
  };
  const ContactForces scaled = forces(1), real = forces(0);
  EXPECT_GT(real.y, 0.02 * real.z);
  EXPECT_NEAR(scaled.x / real.x, 1, 0.01);
  EXPECT_NEAR(scaled.y / real.y, 1, 0.01);
  EXPECT_NEAR(scaled.z / real.z, 1, 1e-3);
}

TEST(Lateral, FullSlipBearsAllTheFriction) {
  CaseSpec spec = ball_case();
  spec.drive.lateral_creepage = 0.05;
  spec.run.positions = {0.02};
  const Rolled m = rolled(spec);
  EXPECT_NEAR(m.y / (-kBallFriction * m.z), 1, 2e-3);
}

// The axle starts with the friction and an estimate of its creepage, and rings about them by the estimate's error on
// elements of 4 mm.
TEST(SlowLateral, AGivenLateralForceIsHeldByCreeping) {
  CaseSpec spec = ball_case();
  spec.drive.lateral_traction_coefficient = 0.1;
  spec.run.run_up = 0.06;
  spec.run.positions = {0.12};
  const RollingSystem system = small_system(spec);
  const PreloadResult start = solve_preload(system, 1e-6);
  EXPECT_NEAR(start.contact_force.y / system.model.load, 0.1, 1e-4);
  EXPECT_NEAR(start.contact_force.z / system.model.load, 1, 5e-4) << "up to the spinning mesh's imbalance";
  const Rolled m = rolled(spec);
  EXPECT_NEAR(m.y / system.model.load, 0.1, 0.01);
  EXPECT_LT(m.lateral_creepage, -1e-4);
  EXPECT_LT(m.closure, 1e-3);
}

TEST(Lateral, WithoutFrictionTheWheelMovesSidewaysAllTheSame) {
  CaseSpec spec = ball_case();
  spec.drive.friction_coefficient = 0;
  spec.drive.lateral_creepage = 0.01;
  const RollingSystem system = small_system(spec);
  const Stepper start(system, solve_preload(system, 1e-4));
  EXPECT_NEAR(start.lateral_creepage(), 0.01, 1e-12);
  EXPECT_EQ(system.options.lateral_friction, 0);
}

TEST(SlowLateral, AGivenCreepageIsKept) {
  CaseSpec spec = ball_case();
  spec.drive.creepage = -1e-3;
  const Rolled m = rolled(spec);
  EXPECT_NEAR(m.creepage, -1e-3, 1e-9);
  EXPECT_GT(m.x, 0.05 * m.z) << "it drives";
  EXPECT_LT(m.closure, 1e-2);
}

}  // namespace railstrata
