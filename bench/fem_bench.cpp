// Explicit steps against what the machine can do: fused multiply-adds and memory traffic are measured in the same run,
// and every rate is given with its share of both.
//
// Arithmetic and traffic of one element-step, counted from the law (src/engines/element/swept_hex.hpp) and the update:
// see kFlops and kBytes. The traffic is the least possible, with every nodal value moved once; what a run really moves
// is more where tiles do not stay in cache.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <memory>
#include <numeric>
#include <random>
#include <string>

#include "base_case.hpp"
#include "body/plastic_field.hpp"
#include "core/parallel.hpp"
#include "core/vectorize.hpp"
#include "fem/plastic_zone.hpp"
#include "fem/stepper.hpp"
#include "machine_peaks.hpp"
#include "tests/body/plastic_state.hpp"
#include "tests/mesh/brick_mesh.hpp"

namespace railstrata {
namespace {

constexpr double kFlops[2] = {534, 568};  // extruded, revolved: kinematics 129, stress 98, hourglass 136, forces 156,
                                          // per node sums and differences 15; frames 34
constexpr double kBytes = NodalStreams::kBytes;

// -- the machine ----------------------------------------------------------------------------------

template <class Real>
void peak_arithmetic(benchmark::State& state) {
  const int threads = static_cast<int>(state.range(0));
  set_threads(threads);
  double flops = 0;
  for (auto _ : state) for_each(threads, [](std::ptrdiff_t) { multiply_adds<Real>(200000); });
  flops = static_cast<double>(state.iterations()) * threads * 200000.0 * kOperationsOfARound<Real>;
  state.counters["GF/s"] = benchmark::Counter(1e-9 * flops, benchmark::Counter::kIsRate);
}
BENCHMARK(peak_arithmetic<double>)->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK(peak_arithmetic<float>)->Arg(1)->Arg(2)->UseRealTime();

void memory_traffic(benchmark::State& state) {
  const int threads = static_cast<int>(state.range(0));
  set_threads(threads);
  const std::ptrdiff_t nodes = 1 << 20;
  NodalStreams streams(nodes);
  for (auto _ : state) for_each(streams.pieces(), [&](std::ptrdiff_t piece) { streams.move(piece); });
  state.counters["GB/s"] =
      benchmark::Counter(static_cast<double>(state.iterations() * nodes) * kBytes * 1e-9, benchmark::Counter::kIsRate);
}
BENCHMARK(memory_traffic)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

// -- swept lines without contact ------------------------------------------------------------------

struct Lines {
  Body solid;
  Traversal elements;
  Field u, v, f, inverse_mass;
  PlasticHistory history;
  Lines(SweepKind kind, Precision precision, int columns, int rows, int stations, bool random = false)
      : solid(body(kind, columns, rows, stations, random), {elastic(210e9, 0.3, 7800)}, {ElementKind::full, precision}),
        elements(solid) {
    u = v = f = inverse_mass = solid.layout.field();
    for (std::size_t i = 0; i < u.size(); ++i) {
      inverse_mass[i] = solid.element_mass[i] > 0 ? 1 / solid.element_mass[i] : 0;
      v[i] = 1e-3 * std::sin(static_cast<double>(i));
    }
  }
  /// random: nodes and quadrilaterals of the section numbered by chance.
  static SweptBody body(SweepKind kind, int columns, int rows, int stations, bool random) {
    SweptBody b = mesh_brick(columns, rows, stations, 1e-3, 1e-3, 1e-3);
    b.kind = kind;
    if (random) {
      Section& s = b.blocks[0].section;
      std::mt19937 chance(1);
      std::vector<int> number(s.nodes.size());
      std::iota(number.begin(), number.end(), 0);
      std::shuffle(number.begin(), number.end(), chance);
      const std::vector<Vec2> at = s.nodes;
      for (std::size_t n = 0; n < at.size(); ++n) s.nodes[number[n]] = at[n];
      for (auto& q : s.quads)
        for (int& n : q) n = number[n];
      std::shuffle(s.quads.begin(), s.quads.end(), chance);
    }
    if (kind == SweepKind::revolve) {
      for (Vec2& n : b.blocks[0].section.nodes) n.z -= 0.43;
      for (double& t : b.blocks[0].stations.at) t /= 0.43;
    }
    return b;
  }
  void advance(int node, int begin, int end, const double* const (&row)[3]) {
    const BlockLayout& l = solid.layout.blocks[0];
    const double dt = 1e-7;
    for (int i = 0; i < 3; ++i) {
      double *pu = u.data() + l.line(node, i), *pv = v.data() + l.line(node, i);
      const double* m = inverse_mass.data() + l.line(node, 0);
      RAILSTRATA_INDEPENDENT
      for (int j = begin; j < end; ++j) {
        pv[j] -= dt * m[j] * row[i][j];
        pu[j] += dt * pv[j];
      }
    }
  }
  void step() {
    const BlockLayout& l = solid.layout.blocks[0];
    elements.begin(u, 0);
    const std::vector<Chain> chained = chains(solid.tiling, 6 * max_threads());
    const auto take = [&](const Tile& t, int begin, int node, const double* rows) {
      if (begin == t.first)
        advance(node, begin, begin + 1, {rows - t.first, rows + kTile - t.first, rows + 2 * kTile - t.first});
      advance(node, t.first + 1, t.end, {rows - t.first, rows + kTile - t.first, rows + 2 * kTile - t.first});
      return true;
    };
    const auto expect = [&](const Tile& t, int node, Prefetch& lines) {
      for (int i = 0; i < 3; ++i) lines.add(&v[l.line(node, i) + t.first]);
      lines.add(&inverse_mass[l.line(node, 0) + t.first]);
    };
    for_each_apart(static_cast<std::ptrdiff_t>(chained.size()), [&](std::ptrdiff_t k) {
      elements.chain_forces(chained[k], u, f, history, FuseUpdate{take, expect});
    });
    elements.end(chained, f);
    for_each(l.nodes, [&](std::ptrdiff_t n) {
      const double* row[3] = {f.data() + l.line(static_cast<int>(n), 0), f.data() + l.line(static_cast<int>(n), 1),
                              f.data() + l.line(static_cast<int>(n), 2)};
      for (const Chain& c : chained)
        advance(static_cast<int>(n), solid.tiling.border_plane(c), solid.tiling.border_plane(c) + 1,
                {row[0], row[1], row[2]});
      advance(static_cast<int>(n), l.stations - 1, l.stations, {row[0], row[1], row[2]});
    });
  }
};

void set_rates(benchmark::State& state, double element_steps, double flops) {
  state.counters["Mel-steps/s"] = benchmark::Counter(1e-6 * element_steps, benchmark::Counter::kIsRate);
  state.counters["GF/s"] = benchmark::Counter(1e-9 * element_steps * flops, benchmark::Counter::kIsRate);
  state.counters["GB/s"] = benchmark::Counter(1e-9 * element_steps * kBytes, benchmark::Counter::kIsRate);
}

/// Arguments: threads, stations.
template <SweepKind kind, Precision precision, bool random = false>
void swept_lines(benchmark::State& state) {
  set_threads(static_cast<int>(state.range(0)));
  const int stations = static_cast<int>(state.range(1));
  Lines lines(kind, precision, 32, 32, stations, random);
  lines.step();
  for (auto _ : state) lines.step();
  set_rates(state, static_cast<double>(state.iterations()) * 1024.0 * stations, kFlops[kind == SweepKind::revolve]);
}
void sizes(benchmark::internal::Benchmark* b) {
  b->ArgNames({"threads", "stations"})->UseRealTime()->Unit(benchmark::kMillisecond);
  for (int threads : {1, 2})
    for (int stations : {125, 250, 1000}) b->Args({threads, stations});
}
BENCHMARK(swept_lines<SweepKind::extrude, Precision::double_precision>)->Apply(sizes);
BENCHMARK(swept_lines<SweepKind::extrude, Precision::double_precision, true>)->Apply(sizes);
BENCHMARK(swept_lines<SweepKind::extrude, Precision::single_precision>)->Apply(sizes);
BENCHMARK(swept_lines<SweepKind::revolve, Precision::double_precision>)->Apply(sizes);
BENCHMARK(swept_lines<SweepKind::revolve, Precision::single_precision>)->Apply(sizes);

// -- whole steps of a case ------------------------------------------------------------------------

/// Most memory the process has had since reset_peak(): VmHWM of /proc/self/status.
double peak_bytes() {
  std::ifstream file("/proc/self/status");
  std::string word;
  double kilobytes = 0;
  while (file >> word)
    if (word == "VmHWM:" && file >> kilobytes) break;
  return 1024 * kilobytes;
}
void reset_peak() { std::ofstream("/proc/self/clear_refs") << 5; }

/// The paper's base case, elements of `millimetres`, after the run-up damping has gone: contact, suspension, ties,
/// absorbers.
struct Rolling {
  RollingSystem system;
  std::unique_ptr<Stepper> stepper;
  double preload_seconds = 0, peak = 0;
  Rolling(double millimetres, ArithmeticPrecision precision, double layer = 0)
      : Rolling(spec(millimetres, precision, layer)) {}
  explicit Rolling(const CaseSpec& spec, const HotBox& hot = {}) : system(build_model(spec, ".")) {
    for (const BodyId id : kBodies)
      system.bodies[index_of(id)].plastic = plastic_zone(system.model, id, system.body(id), hot);
    const PreloadResult preload = solve_preload(system, 1e-2);
    preload_seconds = preload.wall_seconds;
    stepper = std::make_unique<Stepper>(system, preload);
    peak = peak_bytes();
  }
  /// layer: thickness [m] of one of four times the modulus, 0: none.
  static CaseSpec spec(double millimetres, ArithmeticPrecision precision, double layer) {
    CaseSpec s = base_case(millimetres, precision);
    if (layer > 0) {
      LayerSpec l;
      l.thickness = layer;
      l.material.young = 4 * s.rail_material.young;
      s.layers = {l};
    }
    return s;
  }
};

Rolling& rolling(double millimetres, bool single) {
  static std::unique_ptr<Rolling> latest;
  static std::pair<double, bool> which;
  if (!latest || which != std::pair{millimetres, single}) {
    latest.reset();
    reset_peak();
    latest = std::make_unique<Rolling>(
        millimetres, single ? ArithmeticPrecision::single_precision : ArithmeticPrecision::double_precision);
    which = {millimetres, single};
  }
  return *latest;
}

/// Arguments: threads, element size in hundredths of a millimetre, single precision. One history row in 50 steps, as a
/// run at 100 km/h has with 0.2 mm between rows.
void whole_steps(benchmark::State& state) {
  set_threads(2);
  Rolling& r = rolling(0.01 * static_cast<double>(state.range(1)), state.range(2) != 0);
  set_threads(static_cast<int>(state.range(0)));
  long k = 0;
  for (auto _ : state) {
    if (k++ % 50 == 0) r.stepper->want_energy();
    r.stepper->step();
  }
  const double elements = static_cast<double>(r.system.model.rail.elements() + r.system.model.wheel.elements());
  set_rates(state, static_cast<double>(state.iterations()) * elements, 0.5 * (kFlops[0] + kFlops[1]));
  state.counters["elements"] = elements;
  state.counters["dt_ns"] = 1e9 * r.stepper->dt();
  state.counters["peak bytes/element"] = r.peak / elements;
  state.counters["preload_s(1e-2)"] = r.preload_seconds;
}
BENCHMARK(whole_steps)
    ->ArgNames({"threads", "h/0.01mm", "single"})
    ->ArgsProduct({{1, 2}, {200, 100, 67, 50}, {0, 1}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

/// Wall time to roll a millimetre with a layer of 4 E0 over that without one: two threads, 1 mm elements, steps taken
/// in turn, best of each. Argument: thickness in micrometres.
void layer_over_base(benchmark::State& state) {
  set_threads(2);
  Rolling& base = rolling(1, false);
  Rolling layered(1, ArithmeticPrecision::double_precision, 1e-6 * static_cast<double>(state.range(0)));
  Rolling* const both[2] = {&base, &layered};
  double best[2] = {1e99, 1e99};
  for (auto _ : state) {
    for (int round = 0; round < 20; ++round)
      for (int k = 0; k < 2; ++k) {
        const auto begin = std::chrono::steady_clock::now();
        for (int i = 0; i < 20; ++i) both[k]->stepper->step();
        best[k] =
            std::min(best[k], std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / 20);
      }
    state.SetIterationTime(best[1]);
  }
  const double ratio = best[1] / layered.stepper->dt() / (best[0] / base.stepper->dt()),
               bound = state.range(0) < 1000 ? 3 : 2;
  state.counters["ms"] = 1e3 * best[1];
  state.counters["ratio"] = ratio;
  state.counters["bound"] = bound;
  state.counters["limit/this"] = bound / ratio;
  state.counters["dt_ns"] = 1e9 * layered.stepper->dt();
}
BENCHMARK(layer_over_base)->Arg(200)->Arg(6000)->Iterations(1)->UseManualTime()->Unit(benchmark::kMillisecond);

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// 32 steps hold each kind of look at elements that sleep or are cold. Returns processor seconds a step.
double seconds_per_step(Stepper& stepper) {
  constexpr int kSteps = 32;
  const double begin = processor_seconds();
  for (int i = 0; i < kSteps; ++i) stepper.step();
  return (processor_seconds() - begin) / kSteps;
}

double median(std::vector<double> of) {
  const auto middle = of.begin() + static_cast<std::ptrdiff_t>(of.size() / 2);
  std::nth_element(of.begin(), middle, of.end());
  return *middle;
}

struct HotShare {
  double hot = 0;      ///< of all elements
  double yielded = 0;  ///< number
};
HotShare hot_share(const Rolling& r) {
  HotShare out;
  double elements = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    const Body& body = r.system.bodies[k];
    const PlasticHistory& history = r.stepper->state().bodies[k].history;
    out.hot += static_cast<double>(fem_checks::hot_elements(body, history));
    out.yielded += static_cast<double>(plastic_extent(body, history).yielded);
    elements += static_cast<double>(body.mesh.elements());
  }
  out.hot /= elements;
  return out;
}

/// Processor time of a step of a rail that yields over that of an elastic one: one thread, 2 mm elements, 32 steps of
/// each in turn, median of the ratios of 21 rounds. Arguments: yield strength [MPa]; whether the wheel yields too;
/// whether a box all along is hot from the start, a fifth of all elements, besides what comes near yield. Of the box
/// all sleep at 10000 MPa; at 900 those under the wheel are looked at in every step and none yields.
void hot_over_elastic(benchmark::State& state) {
  set_threads(1);
  Rolling& base = rolling(2, false);
  CaseSpec spec = Rolling::spec(2, ArithmeticPrecision::double_precision, 0);
  spec.run.plasticity = true;
  const auto give = [&](MaterialSpec& m) {
    m.strength.yield_strength = 1e6 * static_cast<double>(state.range(0));
    m.strength.kinematic_hardening = {{20e9, 50}};
  };
  give(spec.rail_material);
  if (state.range(1) != 0) give(spec.wheel_material);
  Rolling yields(spec, state.range(2) != 0 ? HotBox{10e-3, 9e-3} : HotBox{});
  std::vector<double> step, ratio;
  for (auto _ : state) {
    for (int round = 0; round < 21; ++round) {
      const double elastic = seconds_per_step(*base.stepper);
      step.push_back(seconds_per_step(*yields.stepper));
      ratio.push_back(step.back() / elastic);
    }
    state.SetIterationTime(median(step));
  }
  const HotShare share = hot_share(yields);
  const double bound = share.yielded > 0 ? 2.5 : 1.5;
  state.counters["ms"] = 1e3 * median(step);
  state.counters["ratio"] = median(ratio);
  state.counters["bound"] = bound;
  state.counters["limit/this"] = bound / median(ratio);
  state.counters["hot share"] = share.hot;
  state.counters["yielded"] = share.yielded;
}
BENCHMARK(hot_over_elastic)
    ->ArgNames({"MPa", "wheel", "box"})
    ->Args({10000, 1, 0})
    ->Args({480, 0, 0})
    ->Args({300, 1, 0})
    ->Args({10000, 1, 1})
    ->Args({900, 1, 1})
    ->Args({300, 1, 1})
    ->Iterations(1)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace railstrata

BENCHMARK_MAIN();
