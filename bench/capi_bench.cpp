// A vehicle code's use of the C interface: 1,000 contacts along a lateral sweep, as one time step after the other would
// ask for them (LMA on CN60, 85 kN, creepage 1e-3, cells of 0.5 mm: about 500 in contact). CPU time of one thread.
//
// Lines: median and 90 % quantile of a solution, each started from the one before (warm) or anew (cold), without a
// layer and with 2 mm at 2 E0.
#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <vector>

#include "capi/railstrata.h"
#include "core/parallel.hpp"

namespace {

double cpu_seconds() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

constexpr const char *kPlain = "[geometry]\nlateral_shift = \"0 mm\"\n",
                     *kLayered =
                         "[geometry]\nlateral_shift = \"0 mm\"\n[[layer]]\nthickness = \"2 mm\"\nyoung_ratio = 2\n";

void lateral_sweep(benchmark::State& state, const char* text, bool warm) {
  railstrata::set_threads(1);
  constexpr int kSolutions = 1000;
  rs_error error{};
  rs_contact* contact = rs_contact_from_text(text, nullptr, 0, &error);
  rs_set_cell(contact, 0.5e-3, &error);
  rs_state s{};
  s.size = sizeof(s);
  s.given = RS_LATERAL_SHIFT | RS_CREEPAGE_X;
  s.creepage_x = -1e-3;
  rs_forces forces{};
  forces.size = sizeof(forces);
  std::vector<double> seconds;
  for (auto _ : state) {
    for (int k = 0; k < kSolutions; ++k) {
      s.lateral_shift = (-2 + 5.0 * k / kSolutions) * 1e-3;
      if (!warm) rs_forget(contact);
      const double begun = cpu_seconds();
      if (rs_solve(contact, &s, &forces, &error) != RS_OK) state.SkipWithError(error.message);
      seconds.push_back(cpu_seconds() - begun);
    }
  }
  rs_contact_free(contact);
  std::sort(seconds.begin(), seconds.end());
  state.counters["median_ms"] = 1e3 * seconds[seconds.size() / 2];
  state.counters["ninety_percent_ms"] = 1e3 * seconds[seconds.size() * 9 / 10];
  state.counters["cells"] = forces.cells;
}

BENCHMARK_CAPTURE(lateral_sweep, plain_warm, kPlain, true)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(lateral_sweep, plain_cold, kPlain, false)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(lateral_sweep, layered_warm, kLayered, true)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(lateral_sweep, layered_cold, kLayered, false)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace

BENCHMARK_MAIN();
