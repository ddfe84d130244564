// Times of the half-space engine on the reference ellipse (tests/data/reference): 84954.6 N, E 210 GPa, circle of radius 6.144 mm. The scale is CONTACT's own time on the
// same problem (one thread, a loaded two-core machine), given as a ratio: larger is faster than CONTACT.
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>

#include "bem/normal_problem.hpp"
#include "bem/tangential_problem.hpp"
#include "core/parallel.hpp"
#include "halfspace/layered.hpp"

namespace railstrata {
namespace {

constexpr double kLoad = 84954.6, kFriction = 0.5, kCurvature = 1000.0 / 840, kRadius = 6.144e-3;
const HalfSpaceMaterial kSteel{210e9, 0.3};

struct Problem {
  PatchGrid grid;
  InfluenceOperator influence;
  Plane gap;
  explicit Problem(double cell, const LayeredHalfSpace& rail = {{}, kSteel})
      : grid(centred_grid(static_cast<int>(kRadius / cell) + 1, static_cast<int>(kRadius / cell) + 1, cell, cell)),
        influence(combined_compliance(homogeneous_compliance(kSteel), layered_compliance(rail)), grid.nx, grid.ny, cell, cell), gap(grid.size()) {
    for (int i = 0; i < grid.nx; ++i)
      for (int j = 0; j < grid.ny; ++j) gap[grid.index(i, j)] = kCurvature * (grid.x(i) * grid.x(i) + grid.y(j) * grid.y(j));
  }
  NormalSolution normal() const { return solve_normal(influence, grid, gap, {.load = kLoad, .approach = {}}); }
  TangentialProblem rolling(const NormalSolution& s) const {
    TangentialProblem p;
    p.bound = s.pressure;
    for (double& g : p.bound) g *= kFriction;
    return p;
  }
};

/// Cell sizes in units of 1/16 mm, and the cells in contact.
void sizes(benchmark::internal::Benchmark* b) {
  for (int sixteenths : {8, 4, 2, 1}) b->Arg(sixteenths);
  b->Unit(benchmark::kMillisecond);
}
double cell_of(const benchmark::State& state) { return 1e-3 * static_cast<double>(state.range(0)) / 16; }

void report(benchmark::State& state, const NormalSolution& s, const std::map<long, double>& contact_seconds) {
  long cells = 0;
  for (double p : s.pressure) cells += p > 0;
  state.counters["cells"] = static_cast<double>(cells);
  const auto known = contact_seconds.find(state.range(0));
  if (known != contact_seconds.end()) state.counters["CONTACT_over_this"] = benchmark::Counter(known->second, benchmark::Counter::kIsIterationInvariantRate);
}

void normal(benchmark::State& state) {
  set_threads(1);
  const Problem p(cell_of(state));
  NormalSolution s;
  for (auto _ : state) benchmark::DoNotOptimize(s = p.normal());
  report(state, s, {{8, .006}, {4, .014}, {2, .047}, {1, .24}});
}
BENCHMARK(normal)->Apply(sizes);

void steady_force_given(benchmark::State& state) {
  set_threads(1);
  const Problem p(cell_of(state));
  const NormalSolution s = p.normal();
  TangentialProblem t = p.rolling(s);
  t.x.force = -0.4 * kFriction * kLoad;
  for (auto _ : state) benchmark::DoNotOptimize(solve_tangential(p.influence, p.grid, t));
  report(state, s, {{8, .144}, {4, .87}, {2, 5.9}});
}
BENCHMARK(steady_force_given)->Apply(sizes);

void steady_creepage_given(benchmark::State& state) {
  set_threads(1);
  const Problem p(cell_of(state));
  const NormalSolution s = p.normal();
  TangentialProblem t = p.rolling(s);
  t.x.creepage = -1.48e-3;
  for (auto _ : state) benchmark::DoNotOptimize(solve_tangential(p.influence, p.grid, t));
  report(state, s, {{8, .033}, {4, .19}, {2, 1.2}, {1, 21.9}});
}
BENCHMARK(steady_creepage_given)->Apply(sizes);

void steady_two_threads(benchmark::State& state) {
  set_threads(2);
  const Problem p(1e-3 / 16);
  TangentialProblem t = p.rolling(p.normal());
  t.x.force = -0.4 * kFriction * kLoad;
  for (auto _ : state) benchmark::DoNotOptimize(solve_tangential(p.influence, p.grid, t));
  set_threads(1);
}
BENCHMARK(steady_two_threads)->Unit(benchmark::kMillisecond)->UseRealTime();

void shift_and_ten_steps(benchmark::State& state) {
  set_threads(1);
  const Problem p(cell_of(state));
  const NormalSolution n = p.normal();
  for (auto _ : state) {
    TangentialProblem t = p.rolling(n);
    t.kind = RollingKind::shift;
    t.x.force = -0.4 * kFriction * kLoad;
    TangentialSolution s = solve_tangential(p.influence, p.grid, t);
    for (int step = 0; step < 10; ++step) {
      roll_on_one_cell(p.influence, p.grid, s, t);
      s = solve_tangential(p.influence, p.grid, t, {}, &s);
    }
    benchmark::DoNotOptimize(s);
  }
  report(state, n, {{8, .23}, {4, .62}, {2, 4.1}});
}
BENCHMARK(shift_and_ten_steps)->Arg(8)->Arg(4)->Arg(2)->Unit(benchmark::kMillisecond);

void influence_of_a_new_layer_256(benchmark::State& state) {
  set_threads(1);
  const LayeredHalfSpace rail{{{1e-3, {840e9, 0.3}}}, kSteel};
  for (auto _ : state)
    benchmark::DoNotOptimize(InfluenceOperator(combined_compliance(homogeneous_compliance(kSteel), layered_compliance(rail)), 256, 256, 0.25e-3, 0.25e-3));
}
BENCHMARK(influence_of_a_new_layer_256)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace railstrata

BENCHMARK_MAIN();
