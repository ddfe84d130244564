// Times of "does it last?" on the half-space case of the paper (LMA on CN60, F_T/G 0.2, R260 with 480 MPa), without a
// layer and with 1 mm at 2 E0. CPU time of one thread, the best of the repetitions.
//
// Lines: the stress cycles of the rail's section; the factors of it; the limit of one track; the sliding map; a whole
// case without strengths, with them as a study computes them, and with one track; 200 passes by the stationary method.
#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>

#include "ask/answer.hpp"
#include "core/parallel.hpp"
#include "fatigue/shakedown_summary.hpp"
#include "passes/rail_passes.hpp"
#include "result/stress_cycles.hpp"

namespace railstrata {
namespace {

double cpu_seconds() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

CaseSpec rail_case(bool layered, bool strong) {
  CaseSpec spec;
  spec.geometry.lateral_shift = 1.5e-3;
  if (layered) {
    spec.layers.resize(1);
    spec.layers[0].thickness = 1e-3;
    spec.layers[0].material.young = 2 * spec.rail_material.young;
  }
  if (!strong) return spec;
  spec.rail_material.strength.yield_strength = 480e6;
  for (LayerSpec& layer : spec.layers) layer.material.strength.yield_strength = 960e6;
  return spec;
}

/// limit: s, 0: none.
template <class Work>
void timed(benchmark::State& state, double limit, Work&& work) {
  set_threads(1);
  double best = 1e99;
  for (auto _ : state) {
    const double begin = cpu_seconds();
    work();
    const double t = cpu_seconds() - begin;
    state.SetIterationTime(t);
    best = std::min(best, t);
  }
  state.counters["ms"] = 1e3 * best;
  if (limit <= 0) return;
  state.counters["limit_ms"] = 1e3 * limit;
  state.counters["limit/this"] = limit / best;
}

struct Solved {
  CaseSpec spec;
  BemResult result;
  explicit Solved(benchmark::State& state)
      : spec(rail_case(state.range(0) != 0, true)), result(solve_bem(spec, place(spec, {}), {})) {}
};

void stress_cycles(benchmark::State& state) {
  const Solved s(state);
  const std::vector<CycleRow> rows = cycle_rows(s.result.rail, 0.5 * shorter_axis(measure_patch(s.result.field)));
  timed(state, 0, [&] { benchmark::DoNotOptimize(half_space_cycles(s.result, BodyId::rail, s.result, rows)); });
  state.counters["rows"] = static_cast<double>(rows.size());
}

void factors(benchmark::State& state) {
  const Solved s(state);
  const std::vector<CycleRow> rows = cycle_rows(s.result.rail, 0.5 * shorter_axis(measure_patch(s.result.field)));
  const StressHistory history = half_space_cycles(s.result, BodyId::rail, s.result, rows);
  const RowStrength strength = row_strength(s.spec, BodyId::rail, history);
  timed(state, 0, [&] { benchmark::DoNotOptimize(shakedown({history, strength.shear, {}, {}})); });
}

void fatigue(benchmark::State& state) {
  const Solved s(state);
  const std::vector<CycleRow> rows = cycle_rows(s.result.rail, 0.5 * shorter_axis(measure_patch(s.result.field)));
  const StressHistory history = half_space_cycles(s.result, BodyId::rail, s.result, rows);
  const RowStrength strength = row_strength(s.spec, BodyId::rail, history);
  timed(state, 0, [&] { benchmark::DoNotOptimize(section_fatigue(s.spec, BodyId::rail, history, strength)); });
}

void largest_stresses(benchmark::State& state) {
  const Solved s(state);
  timed(state, 0, [&] { benchmark::DoNotOptimize(rail_interior(s.result).peaks({0.1e-3, 12e-3})); });
}

void one_track(benchmark::State& state) {
  const Solved s(state);
  const std::vector<SectionShakedown> sections = half_space_shakedown(s.spec, s.result);
  timed(state, 30, [&] {
    std::vector<SectionShakedown> mine = sections;
    add_single_track(s.spec, s.result, mine);
    benchmark::DoNotOptimize(mine);
  });
}

/// Of a case without a layer (0) or with one (1); without strengths (0), with them (1), with one track too (2).
void whole_case(benchmark::State& state) {
  const CaseSpec spec = rail_case(state.range(0) != 0, state.range(1) > 0);
  const Placement placement = place(spec, {});
  timed(state, state.range(1) == 1 ? 10 : 0,
        [&] { benchmark::DoNotOptimize(ask(spec, placement, {.single_track = state.range(1) == 2})); });
}

/// 200 passes over R260 as it hardens, contact and stresses included.
void passes(benchmark::State& state) {
  CaseSpec spec = rail_case(false, false);
  spec.rail_material.strength.hardening = "R260";
  const Placement placement = place(spec, {});
  timed(state, 300, [&] {
    const RailPasses rail = rail_passes(spec, {solve_bem(spec, placement, {})});
    const SteadyBody body(rail.grid, rail.rows, rail.below, rail.initial_stress);
    const Field contact = contact_strain(rail, body, rail.contact_stress.front());
    PassState rolled = body.virgin();
    for (int n = 0; n < 200; ++n) benchmark::DoNotOptimize(body.run_pass(contact, rolled));
  });
}

void line(benchmark::internal::Benchmark* b) { b->UseManualTime()->Unit(benchmark::kMillisecond); }

BENCHMARK(stress_cycles)->Apply(line)->Arg(0)->Arg(1);
BENCHMARK(factors)->Apply(line)->Arg(0)->Arg(1);
BENCHMARK(fatigue)->Apply(line)->Arg(0)->Arg(1);
BENCHMARK(largest_stresses)->Apply(line)->Arg(0)->Arg(1);
BENCHMARK(one_track)->Apply(line)->Iterations(1)->Arg(0)->Arg(1);
BENCHMARK(whole_case)->Apply(line)->Iterations(2)->ArgsProduct({{0, 1}, {0, 1, 2}});
BENCHMARK(passes)->Apply(line)->Iterations(1);

}  // namespace
}  // namespace railstrata

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  benchmark::AddCustomContext("compiler", __VERSION__);
  benchmark::RunSpecifiedBenchmarks();
}
