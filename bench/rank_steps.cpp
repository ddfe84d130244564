// Where the time of a step goes, rank by rank: whole steps of a case after its preload, by the ranks that mpirun has
// started, or by one with OMP_NUM_THREADS threads. Medians over the steps in us, a column a rank.
//
// usage: [mpirun -n N] rank_steps PLUG_IN CASE STEPS [KEY=VALUE...], as `railstrata run --set`
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <vector>

#include "bench/plug_in_ranks.hpp"
#include "fem/step_laps.hpp"
#include "fem/stepper.hpp"
#include "reader/case_file.hpp"

using namespace railstrata;

namespace {

constexpr int kFirst = 20;  // steps, for caches and memory
using Clock = std::chrono::steady_clock;

// Ranks of the plug-in, with a watch.
struct Timed {
  RailstrataRanks joined{.count = 1, .rank = 0, .on_this_machine = 1, .gather = nullptr, .leave = nullptr};
  double spent = 0;  // s
  static void gather(void* context, double* all, const std::ptrdiff_t* sizes) {
    Timed& own = *static_cast<Timed*>(context);
    const Clock::time_point begun = Clock::now();
    if (const char* trouble = own.joined.gather(all, sizes)) {
      fmt::print(stderr, "{}\n", trouble);
      std::exit(1);
    }
    own.spent += std::chrono::duration<double>(Clock::now() - begun).count();
  }
  Ranks ranks() { return {joined.count, joined.rank, this, gather}; }
};

double median(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "usage: [mpirun -n N] rank_steps PLUG_IN CASE STEPS [KEY=VALUE...]\n");
    return 2;
  }
  Timed timed;
  if (std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr && !join_ranks(argv[1], timed.joined)) {
    fmt::print(stderr, "name build/railstrata_mpi.so\n");
    return 1;
  }
  const Ranks ranks = timed.ranks();
  const LoadedCase loaded = load_case(argv[2], {argv + 4, argv + argc});
  const int steps = std::atoi(argv[3]);
  const RollingSystem system(build_model(loaded.spec, loaded.folder()));
  Stepper stepper(system, solve_preload(system, 1e-2), ranks);
  StepLaps laps;
  stepper.time_parts(&laps);
  std::vector<std::vector<double>> of_part(kStepParts + 2);
  for (int k = 0; k < kFirst + steps; ++k) {
    timed.spent = 0;
    const Clock::time_point begun = Clock::now();
    stepper.step();
    if (k < kFirst) continue;
    of_part[0].push_back(std::chrono::duration<double>(Clock::now() - begun).count());
    of_part[1].push_back(timed.spent);
    for (std::size_t p = 0; p < kStepParts; ++p) of_part[p + 2].push_back(laps.seconds()[p]);
  }
  const std::vector<std::ptrdiff_t> one(static_cast<std::size_t>(ranks.count), 1);
  for (std::size_t p = 0; p < of_part.size(); ++p) {
    std::vector<double> of_each(one.size());
    of_each[static_cast<std::size_t>(ranks.rank)] = median(of_part[p]);
    if (!ranks.alone()) ranks.gather(of_each.data(), one.data());
    if (!ranks.is_root()) continue;
    fmt::print("{:<36}", p == 0 ? "whole step" : p == 1 ? "of the exchange: waits and copies" : kStepPartNames[p - 2]);
    for (double t : of_each) fmt::print(" {:8.1f}", 1e6 * t);
    fmt::print("\n");
  }
  return timed.joined.leave != nullptr && timed.joined.leave() != nullptr ? 1 : 0;
}
