#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstring>

#include "core/faults.hpp"
#include "small_rolling.hpp"
#include "thread_ranks.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

template <class Array>
bool same_bits(const Array& a, const Array& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

void expect_same_state(const RestartState& a, const RestartState& b, const std::string& where) {
  EXPECT_EQ(a.state.step, b.state.step) << where;
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_TRUE(same_bits(a.state.bodies[k].u, b.state.bodies[k].u)) << where << ", u of body " << k;
    EXPECT_TRUE(same_bits(a.state.bodies[k].v, b.state.bodies[k].v)) << where << ", v of body " << k;
    EXPECT_TRUE(a.state.bodies[k].history == b.state.bodies[k].history) << where << ", history " << k;
  }
  EXPECT_TRUE(same_bits(a.state.tractions.all(), b.state.tractions.all())) << where;
  EXPECT_TRUE(same_bits(a.state.groups, b.state.groups)) << where;
  EXPECT_TRUE(same_bits(a.state.sleepers, b.state.sleepers)) << where;
  EXPECT_EQ(std::memcmp(&a.state.axle, &b.state.axle, sizeof a.state.axle), 0) << where;
  EXPECT_EQ(std::memcmp(&a.balance, &b.balance, sizeof a.balance), 0) << where;
  EXPECT_EQ(std::memcmp(&a.mean, &b.mean, sizeof a.mean), 0) << where;
}

// Energies now and then, as a run's history asks for them.
void roll(Stepper& st, int steps) {
  for (int k = 0; k < steps; ++k) {
    if (st.state().step % 11 == 5) st.want_energy();
    st.step();
  }
}

RestartState whole_state(Stepper& st) {
  st.complete();
  return st.restart_state();
}

void expect_same_preload(const PreloadResult& a, const PreloadResult& b, const std::string& where) {
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_TRUE(same_bits(a.u[k], b.u[k])) << where << ", u of body " << k;
    EXPECT_TRUE(a.history[k] == b.history[k]) << where << ", history " << k;
  }
  EXPECT_TRUE(same_bits(a.tractions.all(), b.tractions.all())) << where;
  EXPECT_EQ(a.axle_z, b.axle_z) << where;
  EXPECT_EQ(a.residual, b.residual) << where;
  EXPECT_EQ(a.newton_steps, b.newton_steps) << where;
  EXPECT_EQ(a.cg_iterations, b.cg_iterations) << where;
}

struct RanksAndThreads {
  int ranks, threads;
};

// The preload that several ranks find together is that of one, to the last bit.
void expect_preload_of_one_rank(const CaseSpec& spec, const std::vector<RanksAndThreads>& counts) {
  constexpr double kTolerance = 1e-3;
  const RollingSystem system = small_system(spec);
  const PreloadResult expected = solve_preload(system, kTolerance);
  for (const auto& [ranks, threads] : counts)
    ThreadRanks(ranks).run(threads, [&, of = ranks](const Ranks& mine) {
      const PreloadResult found = solve_preload(system, kTolerance, {}, nullptr, mine);
      expect_same_preload(found, expected, std::to_string(mine.rank) + " of " + std::to_string(of) + " ranks");
    });
}

// The state after so many steps, of every rank.
std::vector<RestartState> states_of(const RollingSystem& system, const PreloadResult& preload, int ranks, int threads,
                                    int steps) {
  std::vector<RestartState> out(static_cast<std::size_t>(ranks));
  ThreadRanks(ranks).run(threads, [&](const Ranks& mine) {
    Stepper st(system, preload, mine);
    roll(st, steps);
    out[static_cast<std::size_t>(mine.rank)] = whole_state(st);
  });
  return out;
}

constexpr int kSteps = 64;

// The damping ends on the way: steps with sums, without, and with energies.
CaseSpec damped_case() {
  CaseSpec spec = small_case();
  spec.run.run_up = 5e-4;
  spec.run.run_up_damping = 2000;
  spec.drive.torque_ramp = 1e-4;
  return spec;
}

void expect_bits_of_one_rank(const CaseSpec& spec, const std::vector<int>& counts = {2, 3, 4}, int steps = kSteps) {
  const RollingSystem system = small_system(spec);
  const PreloadResult preload = solve_preload(system, 1e-4);
  Stepper one(system, preload);
  roll(one, steps);
  const RestartState expected = one.restart_state();
  for (int ranks : counts)
    for (int threads : {1, 2}) {
      const std::vector<RestartState> found = states_of(system, preload, ranks, threads, steps);
      for (int r = 0; r < ranks; ++r)
        expect_same_state(
            found[static_cast<std::size_t>(r)], expected,
            std::to_string(r) + " of " + std::to_string(ranks) + " ranks, threads " + std::to_string(threads));
    }
}

}  // namespace

TEST(Ranks, TwoComputeTheBitsOfOne) { expect_bits_of_one_rank(damped_case(), {2}, 32); }

TEST(SlowRanks, ComputeTheBitsOfOne) { expect_bits_of_one_rank(damped_case()); }

TEST(SlowRanks, OnATrackToo) {
  expect_bits_of_one_rank(on_track(damped_case()), {3}, 32);
  expect_preload_of_one_rank(on_track(small_case()), {{3, 2}});
}

TEST(SlowRanks, OverTheEndOfALayerToo) { expect_bits_of_one_rank(ending_layer(damped_case()), {3}, 32); }

TEST(SlowRanks, WithAThinLayerAndScaledMassesToo) { expect_bits_of_one_rank(thinly_layered(damped_case())); }

TEST(SlowRanks, InSinglePrecisionOfAYawedWheelThatIsFreeSidewaysToo) {
  CaseSpec spec = damped_case();
  spec.run.precision = ArithmeticPrecision::single_precision;
  spec.geometry.yaw = 5e-3;
  spec.drive.lateral_traction_coefficient = 0.1;
  spec.vehicle.couple_sprung_mass = true;
  expect_bits_of_one_rank(spec, {2});
}

CaseSpec yielding(CaseSpec spec) {
  spec.run.plasticity = true;
  for (MaterialSpec* m : {&spec.rail_material, &spec.wheel_material}) {
    m->strength.yield_strength = 300e6;
    m->strength.kinematic_hardening = {{20e9, 50}};
  }
  return spec;
}

// Bodies yield, and elements become hot on the way.
TEST(SlowRanks, OfBodiesThatYieldToo) { expect_bits_of_one_rank(yielding(damped_case()), {2, 4}); }

TEST(SlowRanks, OfBodiesThatYieldOverTheEndOfALayerToo) {
  expect_bits_of_one_rank(ending_layer(yielding(damped_case())), {2, 4});
}

TEST(SlowRanks, FindThePreloadOfOne) { expect_preload_of_one_rank(small_case(), {{2, 2}, {3, 1}, {4, 1}}); }

TEST(SlowRanks, FindThePreloadOfOneOfBodiesThatYieldAndAreLayeredAndYawedToo) {
  CaseSpec spec = thinly_layered(yielding(damped_case()));
  spec.geometry.yaw = 5e-3;
  spec.drive.lateral_traction_coefficient = 0.1;
  spec.vehicle.couple_sprung_mass = true;
  expect_preload_of_one_rank(spec, {{3, 1}});
}

// A signal reaches one of them: all end at the same place.
TEST(SlowRanks, StopTogetherInThePreload) {
  const RollingSystem system = small_system(small_case());
  std::array<int, 2> ended = {};
  ThreadRanks(2).run(1, [&](const Ranks& mine) {
    int steps = 0;
    const auto progress = [&](double, double, int) {
      ended[static_cast<std::size_t>(mine.rank)] = ++steps;
      return !(steps == 2 && mine.rank == 1);
    };
    EXPECT_THROW(solve_preload(system, 1e-9, progress, nullptr, mine), Interrupted);
  });
  EXPECT_EQ(ended, (std::array<int, 2>{2, 2}));
}

TEST(SlowRanks, GoOnWithTheStateOfAnotherNumberOfRanks) {
  const RollingSystem system = small_system(damped_case());
  const PreloadResult preload = solve_preload(system, 1e-4);
  Stepper one(system, preload);
  roll(one, kSteps);
  const RestartState expected = one.restart_state();
  RestartState state = states_of(system, preload, 3, 1, 16).front();
  for (int ranks : {2, 4, 1}) {
    RestartState next;
    ThreadRanks(ranks).run(1, [&](const Ranks& mine) {
      Stepper st(system, state, mine);
      roll(st, 16);
      RestartState own = whole_state(st);
      if (mine.is_root()) next = std::move(own);
    });
    state = std::move(next);
  }
  expect_same_state(state, expected, "3, 2, 4 and 1 ranks");
}

// A run with its samples, histories, frames and saved states, beyond the window around the contact in which all ranks
// know the running surface (4 elements, fem/line_reach.hpp).
TEST(SlowRanks, RunACaseToTheBitsOfOne) {
  CaseSpec spec = damped_case();
  spec.drive.speed = 12;
  spec.run.positions = {5e-3, 4.5 * spec.mesh.element_size};
  spec.run.window = 4e-3;
  spec.run.history_interval = 1e-4;
  const RollingSystem system = small_system(spec);
  const auto observed = [](std::vector<RollingSample>& frames, RestartState& saved) {
    RunObserver observer;
    observer.frame = [&](const RollingSample& sample) { frames.push_back(sample); };
    observer.save = [&](const RunState& state, bool) { saved = state.stepper; };
    observer.demand = [asked = 0]() mutable { return ++asked == 9 ? Demand::save : Demand::go_on; };
    return observer;
  };
  std::vector<RollingSample> frames;
  RestartState saved;
  const RunResult expected = run_rolling(system, observed(frames, saved));
  ASSERT_EQ(saved.state.step, 128);
  ThreadRanks(3).run(1, [&](const Ranks& mine) {
    std::vector<RollingSample> own_frames;
    RestartState own_saved;
    const RunResult found = run_rolling(system, observed(own_frames, own_saved), nullptr, {mine, {}});
    EXPECT_EQ(found.steps, expected.steps);
    EXPECT_TRUE(same_bits(found.history, expected.history));
    EXPECT_EQ(found.closure, expected.closure);
    expect_same_state(own_saved, saved, "the saved state");
    ASSERT_EQ(own_frames.size(), frames.size());
    for (std::size_t k = 0; k < frames.size(); ++k)
      EXPECT_TRUE(same_bits(own_frames[k].wheel.stress, frames[k].wheel.stress)) << k;
    for (std::size_t p = 0; p < 2; ++p) {
      const auto &a = found.positions[p].samples, &b = expected.positions[p].samples;
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t k = 0; k < a.size(); ++k) {
        EXPECT_TRUE(same_bits(a[k].rail.stress, b[k].rail.stress)) << p << ", " << k;
        EXPECT_TRUE(same_bits(a[k].rail.displacement, b[k].rail.displacement)) << p << ", " << k;
        EXPECT_TRUE(same_bits(a[k].wheel.stress, b[k].wheel.stress)) << p << ", " << k;
      }
    }
  });
}

// One exchange a step and no more, but where the state is made whole.
// The sums that damping wants are a second exchange.
TEST(SlowRanks, ExchangeOnceAStep) {
  CaseSpec damped = small_case();
  damped.run.run_up = 1;
  damped.run.run_up_damping = 2000;
  for (const auto& [spec, exchanges] : {std::pair{small_case(), 1}, std::pair{damped, 2}}) {
    const RollingSystem system = small_system(spec);
    const PreloadResult preload = solve_preload(system, 1e-3);
    ThreadRanks ranks(2);
    ranks.run(1, [&](const Ranks& mine) {
      Stepper st(system, preload, mine);
      for (int k = 0; k < 20; ++k) st.step();
    });
    EXPECT_EQ(ranks.gathers(), 20 * exchanges);
  }
}

TEST(Ranks, MoreThanThereArePiecesAreRefused) {
  const RollingSystem system = small_system(small_case());
  const PreloadResult preload = solve_preload(system, 1e-3);
  try {
    Stepper(system, preload, Ranks{1000, 0});
    FAIL();
  } catch (const CaseError& e) {
    EXPECT_NE(std::string(e.what()).find("1000 ranks cannot share this mesh: it has "), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("start fewer ranks, with more threads each"), std::string::npos);
  }
}

// As on a machine of another kind: the second rank starts from another last bit.
TEST(SlowRanks, ThatComputeOtherBitsAreFound) {
  const RollingSystem system = small_system(small_case());
  const PreloadResult preload = solve_preload(system, 1e-3);
  EXPECT_THROW(ThreadRanks(2).run(1,
                                  [&](const Ranks& mine) {
                                    PreloadResult own = preload;
                                    if (mine.rank == 1) own.axle_z = std::nextafter(own.axle_z, 1);
                                    Stepper(system, own, mine).step();
                                  }),
               EnvironmentError);
}

}  // namespace railstrata
