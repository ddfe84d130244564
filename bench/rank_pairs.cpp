// Ranks against threads in one run, in alternating pairs, so that what else the machine does meets both: whole steps of
// a case by one rank with N threads, and by N ranks with one thread each. Ranks are threads of this process here
// (tests/fem/thread_ranks.hpp); what MPI adds is seen between `mpirun -n N railstrata run` and `run -j N`.
//
// usage: rank_pairs CASE ELEMENT_SIZE N STEPS PAIRS
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>

#include "fem/stepper.hpp"
#include "reader/case_file.hpp"
#include "tests/fem/thread_ranks.hpp"

using namespace railstrata;

namespace {

// CPU time without what the exchanges of the ranks take, which is waiting, and copies of their own.
struct Cost {
  double wall = 0, cpu = 0, exchange = 0;  // s
};
double seconds(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// An exchange that counts its CPU time.
struct Timed {
  Ranks inner;
  double spent = 0;
  static void gather(void* context, double* all, const std::ptrdiff_t* sizes) {
    Timed& timed = *static_cast<Timed*>(context);
    const double begun = seconds(CLOCK_THREAD_CPUTIME_ID);
    timed.inner.gather(all, sizes);
    timed.spent += seconds(CLOCK_THREAD_CPUTIME_ID) - begun;
  }
};

// The first steps are for caches and memory.
Cost cost_of(const RollingSystem& system, const PreloadResult& preload, int ranks, int threads, int steps) {
  constexpr int kFirst = 20;
  Cost cost;
  std::vector<Timed> timed(static_cast<std::size_t>(ranks));
  fem_checks::ThreadRanks(ranks).run(threads, [&](const Ranks& mine) {
    Timed& own = timed[static_cast<std::size_t>(mine.rank)];
    own.inner = mine;
    Stepper stepper(system, preload, {mine.count, mine.rank, &own, Timed::gather});
    for (int k = 0; k < kFirst; ++k) stepper.step();
    own.spent = 0;
    const auto begun = std::chrono::steady_clock::now();
    const double spent = seconds(CLOCK_PROCESS_CPUTIME_ID);
    for (int k = 0; k < steps; ++k) stepper.step();
    if (!mine.is_root()) return;
    cost.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    cost.cpu = seconds(CLOCK_PROCESS_CPUTIME_ID) - spent;
  });
  for (const Timed& t : timed) cost.exchange += t.spent;
  cost.cpu -= cost.exchange;
  return cost;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) {
    fmt::print(stderr, "usage: rank_pairs CASE ELEMENT_SIZE N STEPS PAIRS\n");
    return 2;
  }
  const LoadedCase loaded =
      load_case(argv[1], {fmt::format("mesh.element_size=\"{}\"", argv[2]), "run.run_up=\"0 mm\""});
  const int ranks = std::atoi(argv[3]), steps = std::atoi(argv[4]), pairs = std::atoi(argv[5]);
  const RollingSystem system(build_model(loaded.spec, loaded.folder()));
  const PreloadResult preload = solve_preload(system, 1e-2);
  std::vector<double> wall, cpu;
  for (int p = 0; p < pairs; ++p) {
    const Cost threads = cost_of(system, preload, 1, ranks, steps),
               by_ranks = cost_of(system, preload, ranks, 1, steps);
    wall.push_back(threads.wall / by_ranks.wall);
    cpu.push_back(threads.cpu / by_ranks.cpu);
    fmt::print(
        "pair {}: {} threads {:.3f} s wall, {:.3f} s CPU; {} ranks {:.3f} s, {:.3f} s and {:.3f} s in exchanges\n",
        p + 1, ranks, threads.wall, threads.cpu, ranks, by_ranks.wall, by_ranks.cpu, by_ranks.exchange);
  }
  fmt::print("speed of {0} ranks over {0} threads, medians: {1:.3f} by wall time, {2:.3f} by CPU time\n", ranks,
             median(wall), median(cpu));
  return 0;
}
