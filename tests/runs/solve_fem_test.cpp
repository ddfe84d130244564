#include "runs/solve_fem.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>

#include "core/faults.hpp"
#include "tests/runs/small_run.hpp"

namespace railstrata {
namespace {

using namespace run_checks;

template <class Array>
bool same_bits(const Array& a, const Array& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

void expect_same_bits(const FemPosition& a, const FemPosition& b) {
  EXPECT_EQ(a.contact.position, b.contact.position);
  EXPECT_TRUE(same_bits(a.contact.field.p, b.contact.field.p));
  EXPECT_TRUE(same_bits(a.contact.field.q_x, b.contact.field.q_x));
  EXPECT_TRUE(same_bits(a.contact.field.q_y, b.contact.field.q_y));
  EXPECT_TRUE(same_bits(a.rail.sample.stress, b.rail.sample.stress));
  EXPECT_TRUE(same_bits(a.wheel.sample.stress, b.wheel.sample.stress));
  EXPECT_EQ(a.summary.contact.patch.p_max, b.summary.contact.patch.p_max);
  EXPECT_EQ(a.summary.rail.subsurface->von_mises.value, b.summary.rail.subsurface->von_mises.value);
  EXPECT_EQ(a.summary.run.steps, b.summary.run.steps);
}

}  // namespace

TEST(SlowSolveFem, StoppedByTheFlagItGoesOnFromItsStateToTheSameBits) {
  const RollingSystem system = fem_system(small_case().spec, ".");
  const FemSolution whole = solve_fem(system);
  EXPECT_FALSE(whole.stopped);
  EXPECT_FALSE(whole.state);
  ASSERT_EQ(whole.positions.size(), 2u);

  Control control;
  RunObserver observer;
  observer.history = [&](const HistoryRow& row) { control.stop = row.position > 9e-3; };  // its last sample
  FemOptions options;
  options.control = &control;
  FemSolution first = solve_fem(system, observer, options);
  EXPECT_TRUE(first.stopped);
  EXPECT_FALSE(first.limit_reached);
  EXPECT_EQ(first.positions.size(), 1u);
  ASSERT_TRUE(first.state);
  EXPECT_GT(first.state->stepper.state.axle.x, 9e-3);

  const FemSolution second = solve_fem(system, {}, {}, std::move(first.state));
  EXPECT_FALSE(second.stopped);
  EXPECT_TRUE(same_bits(second.history, whole.history));
  ASSERT_EQ(second.positions.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) expect_same_bits(second.positions[k], whole.positions[k]);
}

TEST(SolveFem, GivesPatchStressesAndSummaryOfEveryPosition) {
  const RollingSystem system = fem_system(small_case().spec, ".");
  const FemSolution solution = solve_fem(system);
  ASSERT_EQ(solution.positions.size(), 2u);
  for (const FemPosition& position : solution.positions) {
    const double p_max = position.summary.contact.patch.p_max;
    EXPECT_NEAR(position.contact.patch.p_max, p_max, 1e-12 * p_max);
    ASSERT_TRUE(position.summary.rail.subsurface);
    EXPECT_GT(position.summary.rail.subsurface->von_mises.value, 0.3 * p_max);  // a Hertzian line: 0.56, a circle: 0.62
    EXPECT_LT(position.summary.rail.subsurface->von_mises.value, p_max);
    EXPECT_EQ(position.rail.body, &system.model.rail);
    EXPECT_EQ(position.summary.run.engine, Engine::fem);
    EXPECT_GT(position.summary.run.threads, 0);
  }
  EXPECT_GT(solution.history.size(), 30u);  // 12 mm by rows of 0.2 mm
}

TEST(SlowSolveFem, GivesTheNumbersOfDamageThatHalfSpacesGive) {
  const CaseSpec spec =
      small_case({"material.rail.yield_strength=\"400 MPa\"", "material.wheel.yield_strength=\"400 MPa\""}).spec;
  const RollingSystem system = fem_system(spec, ".");
  const FemSolution solution = solve_fem(system);
  for (const FemPosition& position : solution.positions) {
    const DamageSummary& d = position.summary.damage;
    EXPECT_GE(d.t_gamma_with_spin, d.t_gamma);
    EXPECT_GT(d.friction_energy, 0);
    ASSERT_EQ(position.summary.shakedown.bodies.size(), 2u);
    for (const BodyShakedown& body : position.summary.shakedown.bodies) {
      EXPECT_GT(body.factors.wandering, 0) << body.body;
      EXPECT_GE(body.factors.single_track, body.factors.wandering) << body.body;
      EXPECT_LE(body.factors.single_track, body.factors.upper) << body.body;
      EXPECT_EQ(body.zones.at(0).factors.single_track, body.factors.single_track) << body.body;
    }
  }
}

TEST(SolveFem, StoppedDuringThePreloadItIsInterrupted) {
  Control control;
  control.stop = true;
  FemOptions options;
  options.control = &control;
  EXPECT_THROW(solve_fem(fem_system(small_case().spec, "."), {}, options), Interrupted);
}

TEST(SolveFem, APreloadBeyondTheTimeLimitIsAnEnvironmentError) {
  FemOptions options;
  options.times.limit = 1e-9;
  EXPECT_THROW(solve_fem(fem_system(small_case().spec, "."), {}, options), EnvironmentError);
}

TEST(SolveFem, AWishToSaveGivesOneCheckpointAndIsSetBack) {
  const RollingSystem system = fem_system(small_case().spec, ".");
  Control control;
  control.save = true;
  int checkpoints = 0;
  RunObserver observer;
  observer.save = [&](const RunState& state, bool stopping) {
    ++checkpoints;
    EXPECT_FALSE(stopping);
    EXPECT_GT(state.stepper.dt, 0);
  };
  FemOptions options;
  options.control = &control;
  EXPECT_FALSE(solve_fem(system, observer, options).stopped);
  EXPECT_EQ(checkpoints, 1);
  EXPECT_FALSE(control.save);
}

}  // namespace railstrata
