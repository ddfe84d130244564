#include <gtest/gtest.h>

#include <cstring>

#include "core/faults.hpp"
#include "small_rolling.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

template <class Array>
bool same_bits(const Array& a, const Array& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

void roll(Stepper& st, int steps) {
  for (int k = 0; k < steps; ++k) {
    if (k % 7 == 0) st.want_energy();
    st.step();
  }
}

// 67 steps in one go against 32, a new stepper from the memory and 35 more; energies asked for at the same steps.
void expect_same_bits(const CaseSpec& spec) {
  const RollingSystem system = small_system(spec);
  const PreloadResult preload = solve_preload(system, 1e-4);
  Stepper whole(system, preload), first(system, preload);
  EXPECT_TRUE(first.is_restart_point());
  roll(first, 21);
  EXPECT_FALSE(first.is_restart_point());
  while (!first.is_restart_point()) first.step();
  Stepper second(system, first.restart_state());
  roll(second, 35);
  roll(whole, 21);
  for (int k = 21; k < 32; ++k) whole.step();
  roll(whole, 35);
  const RollingState &a = whole.state(), &b = second.state();
  EXPECT_EQ(a.step, 67);
  EXPECT_EQ(b.step, 67);
  EXPECT_EQ(a.time, b.time);
  EXPECT_TRUE(same_bits(a.bodies[0].u, b.bodies[0].u));
  EXPECT_TRUE(same_bits(a.bodies[0].v, b.bodies[0].v));
  EXPECT_TRUE(same_bits(a.bodies[1].u, b.bodies[1].u));
  EXPECT_TRUE(same_bits(a.bodies[1].v, b.bodies[1].v));
  EXPECT_TRUE(same_bits(a.tractions.all(), b.tractions.all()));
  EXPECT_TRUE(same_bits(a.groups, b.groups));
  EXPECT_TRUE(same_bits(a.sleepers, b.sleepers));
  EXPECT_EQ(std::memcmp(&a.axle, &b.axle, sizeof a.axle), 0);
  EXPECT_EQ(whole.energy().total(), second.energy().total());
  EXPECT_NE(whole.energy().total(), 0);
}

CaseSpec damped_case() {
  CaseSpec spec = small_case();
  spec.run.run_up = 0.02;
  spec.run.run_up_damping = 2000;
  spec.drive.torque_ramp = 1e-4;
  return spec;
}

}  // namespace

TEST(Resume, OnATrackGivesTheBitsOfARunInOneGo) { expect_same_bits(on_track(damped_case())); }

TEST(Resume, OverTheEndOfALayerToo) { expect_same_bits(ending_layer(damped_case())); }

TEST(Resume, AStepperFromMemoryComputesTheSameBits) { expect_same_bits(damped_case()); }

TEST(Resume, InSinglePrecisionToo) {
  CaseSpec spec = damped_case();
  spec.run.precision = ArithmeticPrecision::single_precision;
  expect_same_bits(spec);
}

TEST(Resume, WithScaledMassesToo) { expect_same_bits(thinly_layered(damped_case())); }

TEST(Resume, OfAYawedWheelThatIsFreeSidewaysToo) {
  CaseSpec spec = damped_case();
  spec.geometry.yaw = 5e-3;
  spec.drive.lateral_traction_coefficient = 0.1;
  expect_same_bits(spec);
}

TEST(Resume, OfAWheelThatMovesSidewaysAtAGivenCreepageToo) {
  CaseSpec spec = damped_case();
  spec.drive.lateral_creepage = 1e-3;
  spec.drive.creepage = -1e-3;
  expect_same_bits(spec);
}

TEST(Resume, OnAFilmThatYieldsToo) {
  CaseSpec spec = damped_case();
  spec.drive.lateral_creepage = 1e-3;
  spec.third_body.thickness = 10e-6;
  spec.third_body.shear_modulus = 1e8;
  spec.third_body.yield_shear = 30e6;
  spec.third_body.hardening = 1e12;
  expect_same_bits(spec);
}

TEST(Resume, UnderFrictionThatRemembersToo) {
  CaseSpec spec = damped_case();
  spec.drive.lateral_creepage = 0.03;
  spec.friction.law = FrictionForm::falling_exponential;
  spec.friction.kinetic_coefficient = 0.2;
  spec.friction.half_velocity = 1;
  spec.friction.memory_distance = 20e-6;
  expect_same_bits(spec);
}

// A guard that stops the run in the second window, long after the last good state: what is saved goes on to the bits of
// a run to which nothing happened.
TEST(SlowResume, FromTheLastGoodStateToo) {
  CaseSpec spec = small_case();
  spec.drive.speed = 12;
  spec.run.positions = {5e-3, 10e-3};
  spec.run.window = 4e-3;
  const RollingSystem system = small_system(spec);
  const RunResult expected = run_rolling(system, {});
  RunState saved;
  RunObserver observer;
  observer.save = [&](const RunState& state, bool) { saved = state; };
  observer.history = [&](const HistoryRow& row) {
    if (row.position > 10e-3) throw NumericalError("a guard");
  };
  EXPECT_THROW(run_rolling(system, observer), NumericalError);
  ASSERT_EQ(saved.result.positions.size(), 2u);
  EXPECT_GT(saved.stepper.state.step, 0);
  EXPECT_LT(saved.result.history.back().position, saved.stepper.state.axle.x);
  EXPECT_GT(saved.result.history.back().position, saved.stepper.state.axle.x - spec.run.history_interval);
  EXPECT_EQ(saved.result.positions[0].samples.size() + saved.result.positions[1].samples.size(), saved.next_sample);
  const RunResult found = resume_rolling(system, {}, std::move(saved));
  EXPECT_EQ(found.steps, expected.steps);
  EXPECT_TRUE(same_bits(found.history, expected.history));
  EXPECT_EQ(found.closure, expected.closure);
  for (std::size_t p = 0; p < 2; ++p) {
    const auto &a = found.positions[p].samples, &b = expected.positions[p].samples;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k)
      EXPECT_TRUE(same_bits(a[k].rail.stress, b[k].rail.stress)) << p << ", " << k;
  }
}

TEST(Resume, AMemoryOfAnotherMeshIsRefused) {
  const RollingSystem system = small_system(small_case());
  Stepper st(system, solve_preload(system, 1e-3));
  const RestartState whole = st.restart_state();
  RestartState shorter = whole, turned = whole;
  shorter.state.bodies[0].u.pop_back();
  EXPECT_THROW(Stepper(system, shorter), CaseError);
  const SurfaceTractions& t = whole.state.tractions;  // as many nodes, another grid
  turned.state.tractions = SurfaceTractions(t.stations(), static_cast<int>(t.all().size()) / t.stations());
  EXPECT_THROW(Stepper(system, turned), CaseError);
  EXPECT_NO_THROW(Stepper(system, whole));
}

}  // namespace railstrata
