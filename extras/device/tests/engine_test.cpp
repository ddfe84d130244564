#include "device/engine.hpp"

#include <gtest/gtest.h>

#include "core/faults.hpp"
#include "device/card.hpp"
#include "device/device_of.hpp"
#include "device/emulated_device.hpp"
#include "extras/device/tests/engine_checks.hpp"

namespace railstrata::device {

using namespace device_checks;

TEST(Engine, ForcesAreThoseOfTheTraversal) {
  EmulatedDevice device;
  expect_same_forces(device, ArithmeticPrecision::double_precision, 1e-12);
}

// Against double precision: a strain of 1e-3 is a difference of numbers near one, which are rounded by 6e-8.
TEST(SlowEngine, InSinglePrecisionToItsRounding) {
  EmulatedDevice device;
  expect_same_forces(device, ArithmeticPrecision::single_precision, 5e-4);
}

TEST(SlowEngine, StepsAreThoseOfTheStepper) {
  EmulatedDevice device;
  expect_same_steps(device);
}

TEST(SlowEngine, InSinglePrecisionDisplacementsAndPressuresAre) {
  EmulatedDevice device;
  expect_same_steps_in_single_precision(device);
}

TEST(SlowEngine, TheSameBitsInAnyOrderOfThreads) {
  const RollingSystem system = small_system(layered_case(ArithmeticPrecision::double_precision));
  const PreloadResult preload = solve_preload(system, 1e-3);
  EmulatedDevice forward(Protection::closed), backward(Protection::closed, LaunchOrder::backward),
      threads(Protection::open, LaunchOrder::threads);
  Stepper first(system, preload);
  first.use(on(forward));
  roll(first, 40);
  for (Device* device : {static_cast<Device*>(&backward), static_cast<Device*>(&threads)}) {
    Stepper other(system, preload);
    other.use(on(*device));
    roll(other, 40);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_TRUE(same_bits(first.state().bodies[k].u, other.state().bodies[k].u));
      EXPECT_TRUE(same_bits(first.state().bodies[k].v, other.state().bodies[k].v));
    }
    EXPECT_EQ(std::memcmp(&first.state().axle, &other.state().axle, sizeof(AxleMotion)), 0);
    EXPECT_TRUE(same_bits(first.state().tractions.all(), other.state().tractions.all()));
  }
}

TEST(SlowEngine, StepsTakenTogetherHaveTheBitsOfSingleOnesAndOneCopy) {
  const RollingSystem system = small_system(layered_case(ArithmeticPrecision::double_precision));
  const PreloadResult preload = solve_preload(system, 1e-3);
  EmulatedDevice device(Protection::open), other(Protection::open);
  Stepper single(system, preload), ahead(system, preload);
  single.use(on(device));
  ahead.use(on(other));
  roll(single, 1);
  roll(ahead, 1);
  const long before = other.copies();
  ahead.check_next_at(1.0);
  for (int k = 1; k < 48; ++k) {
    single.step();
    ahead.step();
    ASSERT_EQ(std::memcmp(&single.state().axle, &ahead.state().axle, sizeof(AxleMotion)), 0);
    ASSERT_EQ(single.forces().z, ahead.forces().z);
    ASSERT_EQ(single.state().step, ahead.state().step);
  }
  EXPECT_EQ(other.copies() - before, 3);  // 15, 16 and 16 steps
  single.complete();
  ahead.complete();
  for (std::size_t k = 0; k < 2; ++k) EXPECT_TRUE(same_bits(single.state().bodies[k].u, ahead.state().bodies[k].u));
}

TEST(SlowEngine, WhatIsToBeSeenBeforeTheStepsAreOverEndsTheRun) {
  const RollingSystem system = small_system(small_case());
  EmulatedDevice device(Protection::open);
  Stepper stepper(system, solve_preload(system, 1e-2));
  stepper.use(on(device));
  stepper.check_next_at(1.0);
  stepper.step();
  EXPECT_THROW(stepper.complete(), NumericalError);
}

TEST(SlowEngine, TakesFilmsAndFrictionThatFalls) {
  EmulatedDevice device(Protection::open);
  CaseSpec s = small_case();
  s.drive.friction_coefficient = 0.25;
  s.drive.creepage = -0.01;
  s.friction.law = FrictionForm::falling_exponential;
  s.friction.kinetic_coefficient = 0.15;
  s.friction.half_velocity = 0.3;
  s.friction.memory_distance = 50e-6;
  s.third_body.thickness = 20e-6;
  s.third_body.shear_modulus = 1e9;
  s.third_body.yield_shear = 100e6;
  expect_same_contact(device, s);
}

TEST(SlowEngine, TakesAYawedWheel) {
  EmulatedDevice device(Protection::open);
  CaseSpec s = small_case();
  s.drive.friction_coefficient = 0.05;
  s.drive.creepage = -0.02;
  s.geometry.yaw = 5e-3;
  expect_same_contact(device, s);
}

TEST(SlowEngine, CheckpointsGoEitherWay) {
  EmulatedDevice device(Protection::open);
  expect_checkpoints_go_either_way(device);
}

TEST(SlowEngine, AWholeRunHasTheHistoryAndSamplesOfTheProcessor) {
  CaseSpec spec = layered_case(ArithmeticPrecision::double_precision);
  spec.run.positions = {0.012};
  spec.run.run_up = 0.006;
  const RollingSystem system = small_system(spec);
  EmulatedDevice device(Protection::open, LaunchOrder::threads);
  const RunResult here = run_rolling(system, {}), there = run_rolling(system, {}, nullptr, {{}, engine_on(&device)});
  ASSERT_EQ(here.history.size(), there.history.size());
  EXPECT_EQ(here.steps, there.steps);
  for (std::size_t k = 0; k < here.history.size(); ++k) {
    EXPECT_NEAR(there.history[k].p_max, here.history[k].p_max, 1e-9 * here.history[k].p_max);
    EXPECT_NEAR(there.history[k].forces.x, here.history[k].forces.x, 1e-8 * here.history[k].forces.z);
    const EnergyBalance &a = here.history[k].energy, &b = there.history[k].energy;
    EXPECT_NEAR(b.strain, a.strain, 1e-9 * a.strain);
    EXPECT_NEAR(b.hourglass, a.hourglass, 1e-9 * a.strain);
    EXPECT_NEAR(b.kinetic, a.kinetic, 1e-12 * a.kinetic);
    EXPECT_NEAR(b.weight, a.weight, 1e-9 * std::abs(a.weight));
  }
  EXPECT_NEAR(there.closure, here.closure, 1e-6);
  ASSERT_EQ(here.positions[0].samples.size(), there.positions[0].samples.size());
  const RollingSample &a = here.positions[0].samples[0], &b = there.positions[0].samples[0];
  ASSERT_EQ(a.rail.stress.size(), b.rail.stress.size());
  double worst = 0, scale = 0;
  for (std::size_t k = 0; k < a.rail.stress.size(); ++k) {
    worst = std::max(worst, von_mises(a.rail.stress[k] - b.rail.stress[k]));
    scale = std::max(scale, von_mises(a.rail.stress[k]));
  }
  EXPECT_LT(worst, 1e-9 * scale);
}

// In a case it goes with run.plasticity, which a device does not take; the kernels have it.
TEST(SlowEngine, TakesAnInitialStress) {
  CaseSpec spec = small_case();
  spec.run.plasticity = true;
  spec.rail_material.strength.yield_strength = spec.wheel_material.strength.yield_strength = 1e20;
  LayerSpec layer;
  layer.thickness = 4e-3;
  layer.material = spec.rail_material;
  layer.material.strength.initial_stress = {-344e6, -200e6};
  spec.layers = {layer};
  RollingSystem system = small_system(spec);
  for (Body& b : system.bodies) b.plastic = {};
  ASSERT_FALSE(system.rail().initial_stress.empty());
  const PreloadResult preload = solve_preload(system, 1e-4);
  EmulatedDevice device(Protection::open);
  Stepper here(system, preload), there(system, preload);
  there.use(on(device));
  roll(here, 39);
  roll(there, 39);
  EXPECT_LT(relative_difference(system, Motion(here), Motion(there)), 1e-9);
  EXPECT_NEAR(largest_pressure(there), largest_pressure(here), 1e-9 * largest_pressure(here));
  EXPECT_NEAR(there.energy().strain, here.energy().strain, 1e-9 * std::abs(here.energy().strain));
  EXPECT_GT(std::abs(system.end_loads.front().force), 0);
}

TEST(Engine, WhatItCannotTakeIsSaid) {
  EXPECT_EQ(not_on_a_device(small_system(small_case())), "");
  CaseSpec ring = small_case();
  ring.geometry.rail_radius = 0.43;
  const RollingSystem system = small_system(ring);
  EXPECT_EQ(not_on_a_device(system), "rail that is a ring");
  EmulatedDevice device;
  Stepper stepper(system, solve_preload(system, 1e-2));
  EXPECT_THROW(stepper.use(engine_on(&device)), CaseError);
}

TEST(Engine, ACaseWithoutACardIsToldWhatToDo) {
  CaseSpec spec = small_case();
  EXPECT_EQ(device_of(spec), nullptr);
  spec.run.device = ComputeDevice::gpu;
  if (!card_name().empty()) GTEST_SKIP() << "there is a card: " << card_name();
  try {
    device_of(spec);
    FAIL();
  } catch (const EnvironmentError& e) {
    EXPECT_NE(std::string(e.what()).find(built_for_cards() ? "no card was found" : "built without CUDA"),
              std::string::npos)
        << e.what();
    EXPECT_NE(e.remedy.find("run.device = \"cpu\""), std::string::npos) << e.remedy;
  }
  spec.run.rolling = false;  // nothing of it would be computed there
  EXPECT_EQ(device_of(spec), nullptr);
}

}  // namespace railstrata::device
