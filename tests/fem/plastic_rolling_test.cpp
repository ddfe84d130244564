// Rolling over a rail that yields.
#include <gtest/gtest.h>

#include <cstring>

#include "body/plastic_field.hpp"
#include "body/stress.hpp"
#include "core/faults.hpp"
#include "core/parallel.hpp"
#include "fem/plastic_zone.hpp"
#include "small_rolling.hpp"
#include "tests/body/plastic_state.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

constexpr double kNever = 1e20;

/// Both bodies; von Mises stresses of the elastic contact reach some 500 MPa.
CaseSpec yielding_case(double yield) {
  CaseSpec spec = small_case();
  spec.run.plasticity = true;
  for (MaterialSpec* m : {&spec.rail_material, &spec.wheel_material}) {
    m->strength.yield_strength = yield;
    m->strength.kinematic_hardening = {{20e9, 50}};
  }
  return spec;
}

/// A system with the elements around its contact hot from the start.
RollingSystem hot_system(const CaseSpec& spec) {
  RollingSystem out = small_system(spec);
  for (const BodyId id : kBodies)
    out.bodies[index_of(id)].plastic = plastic_zone(out.model, id, out.body(id), {0.06, 0.06});
  return out;
}

Stepper& rolled(Stepper& st, int steps) {
  for (int k = 0; k < steps; ++k) {
    if (k % 7 == 0) st.want_energy();
    st.step();
  }
  return st;
}

bool same_bits(const Field& a, const Field& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}
void expect_same_motion(const Stepper& a, const Stepper& b) {
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_TRUE(same_bits(a.state().bodies[k].u, b.state().bodies[k].u));
    EXPECT_TRUE(same_bits(a.state().bodies[k].v, b.state().bodies[k].v));
  }
  EXPECT_EQ(a.energy().total(), b.energy().total());
}

TEST(SlowPlasticRolling, WithoutYieldHasTheBitsOfTheElasticRun) {
  for (ArithmeticPrecision precision : {ArithmeticPrecision::double_precision, ArithmeticPrecision::single_precision}) {
    CaseSpec elastic = small_case(), spec = yielding_case(kNever);
    elastic.run.precision = spec.run.precision = precision;
    const RollingSystem plain = small_system(elastic), system = hot_system(spec);
    for (const BodyId id : kBodies) ASSERT_GT(hot_elements(system.body(id), initial_history(system.body(id))), 500);
    Stepper a(plain, solve_preload(plain, 1e-4)), b(system, solve_preload(system, 1e-4));
    expect_same_motion(rolled(a, 40), rolled(b, 40));
    EXPECT_EQ(plastic_extent(system.rail(), b.state().bodies[kRail].history).yielded, 0);
  }
}

TEST(PlasticRolling, GoesOnFromARestartStateWithTheSameBits) {
  const RollingSystem system = small_system(yielding_case(300e6));
  const PreloadResult preload = solve_preload(system, 1e-4);
  Stepper whole(system, preload), first(system, preload);
  rolled(first, 32);
  Stepper second(system, first.restart_state());
  rolled(second, 35);
  rolled(whole, 32);
  rolled(whole, 35);
  expect_same_motion(whole, second);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_TRUE(whole.state().bodies[k].history == second.state().bodies[k].history);
  EXPECT_GT(plastic_extent(system.rail(), second.state().bodies[kRail].history).yielded, 10);
}

TEST(SlowPlasticRolling, HasTheSameBitsOnAnyNumberOfThreads) {
  const int before = max_threads();
  const RollingSystem system = small_system(yielding_case(300e6));
  set_threads(1);
  const PreloadResult preload = solve_preload(system, 1e-4);
  Stepper one(system, preload);
  rolled(one, 30);
  set_threads(3);
  Stepper three(system, solve_preload(system, 1e-4));
  rolled(three, 30);
  set_threads(before);
  expect_same_motion(one, three);
}

TEST(SlowPlasticRolling, ClosesTheEnergyBalanceWithThePlasticWork) {
  double closure[2], plastic[2];
  for (int k : {0, 1}) {
    const RollingSystem system = small_system(yielding_case(k == 0 ? kNever : 300e6));
    Stepper st(system, solve_preload(system, 1e-6));
    EnergyBalance start;
    double most = 0;
    for (int n = 0; n < 600; ++n) {
      if (n % 20 == 0) st.want_energy();
      st.step();
      if (n == 0) start = st.energy();
      if (n % 20 == 0) most = std::max(most, std::abs(st.energy().total() - start.total()));
    }
    closure[k] = most;
    plastic[k] = st.energy().plastic - start.plastic;
  }
  EXPECT_EQ(plastic[0], 0);
  EXPECT_GT(plastic[1], 0.05);  // J
  EXPECT_LT(closure[1], closure[0] + 0.01 * plastic[1]);
}

TEST(SlowPlasticRolling, PreloadBeyondYieldFindsOneEquilibriumHoweverCloselyItIsApproached) {
  const RollingSystem elastic = small_system(small_case()), system = small_system(yielding_case(300e6));
  const PreloadResult hard = solve_preload(elastic, 1e-7), rough = solve_preload(system, 1e-4),
                      fine = solve_preload(system, 1e-7);
  const auto p_max = [](const PreloadResult& r) {
    double p = 0;
    for (const NodeTraction& t : r.tractions.all()) p = std::max(p, t.p);
    return p;
  };
  EXPECT_LT(p_max(fine), 0.95 * p_max(hard));
  EXPECT_NEAR(fine.contact_force.z, hard.contact_force.z, 1e-5 * hard.contact_force.z);
  const PlasticExtent a = plastic_extent(system.rail(), rough.history[kRail]),
                      b = plastic_extent(system.rail(), fine.history[kRail]);
  EXPECT_GT(b.yielded, 0);
  EXPECT_NEAR(a.accumulated, b.accumulated, 0.01 * b.accumulated);
  EXPECT_LT(fine.axle_z, hard.axle_z);
}

std::array<long, 2> hot_elements(const RollingSystem& sys, const std::array<PlasticHistory, 2>& history) {
  return {fem_checks::hot_elements(sys.rail(), history[kRail]), fem_checks::hot_elements(sys.wheel(), history[kWheel])};
}

// A box around all that yields and none at all: which elements are hot must not be seen.
TEST(SlowPlasticRolling, ElementsThatBecomeHotOnTheWayGiveTheResultsOfThoseThatWereFromTheStart) {
  const RollingSystem wide = hot_system(yielding_case(300e6)), grown = small_system(yielding_case(300e6));
  const PreloadResult a = solve_preload(wide, 1e-6), b = solve_preload(grown, 1e-6);
  const auto many = hot_elements(wide, a.history), few = hot_elements(grown, b.history);
  for (int k : {0, 1}) {
    EXPECT_GT(few[k], 0);
    EXPECT_LT(2 * few[k], many[k]);
  }
  EXPECT_NEAR(a.axle_z, b.axle_z, 1e-5 * std::abs(a.axle_z));
}

TEST(PlasticRolling, WhatComesNearYieldingOnTheWayBecomesHotAndTheBitsDoNotTell) {
  // the same start; in one run nothing but what the start needed is hot, in the other all near the path
  const RollingSystem wide = hot_system(yielding_case(300e6)), grown = small_system(yielding_case(300e6));
  PreloadResult free = solve_preload(wide, 1e-4), start = free;
  for (std::size_t k = 0; k < 2; ++k) {  // elastic
    free.history[k] = initial_history(wide.bodies[k]);
    start.history[k] = initial_history(grown.bodies[k]);
  }
  Stepper a(wide, free), b(grown, start);
  rolled(a, 70);
  rolled(b, 70);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_TRUE(same_bits(a.state().bodies[k].u, b.state().bodies[k].u));
    const PlasticExtent x = plastic_extent(wide.bodies[k], a.state().bodies[k].history),
                        y = plastic_extent(grown.bodies[k], b.state().bodies[k].history);
    EXPECT_GT(x.yielded, 10);
    EXPECT_EQ(x.yielded, y.yielded);
    EXPECT_EQ(x.accumulated, y.accumulated);
    EXPECT_EQ(grown.bodies[k].plastic.hot_places(start.history[k]), 0);
  }
}

// A layer of a millimetre on 4 mm elements: inertia is added across its thin row.
TEST(SlowPlasticRolling, WithMassScalingClosesTheEnergyBalanceAndGoesOnFromARestart) {
  CaseSpec spec = thinly_layered(yielding_case(300e6));
  spec.layers.back().material = spec.rail_material;
  const RollingSystem system = small_system(spec);
  Stepper whole(system, solve_preload(system, 1e-4));
  RestartState middle;
  EnergyBalance start;
  double most = 0;
  constexpr int kSteps = 144, kMiddle = 64;
  for (int n = 0; n < kSteps; ++n) {
    if (n == kMiddle) middle = whole.restart_state();
    if (n % 16 == 0) whole.want_energy();
    whole.step();
    if (n == 0) start = whole.energy();
    if (n % 16 == 0) most = std::max(most, std::abs(whole.energy().total() - start.total()));
  }
  const double strain = whole.energy().strain;
  Stepper second(system, std::move(middle));
  for (int n = kMiddle; n < kSteps; ++n) {
    if (n % 16 == 0) second.want_energy();
    second.step();
  }
  expect_same_motion(whole, second);
  EXPECT_GT(whole.energy().plastic, 0);
  EXPECT_LT(most, 1e-3 * strain);
  EXPECT_FALSE(whole.plan().scaling[kRail].empty());
}

TEST(PlasticRolling, WithoutAStrengthIsRefused) {
  CaseSpec spec = small_case();
  spec.run.plasticity = true;
  EXPECT_THROW(small_system(spec), CaseError);
}

}  // namespace
}  // namespace railstrata
