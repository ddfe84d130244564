// A wheel that rolls more than a turn: its fine band is a closed ring, and the contact crosses the place where it
// closes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "small_rolling.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

constexpr double kTurn = 2 * std::numbers::pi;

/// A wheel of 50 mm: a turn is a third of a metre.
CaseSpec tiny_wheel(std::vector<double> positions) {
  CaseSpec s = small_case();
  s.geometry.wheel_radius = 0.05;
  s.geometry.rim_thickness = 0.02;
  s.geometry.bore_radius = 0.02;
  s.geometry.block_height = 0.03;
  s.vehicle.wheel_mass = 60;
  s.vehicle.sprung_mass = 500;
  s.drive.speed = 40;
  s.drive.traction_coefficient = 0;
  s.mesh.largest = 12e-3;
  s.mesh.end_length = 0.03;
  s.run.positions = std::move(positions);
  s.run.window = 24e-3;
  s.run.run_up = 0.05;
  s.run.run_up_damping = 3000;
  s.run.history_interval = 2e-3;
  s.run.time_step_method = TimeStepMethod::uniform;
  return s;
}

/// Of the samples around a position: mean and standard deviation.
struct Measured {
  double mean = 0, scatter = 0;
};
template <class Value>
Measured measured(const PositionSamples& position, Value&& value) {
  Measured m;
  double square = 0;
  for (const RollingSample& s : position.samples) {
    m.mean += value(s);
    square += value(s) * value(s);
  }
  const auto n = static_cast<double>(position.samples.size());
  m.mean /= n;
  m.scatter = std::sqrt(std::max(0.0, square / n - m.mean * m.mean));
  return m;
}
double p_max(const RollingSample& s) {
  double most = 0;
  for (const NodeTraction& t : s.tractions) most = std::max(most, t.p);
  return most;
}
double vertical_force(const RollingSample& s) { return s.forces.z; }
double creepage(const RollingSample& s) { return s.creepage; }

struct LongRoll {
  CaseSpec spec;
  RollingSystem system;
  double early, closure, late;  ///< m, wheel positions: in the first turn, over the place where the ring closes, after
                                ///< a turn and a quarter
  static CaseSpec with_positions() {
    const RollingSystem once = small_system(tiny_wheel({0.4}));
    const double r = once.rolling_radius;
    return tiny_wheel({0.3 * kTurn * r, (kTurn + once.model.wheel.contact.fine_begin) * r, 1.25 * kTurn * r});
  }
  LongRoll()
      : spec(with_positions()),
        system(small_system(spec)),
        early(spec.run.positions[0]),
        closure(spec.run.positions[1]),
        late(spec.run.positions[2]) {}
};

}  // namespace

TEST(SlowTurns, ContactIsTheSameWhereTheRingClosesAndAfterATurn) {
  const LongRoll roll;
  const Block& band = roll.system.model.wheel.blocks[roll.system.model.wheel.contact.block];
  ASSERT_NEAR(roll.system.model.wheel.contact.fine_end - band.stations.at.front(), kTurn, 1e-12);
  const RunResult run = run_rolling(roll.system, {});
  for (const PositionSamples& p : run.positions) {
    const Measured a = measured(p, p_max), b = measured(p, vertical_force), c = measured(p, creepage);
    printf("x %g n %zu p %g +- %g F %g +- %g creep %g +- %g\n", p.position, p.samples.size(), 1e-6 * a.mean,
           1e-6 * a.scatter, b.mean, b.scatter, c.mean, c.scatter);
  }
  printf("steps %ld wall %g pre %g closure %g elements %ld\n", run.steps, run.wall_seconds, run.preload_wall_seconds,
         run.closure, run.elements);
  EXPECT_FALSE(run.reached_edge);
}

TEST(SlowTurns, AClosedRingRollsAsAnOpenOneDoesInTheFirstTurn) {
  const LongRoll roll;
  CaseSpec spec = roll.spec;
  spec.run.positions = {roll.early};
  const RollingSystem open = small_system(spec);
  const ContactBand& band = open.model.wheel.contact;
  ASSERT_LT(band.fine_end - band.fine_begin, 0.9 * kTurn);
  const RunResult run = run_rolling(open, {});
  const PositionSamples& p = run.positions[0];
  const Measured a = measured(p, p_max), b = measured(p, vertical_force), c = measured(p, creepage);
  printf("x %g n %zu p %g +- %g F %g +- %g creep %g +- %g\n", p.position, p.samples.size(), 1e-6 * a.mean,
         1e-6 * a.scatter, b.mean, b.scatter, c.mean, c.scatter);
}

// Stopped just before the contact reaches the place where the ring closes.
TEST(SlowTurns, ResumeAcrossTheClosureComputesTheSameBits) {
  LongRoll roll;
  roll.spec.run.positions.pop_back();
  const RollingSystem system = small_system(roll.spec);
  const RunResult whole = run_rolling(system, {});
  double x = 0;
  RunState saved;
  RunObserver observer;
  observer.history = [&](const HistoryRow& row) { x = row.position; };
  observer.demand = [&] { return x > roll.closure - 0.02 ? Demand::save_and_stop : Demand::go_on; };
  observer.save = [&](const RunState& state) { saved = state; };
  EXPECT_TRUE(run_rolling(system, observer).stopped);
  ASSERT_GT(saved.stepper.state.axle.psi, 0.9 * kTurn);
  ASSERT_LT(saved.stepper.state.axle.x, roll.closure - 0.5 * roll.spec.run.window);
  const RunResult resumed = resume_rolling(system, {}, std::move(saved));
  EXPECT_EQ(resumed.steps, whole.steps);
  ASSERT_EQ(resumed.history.size(), whole.history.size());
  EXPECT_EQ(std::memcmp(resumed.history.data(), whole.history.data(), sizeof(HistoryRow) * whole.history.size()), 0);
  const std::vector<RollingSample>&a = whole.positions[1].samples, &b = resumed.positions[1].samples;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(p_max(a[k]), p_max(b[k]));
    ASSERT_EQ(a[k].wheel.stress.size(), b[k].wheel.stress.size());
    EXPECT_EQ(std::memcmp(a[k].wheel.stress.data(), b[k].wheel.stress.data(), sizeof(Sym3) * a[k].wheel.stress.size()),
              0);
  }
}

}  // namespace railstrata
