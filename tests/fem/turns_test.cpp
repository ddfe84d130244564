// A wheel that rolls more than a turn: its fine band is a closed ring, and the contact crosses the place where it
// closes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "small_rolling.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

constexpr double kTurn = 2 * std::numbers::pi;

/// A wheel of 80 mm: a turn is half a metre, 168 elements.
CaseSpec tiny_wheel(std::vector<double> positions) {
  CaseSpec s = small_case();
  s.geometry.wheel_radius = 168 * 3e-3 / kTurn;  // nodes of rail and wheel meet alike all the way
  s.geometry.wheel_section.rim_thickness = 0.02;
  s.geometry.wheel_section.bore_radius = 0.05;
  s.geometry.block_width = 0.04;
  s.geometry.block_height = 0.02;
  s.vehicle.wheel_mass = 200;
  s.vehicle.sprung_mass = 4000;
  s.drive.speed = 20;
  s.drive.traction_coefficient = 0;
  s.mesh.element_size = 3e-3;
  s.mesh.fine_width = 24e-3;
  s.mesh.fine_depth = 6e-3;
  s.mesh.largest = 20e-3;
  s.mesh.end_length = 0.03;
  s.run.positions = std::move(positions);
  s.run.window = 24e-3;
  s.run.run_up = 0.1;
  s.run.run_up_damping = 3000;
  s.run.history_interval = 2e-3;
  s.run.mass_scaling_step = 0;
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

/// Equal within the scatter of samples a rail element apart.
void expect_like(const PositionSamples& a, const PositionSamples& b) {
  const auto compare = [&](const char* what, auto&& value) {
    const Measured first = measured(a, value), second = measured(b, value);
    EXPECT_NEAR(first.mean, second.mean, 3 * (first.scatter + second.scatter)) << what << " at " << a.position;
    EXPECT_LT(first.scatter, 0.03 * std::abs(first.mean)) << what;
  };
  ASSERT_EQ(a.samples.size(), b.samples.size());
  compare("p_max", p_max);
  compare("F_z", [](const RollingSample& s) { return s.forces.z; });
  compare("creepage", [](const RollingSample& s) { return s.creepage; });
}

struct LongRoll {
  CaseSpec spec;
  double early, closure, late;  ///< m, wheel positions: in the first turn, over the place where the ring closes, after
                                ///< a turn and a quarter
  LongRoll() {
    const RollingSystem once = small_system(tiny_wheel({1.0}));
    const std::vector<double>& at = once.rail_surface().stations.at;
    const auto on_a_node = [&](double x) { return *std::lower_bound(at.begin(), at.end(), x); };
    const double turn = kTurn * once.rolling_radius;
    early = on_a_node(0.3 * turn);
    closure = on_a_node(turn + once.model.wheel.contact.fine_begin * once.rolling_radius);
    late = on_a_node(1.25 * turn);
    spec = tiny_wheel({early, closure, late});
  }
};

}  // namespace

TEST(LongTurns, ContactIsTheSameOverTheClosureAfterATurnAndOnAnOpenWheel) {
  const LongRoll roll;
  CaseSpec shorter = roll.spec;
  shorter.run.positions = {roll.early};
  const RollingSystem closed = small_system(roll.spec), open = small_system(shorter);
  const ContactBand &ring = closed.model.wheel.contact, &part = open.model.wheel.contact;
  ASSERT_NEAR(ring.fine_end - ring.fine_begin, kTurn, 1e-12);
  ASSERT_LT(part.fine_end - part.fine_begin, 0.9 * kTurn);
  const RunResult run = run_rolling(closed, {});
  EXPECT_FALSE(run.reached_edge);
  ASSERT_EQ(run.positions.size(), 3u);
  expect_like(run.positions[1], run.positions[0]);
  expect_like(run.positions[2], run.positions[0]);
  expect_like(run_rolling(open, {}).positions[0], run.positions[0]);
}

// Stopped just before the contact reaches the place where the ring closes.
TEST(LongTurns, ResumeAcrossTheClosureComputesTheSameBits) {
  LongRoll roll;
  roll.spec.run.positions.pop_back();
  const RollingSystem system = small_system(roll.spec);
  const RunResult whole = run_rolling(system, {});
  double x = 0;
  RunState saved;
  RunObserver observer;
  observer.history = [&](const HistoryRow& row) { x = row.position; };
  observer.demand = [&] { return x > roll.closure - 0.02 ? Demand::save_and_stop : Demand::go_on; };
  observer.save = [&](const RunState& state, bool) { saved = state; };
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
