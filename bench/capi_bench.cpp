// A vehicle code's use of the C interface: 1,000 contacts along a lateral sweep, as one time step after the other would
// ask for them (LMA on CN60 and S1002 on UIC60, 85 kN, creepage 1e-3, cells of 0.5 mm: about 500 in contact). CPU time
// of one thread.
//
// Lines: median, 90 % and 99 % quantile of a solution, each started from the one before (warm) or anew (cold), without
// a layer and with 2 mm at 2 E0; with a yaw, and a roll besides; rs_jacobian by six inputs after each solution. Then
// states of a running wheel, successive along its way or at random, and of a wheelset, both contacts under its load.
#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "capi/railstrata.h"
#include "core/parallel.hpp"

namespace {

double cpu_seconds() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

#define RAILS "[geometry]\nlateral_shift = \"0 mm\"\n"
#define EUROPEAN RAILS "wheel_profile = \"S1002\"\nrail_profile = \"UIC60\"\n"
#define SECTIONS RAILS "[bem]\nbodies = \"sections\"\n"
#define LAYER "[[layer]]\nthickness = \"2 mm\"\nyoung_ratio = 2\n"
constexpr const char *kPlain = RAILS, *kEuropean = EUROPEAN, *kLayered = RAILS LAYER,
                     *kEuropeanLayered = EUROPEAN LAYER, *kSections = SECTIONS, *kSectionsLayered = SECTIONS LAYER;

struct Sweep {
  const char* text = kPlain;
  bool warm = true;
  double yaw = 0, roll = 0;
  bool derivatives = false;
};

/// Seconds of the derivatives after a solution by what a vehicle's step changes.
double jacobian_seconds(benchmark::State& state, rs_contact* contact) {
  constexpr unsigned kInputs[] = {RS_LOAD, RS_LATERAL_SHIFT, RS_YAW, RS_CREEPAGE_X, RS_CREEPAGE_Y, RS_SPIN};
  rs_derivatives slopes[std::size(kInputs)];
  for (rs_derivatives& s : slopes) s.size = sizeof(s);
  rs_error error{};
  const double begun = cpu_seconds();
  if (rs_jacobian(contact, kInputs, std::size(kInputs), slopes, &error) != RS_OK) state.SkipWithError(error.message);
  return cpu_seconds() - begun;
}

/// `name`: "" or with an underscore at its end.
void tell(benchmark::State& state, std::vector<double>& times, const std::string& name) {
  if (times.empty()) return;
  std::sort(times.begin(), times.end());
  for (const auto& [word, share] : {std::pair("median", 0.5), {"p90", 0.9}, {"p99", 0.99}})
    state.counters[name + word + "_ms"] =
        1e3 * times[static_cast<std::size_t>(share * static_cast<double>(times.size()))];
}

void lateral_sweep(benchmark::State& state, const Sweep& sweep) {
  railstrata::set_threads(1);
  constexpr int kSolutions = 1000;
  rs_error error{};
  rs_contact* contact = rs_contact_from_text(sweep.text, nullptr, 0, &error);
  rs_set_cell(contact, 0.5e-3, &error);
  rs_state s{};
  s.size = sizeof(s);
  s.given = RS_LATERAL_SHIFT | RS_CREEPAGE_X | RS_YAW | RS_ROLL;
  s.yaw = sweep.yaw;
  s.roll = sweep.roll;
  s.creepage_x = -1e-3;
  rs_forces forces{};
  forces.size = sizeof(forces);
  std::vector<double> seconds, of_derivatives;
  for (auto _ : state) {
    for (int k = 0; k < kSolutions; ++k) {
      s.lateral_shift = (-2 + 5.0 * k / kSolutions) * 1e-3;
      if (!sweep.warm) rs_forget(contact);
      const double begun = cpu_seconds();
      if (rs_solve(contact, &s, &forces, &error) != RS_OK) state.SkipWithError(error.message);
      seconds.push_back(cpu_seconds() - begun);
      if (sweep.derivatives) of_derivatives.push_back(jacobian_seconds(state, contact));
    }
  }
  rs_contact_free(contact);
  tell(state, seconds, "");
  tell(state, of_derivatives, "jacobian_");
  state.counters["cells"] = forces.cells;
}

#define SWEEP(name, ...) \
  BENCHMARK_CAPTURE(lateral_sweep, name, Sweep __VA_ARGS__)->Unit(benchmark::kMillisecond)->Iterations(1)
SWEEP(plain_warm, {kPlain, true});
SWEEP(plain_cold, {kPlain, false});
SWEEP(european_warm, {kEuropean, true});
SWEEP(european_cold, {kEuropean, false});
SWEEP(layered_warm, {kLayered, true});
SWEEP(layered_cold, {kLayered, false});
SWEEP(european_layered_warm, {kEuropeanLayered, true});
SWEEP(european_layered_cold, {kEuropeanLayered, false});
SWEEP(sections_warm, {kSections, true});
SWEEP(sections_cold, {kSections, false});
SWEEP(sections_layered_warm, {kSectionsLayered, true});
SWEEP(yaw_1e6_warm, {kPlain, true, 1e-6});
SWEEP(yaw_warm, {kPlain, true, 5e-3});
SWEEP(european_yaw_warm, {kEuropean, true, 5e-3});
SWEEP(yaw_cold, {kPlain, false, 5e-3});
SWEEP(roll_warm, {kPlain, true, 5e-3, 1e-3});
SWEEP(plain_derivatives, {kPlain, true, 5e-3, 0, true});
SWEEP(european_derivatives, {kEuropean, true, 5e-3, 0, true});
SWEEP(layered_derivatives, {kLayered, true, 5e-3, 0, true});
SWEEP(european_layered_derivatives, {kEuropeanLayered, true, 5e-3, 0, true});

/// Shift within 6 mm, yaw within 5e-3, the roll that cones of 1:20 give with the shift, load 85 kN and 30 % more or
/// less, creepages within 1e-3. share: of each but the roll, -1 to 1.
template <class Share>
rs_state running(Share&& share) {
  rs_state s{};
  s.size = sizeof(s);
  s.given = RS_LOAD | RS_LATERAL_SHIFT | RS_YAW | RS_ROLL | RS_CREEPAGE_X | RS_CREEPAGE_Y;
  s.lateral_shift = 6e-3 * share(0);
  s.yaw = 5e-3 * share(1);
  s.roll = 0.05 / 0.75 * s.lateral_shift;
  s.load = 85e3 * (1 + 0.3 * share(2));
  s.creepage_x = 1e-3 * share(3);
  s.creepage_y = 1e-3 * share(4);
  return s;
}

/// Successive: two waves of hunting, as of 15 m at 30 m/s in steps of 1 ms, the load in five waves.
void run_of_states(benchmark::State& state, const char* text, bool successive) {
  railstrata::set_threads(1);
  constexpr int kSolutions = 1000;
  rs_error error{};
  rs_contact* contact = rs_contact_from_text(text, nullptr, 0, &error);
  rs_set_cell(contact, 0.5e-3, &error);
  rs_forces forces{};
  forces.size = sizeof(forces);
  std::mt19937 random(1);
  std::vector<double> seconds;
  int failed = 0;
  for (auto _ : state) {
    for (int k = 0; k < kSolutions; ++k) {
      const rs_state s = running([&](int which) {
        constexpr double kWaves[] = {2, 2, 5, 3, 4}, kBegin[] = {0, 1.5, 0.3, 0.7, 2};
        return successive ? std::sin(2 * std::numbers::pi * kWaves[which] * k / kSolutions + kBegin[which])
                          : 2 * static_cast<double>(random()) / 4294967296.0 - 1;
      });
      const double begun = cpu_seconds();
      failed += rs_solve(contact, &s, &forces, &error) != RS_OK;
      seconds.push_back(cpu_seconds() - begun);
    }
  }
  rs_contact_free(contact);
  tell(state, seconds, "");
  state.counters["failed"] = failed;
}
#define STATES(name, ...) \
  BENCHMARK_CAPTURE(run_of_states, name, __VA_ARGS__)->Unit(benchmark::kMillisecond)->Iterations(1)
STATES(successive, kPlain, true);
STATES(random, kPlain, false);
STATES(european_successive, kEuropean, true);
STATES(european_random, kEuropean, false);

/// Shift within 6 mm, yaw within 5e-3, 160 kN and 30 % more or less: 1,000 steps along two waves of hunting, cells of 1
/// mm. Height and roll are found.
void run_of_wheelset(benchmark::State& state, const char* text) {
  railstrata::set_threads(1);
  constexpr int kSolutions = 1000;
  rs_error error{};
  rs_wheelset* set = rs_wheelset_from_text(text, nullptr, 0, nullptr, 0, &error);
  for (int side : {RS_LEFT, RS_RIGHT}) rs_set_cell(rs_wheelset_contact(set, side), 1e-3, &error);
  rs_wheelset_state s{};
  s.size = sizeof(s);
  s.given = RS_WHEELSET_LOAD;
  s.speed = 30;
  rs_wheelset_forces forces{};
  forces.size = sizeof(forces);
  std::vector<double> seconds;
  int failed = 0;
  for (auto _ : state) {
    for (int k = 0; k < kSolutions; ++k) {
      const double wave = 4 * std::numbers::pi * k / kSolutions;
      s.y = 6e-3 * std::sin(wave);
      s.yaw = 5e-3 * std::sin(wave + 1.5);
      s.load = 160e3 * (1 + 0.3 * std::sin(2.5 * wave + 0.3));
      const double begun = cpu_seconds();
      failed += rs_wheelset_solve(set, &s, &forces, &error) != RS_OK;
      seconds.push_back(cpu_seconds() - begun);
    }
  }
  rs_wheelset_free(set);
  tell(state, seconds, "");
  state.counters["failed"] = failed;
}
#define WHEELSET(name, text) \
  BENCHMARK_CAPTURE(run_of_wheelset, name, text)->Unit(benchmark::kMillisecond)->Iterations(1)
WHEELSET(plain, kPlain);
WHEELSET(layered, kLayered);
WHEELSET(sections, kSections);
WHEELSET(sections_layered, kSectionsLayered);
WHEELSET(european, kEuropean);
WHEELSET(european_layered, kEuropeanLayered);

}  // namespace

BENCHMARK_MAIN();
