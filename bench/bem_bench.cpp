// Times of the half-space engine on the reference ellipse (tests/data/reference): 84954.6 N, E 210 GPa, circle of
// radius 6.144 mm, f 0.5.
//
// Every line gives the best time of its repetitions (CPU time of one thread, wall time where there are two: the machine
// may be shared) and where they exist the time it must not exceed, and CONTACT's own CPU time on the same problem and
// cells; ratios above 1 are in this program's favour.
#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "bem/rolling_contact.hpp"
#include "bem/solve_bem.hpp"
#include "core/parallel.hpp"
#include "halfspace/layered.hpp"

namespace railstrata {
namespace {

constexpr double kLoad = 84954.6, kFriction = 0.5, kCurvature = 1000.0 / 840, kRadius = 6.144e-3;
const HalfSpaceMaterial kSteel{210e9, 0.3};

/// Size of the cells [m] that puts so many of them into the contact; the first four are CONTACT's.
double cell_of(long cells) {
  static const std::map<long, double> known{
      {489, 0.5e-3}, {1901, 0.25e-3}, {7645, 0.125e-3}, {30429, 0.0625e-3}, {121581, 0.03125e-3}};
  const auto it = known.find(cells);
  return it != known.end() ? it->second : kRadius * std::sqrt(3.141592653589793 / static_cast<double>(cells));
}

struct Problem {
  PatchGrid grid;
  InfluenceOperator influence;
  RollingContact contact;  // steady rolling with F_x = 0.4 of friction
  explicit Problem(double cell, const LayeredHalfSpace& rail = {{}, kSteel}, double half = kRadius)
      : grid(centred_grid(static_cast<int>(half / cell) + 1, static_cast<int>(half / cell) + 1, cell, cell)),
        influence(combined_compliance(homogeneous_compliance(kSteel), layered_compliance(rail)), grid.nx, grid.ny, cell,
                  cell) {
    contact.gap.resize(grid.size());
    for (int i = 0; i < grid.nx; ++i)
      for (int j = 0; j < grid.ny; ++j)
        contact.gap[grid.index(i, j)] = kCurvature * (grid.x(i) * grid.x(i) + grid.y(j) * grid.y(j));
    contact.target.load = kLoad;
    contact.friction = kFriction;
    contact.x.force = -0.4 * kFriction * kLoad;
  }
  NormalSolution normal() const { return solve_normal(influence, grid, contact.gap, contact.target); }
  TangentialProblem tangential(const NormalSolution& s) const {
    TangentialProblem p;
    p.traction_bound = s.pressure;
    for (double& g : p.traction_bound) g *= kFriction;
    p.x = contact.x;
    return p;
  }
};

double cells_in_contact(const Plane& p) {
  return static_cast<double>(std::count_if(p.begin(), p.end(), [](double v) { return v > 0; }));
}

double cpu_seconds() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}
double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

template <class Clock, class Work>
double seconds_of(Clock&& clock, Work&& work) {
  const double begin = clock();
  work();
  return clock() - begin;
}

struct Scale {
  double limit = 0;    ///< s, 0: none
  double contact = 0;  ///< s, 0: unknown
};

void report(benchmark::State& state, double seconds, double cells, Scale scale) {
  state.counters["ms"] = 1e3 * seconds;
  if (cells > 0) state.counters["cells"] = cells;
  if (scale.limit > 0) {
    state.counters["limit_ms"] = 1e3 * scale.limit;
    state.counters["limit/this"] = scale.limit / seconds;
  }
  if (scale.contact > 0) {
    state.counters["CONTACT_ms"] = 1e3 * scale.contact;
    state.counters["CONTACT/this"] = scale.contact / seconds;
  }
}
/// A ratio that has a bound: `passed` is above 1 when it is kept.
void report_ratio(benchmark::State& state, double value, double bound, bool at_most) {
  state.counters["ratio"] = value;
  state.counters["bound"] = bound;
  state.counters["limit/this"] = at_most ? bound / value : value / bound;
}

/// Best time of the repetitions of `work`.
template <class Work>
double best_of(benchmark::State& state, Work&& work) {
  double best = 1e99;
  for (auto _ : state) {
    const double t = seconds_of(cpu_seconds, work);
    state.SetIterationTime(t);
    best = std::min(best, t);
  }
  return best;
}

Scale scale_of(const std::map<long, Scale>& scales, long cells) {
  const auto it = scales.find(cells);
  return it != scales.end() ? it->second : Scale{};
}

void normal(benchmark::State& state) {
  set_threads(1);
  const Problem p(cell_of(state.range(0)));
  NormalSolution s;
  const double t = best_of(state, [&] { s = p.normal(); });
  report(state, t, cells_in_contact(s.pressure),
         scale_of({{489, {0, .006}},
                   {1901, {0, .014}},
                   {7645, {0, .047}},
                   {12900, {.1, 0}},
                   {30429, {0, .24}},
                   {50800, {.6, 0}}},
                  state.range(0)));
}

void steady_force_given(benchmark::State& state) {
  set_threads(1);
  const Problem p(cell_of(state.range(0)));
  const NormalSolution n = p.normal();
  const double t =
      best_of(state, [&] { benchmark::DoNotOptimize(solve_tangential(p.influence, p.grid, p.tangential(n))); });
  report(state, t, cells_in_contact(n.pressure),
         scale_of({{489, {0, .144}}, {1901, {.08, .87}}, {7645, {.4, 5.9}}, {30429, {3, 0}}}, state.range(0)));
}

void steady_creepage_given(benchmark::State& state) {
  set_threads(1);
  const Problem p(cell_of(state.range(0)));
  const NormalSolution n = p.normal();
  TangentialProblem given = p.tangential(n);
  given.x = {-1.48e-3, {}};
  const double t = best_of(state, [&] { benchmark::DoNotOptimize(solve_tangential(p.influence, p.grid, given)); });
  report(state, t, cells_in_contact(n.pressure),
         scale_of({{489, {0, .033}}, {1901, {0, .19}}, {7645, {0, 1.2}}, {30429, {0, 21.9}}}, state.range(0)));
}

void shift_and_ten_steps(benchmark::State& state) {
  set_threads(1);
  const Problem p(cell_of(state.range(0)));
  const NormalSolution n = p.normal();
  const double t = best_of(state, [&] {
    TangentialProblem problem = p.tangential(n);
    problem.kind = RollingKind::shift;
    TangentialSolution s = solve_tangential(p.influence, p.grid, problem);
    for (int step = 0; step < 10; ++step) {
      roll_on_one_cell(p.influence, p.grid, s, problem);
      s = solve_tangential(p.influence, p.grid, problem, {}, &s);
    }
    benchmark::DoNotOptimize(s);
  });
  report(state, t, cells_in_contact(n.pressure),
         scale_of({{489, {0, .23}}, {1901, {0, .62}}, {7645, {0, 4.1}}}, state.range(0)));
}

/// Slope of ln(time) over ln(cells), normal problem and steady rolling, force given, 489 to 121,581 cells: least
/// squares.
void slope_of_cost_over_cells(benchmark::State& state) {
  set_threads(1);
  double slope = 0;
  for (auto _ : state) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (long cells : {489, 1901, 7645, 30429, 121581}) {
      const Problem p(cell_of(cells));
      double best = 1e99;
      for (int i = 0; i < (cells < 10000 ? 20 : 3); ++i)
        best = std::min(best, seconds_of(cpu_seconds, [&] { solve_rolling(p.influence, p.grid, p.contact); }));
      const double u = std::log(static_cast<double>(cells)), v = std::log(best);
      n += 1;
      x += u;
      y += v;
      xx += u * u;
      xy += u * v;
    }
    slope = (n * xy - x * y) / (n * xx - x * x);
    state.SetIterationTime(1);
  }
  report_ratio(state, slope, 1.25, true);
}

/// The paper's sixteen layers on the reference problem over the same problem without a layer, normal and tangential
/// together, equal grids. Soft layers widen the patch, to 1.5 times the twin's cells under 4 mm of a quarter of the
/// modulus.
void layered_over_homogeneous_twin(benchmark::State& state) {
  set_threads(1);
  const double cell = cell_of(7645), half = 7.6e-3;
  const auto time_of = [&](const Problem& p) {
    double best = 1e99;
    for (int i = 0; i < 5; ++i)
      best = std::min(best, seconds_of(cpu_seconds, [&] { solve_rolling(p.influence, p.grid, p.contact); }));
    return best;
  };
  double worst = 0, mean = 0;
  for (auto _ : state) {
    worst = mean = 0;
    const double twin = time_of(Problem(cell, {{}, kSteel}, half));
    for (double ratio : {0.25, 0.5, 2.0, 4.0})
      for (double h : {1e-3, 2e-3, 3e-3, 4e-3}) {
        const double r = time_of(Problem(cell, {{{h, {ratio * kSteel.young, kSteel.poisson}}}, kSteel}, half)) / twin;
        worst = std::max(worst, r);
        mean += r / 16;
      }
    state.SetIterationTime(1);
  }
  report_ratio(state, mean, 1.5, true);
  state.counters["worst"] = worst;
}

void influence_of_a_new_layer_256(benchmark::State& state) {
  set_threads(1);
  const LayeredHalfSpace rail{{{1e-3, {840e9, 0.3}}}, kSteel};
  const double t = best_of(state, [&] {
    benchmark::DoNotOptimize(InfluenceOperator(
        combined_compliance(homogeneous_compliance(kSteel), layered_compliance(rail)), 256, 256, 0.25e-3, 0.25e-3));
  });
  report(state, t, 0, {.3, 0});
}

void influence_from_the_cache_256(benchmark::State& state) {
  set_threads(1);
  const LayeredHalfSpace rail{{{1e-3, {840e9, 0.3}}}, kSteel}, wheel{{}, kSteel};
  const PatchGrid grid = {256, 256, 0.25e-3, 0.25e-3, 0, 0};
  InfluenceCache cache;
  cache.get(wheel, rail, grid);
  const double t = best_of(state, [&] { benchmark::DoNotOptimize(cache.get(wheel, rail, grid)); });
  report(state, t, 0, {});
}

/// Wall time of one thread over that of two, each the best of its repetitions, taken in turn.
void two_threads_over_one(benchmark::State& state) {
  const Problem p(cell_of(30429));
  const TangentialProblem problem = p.tangential(p.normal());
  double best[2] = {1e99, 1e99};
  for (auto _ : state) {
    for (int i = 0; i < 12; ++i)
      for (int threads : {1, 2}) {
        set_threads(threads);
        double& b = best[threads - 1];
        b = std::min(b, seconds_of(wall_seconds, [&] { solve_tangential(p.influence, p.grid, problem); }));
      }
    state.SetIterationTime(best[1]);
  }
  set_threads(1);
  report_ratio(state, best[0] / best[1], 1.7, false);
  state.counters["ms"] = 1e3 * best[1];
}

/// The sixteen cases of the paper with the maxima under the surface, 0.25 mm cells, side by side on two threads: wall
/// time.
void sixteen_layered_cases(benchmark::State& state) {
  set_threads(2);
  double best = 1e99;
  for (auto _ : state) {
    const double t = seconds_of(wall_seconds, [] {
      InfluenceCache cache;
      for_each(
          16,
          [&](std::ptrdiff_t i) {
            CaseSpec spec;
            spec.geometry.lateral_shift = 1.5e-3;
            LayerSpec layer;
            layer.thickness = 1e-3 * static_cast<double>(1 + i % 4);
            layer.material.young =
                spec.rail_material.young *
                std::pow(2.0, i / 8 ? i / 4 - 1 : i / 4 - 2);  // a quarter, a half, twice, four times
            spec.layers = {layer};
            BemOptions options;
            options.cell = 0.25e-3;
            options.cache = &cache;
            const BemResult r = solve_bem(spec, place(spec, {}), options);
            benchmark::DoNotOptimize(rail_interior(r).peaks({0.5 * options.cell, layer.thickness + 12e-3}));
          },
          true);
    });
    state.SetIterationTime(t);
    best = std::min(best, t);
  }
  set_threads(1);
  report(state, best, 0, {60, 0});
}

void line(benchmark::internal::Benchmark* b) { b->UseManualTime()->Unit(benchmark::kMillisecond); }
void once(benchmark::internal::Benchmark* b) { b->UseManualTime()->Iterations(1)->Unit(benchmark::kMillisecond); }

BENCHMARK(normal)->Apply(line)->Arg(489)->Arg(1901)->Arg(7645)->Arg(12900)->Arg(30429)->Arg(50800);
BENCHMARK(steady_force_given)->Apply(line)->Arg(489)->Arg(1901)->Arg(7645)->Arg(30429)->Arg(121581);
BENCHMARK(steady_creepage_given)->Apply(line)->Arg(489)->Arg(1901)->Arg(7645)->Arg(30429);
BENCHMARK(shift_and_ten_steps)->Apply(line)->Arg(489)->Arg(1901)->Arg(7645)->Arg(30429);
BENCHMARK(slope_of_cost_over_cells)->Apply(once);
BENCHMARK(layered_over_homogeneous_twin)->Apply(once);
BENCHMARK(influence_of_a_new_layer_256)->Apply(line);
BENCHMARK(influence_from_the_cache_256)->Apply(line);
BENCHMARK(two_threads_over_one)->Apply(once);
BENCHMARK(sixteen_layered_cases)->Apply(once);

}  // namespace
}  // namespace railstrata

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  benchmark::AddCustomContext("compiler", __VERSION__);
  benchmark::RunSpecifiedBenchmarks();
}
