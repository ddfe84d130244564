// A roofline of whole steps of the base case: peak arithmetic, memory bandwidth, the kernel alone in cache and the
// parts of a step, measured in one process, beside the operations and bytes of each part, counted from kernel and
// bodies.
//
// usage: roofline [MILLIMETRES] [single]      prints Markdown; a minute for 1 mm
//
// Times are the least of many: others use the machine too. Bytes are the least possible, every value moved once.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string>
#include <vector>

#include "base_case.hpp"
#include "body/traversal_kernel.hpp"
#include "core/parallel.hpp"
#include "counted.hpp"
#include "fem/stepper.hpp"
#include "machine_peaks.hpp"
#include "tests/mesh/brick_mesh.hpp"

namespace railstrata {
namespace {

template <class Work>
double least_seconds(int rounds, Work&& work) {
  double least = 1e99;
  for (int k = 0; k < rounds; ++k) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  return least;
}

// -- the machine ----------------------------------------------------------------------------------

struct Machine {
  int threads = 1;
  double flops = 0;  // 1/s, of fused multiply-adds in packs of the case's precision
  double triad = 0;  // byte/s, a = b + s c on arrays beyond every cache
  double nodal = 0;  // byte/s, nodal values of the case's size, 13 streams as in a step
  double instructions() const { return 0.5 * flops; }  // 1/s, operations on packs, lanes counted
  double bandwidth() const { return std::max(triad, nodal); }
};

template <class Real>
double peak_flops(int threads) {
  constexpr long kRounds = 50000;
  const double seconds =
      least_seconds(200, [&] { for_each(threads, [](std::ptrdiff_t) { multiply_adds<Real>(kRounds); }); });
  return threads * kRounds * kOperationsOfARound<Real> / seconds;
}

double triad_bandwidth() {
  constexpr std::ptrdiff_t kNumbers = 1 << 24, kPiece = 1 << 14;
  static Field a(kNumbers), b(kNumbers, 1.0), c(kNumbers, 2.0);
  const auto piece = [&](std::ptrdiff_t k) {
    double* const to = a.data() + k * kPiece;
    const double *const x = b.data() + k * kPiece, *const y = c.data() + k * kPiece;
    RAILSTRATA_INDEPENDENT
    for (std::ptrdiff_t i = 0; i < kPiece; ++i) to[i] = x[i] + 3.0 * y[i];
  };
  return 24.0 * kNumbers / least_seconds(20, [&] { for_each(kNumbers / kPiece, piece); });
}

double nodal_bandwidth(std::ptrdiff_t nodes) {
  NodalStreams streams(nodes);
  const double seconds =
      least_seconds(60, [&] { for_each(streams.pieces(), [&](std::ptrdiff_t k) { streams.move(k); }); });
  return NodalStreams::kBytes * static_cast<double>(streams.pieces() * NodalStreams::kPiece) / seconds;
}

// -- operations and bytes -------------------------------------------------------------------------

struct Need {
  double operations = 0, instructions = 0, bytes = 0;
  Need& operator+=(const Need& o) {
    operations += o.operations;
    instructions += o.instructions;
    bytes += o.bytes;
    return *this;
  }
};
Need operator*(double n, Need a) { return {n * a.operations, n * a.instructions, n * a.bytes}; }
Need operator+(Need a, const Need& b) { return a += b; }

/// Of one element, by the law itself.
template <SweepKind kind>
Need element_need() {
  Counted::count = {};
  const HexReference<double> reference{};
  const auto corner = [](int, int, Counted&, Counted&) {};
  const auto hourglass = [](ElementKinematics<Counted>&) {  // without the energy, which a step does not need
    const Counted a[5], b[7];
    Counted ka[5], kb[7];
    const auto entry = [](int) { return 1.0; };
    detail::symmetric_product<5>(entry, 0, a, ka);
    detail::symmetric_product<7>(entry, 15, b, kb);
  };
  const auto change = [](int, int, auto&& add) {
    Counted s, d;
    add(s, d);
  };
  hex_forces<kind, Evaluation::finite>(reference, StationScale<Counted>{}, Rotation<double>{}, corner, hourglass,
                                       change);
  return {static_cast<double>(Counted::count.operations), static_cast<double>(Counted::count.instructions), 0};
}

// A node at a station: body/scratch_rows.hpp and fem/node_law.hpp, operations, instructions and bytes. Scratch rows
// stay in cache.
constexpr Need kGather[2] = {{6, 6, 24}, {18, 14, 24}}, kScatter[2] = {{9, 9, 0}, {21, 17, 0}};
constexpr Need kUpdate[2] = {{18, 9, 24 + 48 + 8},
                             {34, 19, 24 + 48 + 8}};                      // after a gather: u written, v both, 1/m read
constexpr Need kStore{0, 0, 24};                                          // of forces
constexpr Need kLateUpdate[2] = {{18, 9, 24 + 104}, {34, 19, 24 + 104}};  // of what was stored

struct Counts {
  double elements = 0, nodes = 0, at_once = 0, waiting = 0, border_nodes = 0;
};
Counts counts_of(const RollingBody& b) {
  Counts out;
  for (std::size_t k = 0; k < b.body.layout.blocks.size(); ++k) {
    const BlockLayout& l = b.body.layout.blocks[k];
    out.elements += static_cast<double>(b.body.mesh.blocks[k].section.quads.size()) * l.elements;
    out.nodes += static_cast<double>(l.nodes) * l.stations;
    out.at_once +=
        static_cast<double>(std::count(b.schedule.at_once[k].begin(), b.schedule.at_once[k].end(), 1)) * l.stations;
  }
  for (const SectionNode& n : b.schedule.waiting) out.waiting += b.body.layout.blocks[n.block].stations;
  for (const Chain& c : b.schedule.chains) out.border_nodes += b.body.layout.blocks[b.body.tiling.block(c)].nodes;
  return out;
}

/// What slaves have is gathered at their masters' stations and added to the masters; then they are cleared.
Need collecting(const Body& body) {
  Need out;
  const auto& blocks = body.layout.blocks;
  for (const Ties::Line& line : body.ties.lines()) {
    const double slots = body.ties.interpolations()[line.interpolation].slots;
    out += 3.0 * blocks[line.master_block].stations * Need{2 * slots, slots, 8};
  }
  for (const Ties::Level& level : body.ties.levels())
    for (const Ties::Master& m : level.masters)
      out += 3.0 * blocks[m.block].stations * (m.shares * Need{2, 1, 8} + Need{0, 0, 16});
  const Need moment = body.mesh.kind == SweepKind::revolve ? Need{10, 6, 48 + 16} : Need{0, 0, 48};
  for (const Ties::Line& line : body.ties.lines()) out += blocks[line.slave_block].stations * moment;
  return out;
}

/// Slaves are put where their masters carry them.
Need spreading(const Body& body) {
  Need out;
  const auto& blocks = body.layout.blocks;
  const Need offsets = body.mesh.kind == SweepKind::revolve ? Need{8, 4, 16} : Need{};
  for (const Ties::Line& line : body.ties.lines())
    out += 3.0 * blocks[line.master_block].stations * Need{3, 2, 16} +
           blocks[line.slave_block].stations * (3.0 * Need{3, 2, 8} + offsets);
  return out;
}

using Needs = std::array<Need, kStepParts>;
void add_needs(const RollingBody& b, Needs& parts) {
  const int kind = b.turns() ? 1 : 0;
  const Counts n = counts_of(b);
  const auto part = [&](StepPart p) -> Need& { return parts[static_cast<std::size_t>(p)]; };
  part(StepPart::elements) +=
      n.elements * (kind ? element_need<SweepKind::revolve>() : element_need<SweepKind::extrude>());
  part(StepPart::elements) +=
      n.nodes * (kGather[kind] + kScatter[kind]) + n.at_once * kUpdate[kind] + (n.nodes - n.at_once) * kStore;
  part(StepPart::planes) += n.border_nodes * (Need{3, 3, 48} + kUpdate[kind]);
  part(StepPart::tie_forces) += collecting(b.body);
  if (b.turns())
    part(StepPart::rows) += static_cast<double>(b.surface.columns) * b.surface.stations.nodes() * Need{14, 10, 48};
  part(StepPart::waiting) += n.waiting * kLateUpdate[kind];
  part(StepPart::constraints) += spreading(b.body);
}

// -- pieces of a step in cache --------------------------------------------------------------------

struct CachedTimes {
  double element = 0, node = 0;  // s, of one: the kernel; gather, scatter and update
};

/// The kernel on some quadrilaterals of a tile, over and over on the same rows.
template <class Real, SweepKind kind>
__attribute__((flatten, noinline)) void evaluate_in_cache(const BlockElements& elements, int quads,
                                                          ScratchRows<Real>& s) {
  using Rows = ScratchRows<Real>;
  using P = PackOf<Real>;
  constexpr int packs = kTile / kLanesOf<Real>;
  StationScale<P> scale[packs];
  for (int n = 0; n < packs; ++n)
    scale[n] = elements.of<Real>().template scale<P>(n * kLanesOf<Real>, [](const Real* x) { return load(x); });
  traversal::QuadRows<Real> rows{};
  for (int c = 0; c < 4; ++c) {
    rows.node[c] = &s.rows[static_cast<std::size_t>(c) * Rows::kNode];
    rows.forces[c] = s.zero;
  }
  Prefetch none;
  const Rotation<Real> turn{1, 0};
  for (int q = 0; q < quads; ++q)
    traversal::evaluate_quad<Evaluation::finite, kind, false, false>(elements, q, scale, packs, 0, turn, rows, none);
}

/// Rows of one node at the stations of a tile, in cache.
struct NodeInCache {
  alignas(64) double u[3][kTile + 8] = {}, v[3][kTile + 8] = {}, f[3 * kTile] = {};
  alignas(64) double inverse_mass[kTile] = {}, cosine[kTile], sine[kTile];
  NodeInCache() {
    std::fill_n(cosine, kTile, 1.0);
    std::fill_n(sine, kTile, 0.0);
  }
};

template <class Real, SweepKind kind>
__attribute__((flatten, noinline)) void advance_in_cache(NodeInCache& n, const NodeStep& step, Real* rows) {
  const CarriedRows frame{n.cosine, n.sine};
  double first[3], end[3];
  gather_displacements<kind>({n.u[0], n.u[1], n.u[2]}, frame, kTile, rows);
  scatter_forces<kind>(rows + ScratchRows<Real>::kForces * kTile, frame, kTile, n.f, first, end);
  UpdateSums none;
  const NodeStep s = step;
  RAILSTRATA_INDEPENDENT
  for (int j = 0; j < kTile; ++j)
    advance_node<kind, false>(s, n.inverse_mass[j], 0.43, n.cosine[j], n.sine[j], n.f[j], n.f[kTile + j],
                              n.f[2 * kTile + j], n.u[0][j], n.u[1][j], n.u[2][j], n.v[0][j], n.v[1][j], n.v[2][j],
                              none);
}

template <class Real, SweepKind kind>
CachedTimes cached_times(int threads) {
  constexpr int kSide = 4, kRounds = 20, kTimes = 200;
  SweptBody mesh = mesh_brick(kSide, kSide, kTile, 1e-3, 1e-3, 1e-3);
  mesh.kind = kind;
  if (kind == SweepKind::revolve) {
    for (Vec2& n : mesh.blocks[0].section.nodes) n.z -= 0.43;
    for (double& t : mesh.blocks[0].stations.at) t /= 0.43;
  }
  const Body body(mesh, {elastic(210e9, 0.3, 7800)}, {ElementKind::full, Precision::single_precision});
  const NodeStep step = node_step({}, {}, 1e-7, 0, 0);
  std::vector<ScratchRows<Real>> scratch(static_cast<std::size_t>(threads));
  std::vector<NodeInCache, CacheLineAllocator<NodeInCache>> nodes(static_cast<std::size_t>(threads));
  for (ScratchRows<Real>& s : scratch) s.fit(4);
  const double elements = static_cast<double>(kRounds) * kSide * kSide * kTile;
  CachedTimes out;
  out.element = least_seconds(kTimes, [&] {
    for_each(threads, [&](std::ptrdiff_t t) {
      for (int k = 0; k < kRounds; ++k) evaluate_in_cache<Real, kind>(body.elements[0], kSide * kSide, scratch[t]);
    });
  });
  out.element /= elements;
  out.node = least_seconds(kTimes, [&] {
    for_each(threads, [&](std::ptrdiff_t t) {
      for (int k = 0; k < 50 * kRounds; ++k) advance_in_cache<Real, kind>(nodes[t], step, scratch[t].rows.data());
    });
  });
  out.node /= 50.0 * kRounds * kTile;
  return out;  // threads at once, each its own: the time of one
}

// -- the table ------------------------------------------------------------------------------------

double roof_seconds(const Need& need, const Machine& m) {
  return std::max({need.operations / m.flops, need.instructions / m.instructions(), need.bytes / m.bandwidth()});
}

void print_row(const std::string& name, const Need& need, double seconds, double elements, const Machine& m) {
  const double roof = roof_seconds(need, m);
  fmt::print("| {} | {:.1f} | {:.1f} | {:.1f} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {} |\n", name,
             need.operations / elements, need.instructions / elements, need.bytes / elements,
             1e3 * need.operations / m.flops, 1e3 * need.instructions / m.instructions(),
             1e3 * need.bytes / m.bandwidth(), 1e3 * seconds,
             roof > 1e-6 ? fmt::format("{:.2f}", roof / seconds) : std::string());
}

void print_machine(const Machine& m, const CachedTimes (&cached)[2]) {
  fmt::print("| {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.2f} | {:.2f} |\n", m.threads, 1e-9 * m.flops,
             1e-9 * m.triad, 1e-9 * m.nodal, 1e-6 * m.threads / cached[0].element, 1e-6 * m.threads / cached[1].element,
             1e9 * cached[0].node, 1e9 * cached[1].node);
}

struct Case {
  RollingSystem system;
  Stepper stepper;
  explicit Case(const CaseSpec& spec) : system(build_model(spec, ".")), stepper(system, solve_preload(system, 1e-2)) {}
};

struct Measured {
  std::array<double, kStepParts> part;  // s, least
  double step = 0, usual = 0;           // s, least and median
};
Measured measure_steps(Stepper& stepper, int steps) {
  StepLaps laps;
  Measured out;
  out.part.fill(1e99);
  stepper.time_parts(&laps);
  std::vector<double> step;
  for (int k = 0; k < steps; ++k) {
    step.push_back(least_seconds(1, [&] { stepper.step(); }));
    for (std::size_t p = 0; p < kStepParts; ++p) out.part[p] = std::min(out.part[p], laps.seconds()[p]);
  }
  stepper.time_parts(nullptr);
  std::sort(step.begin(), step.end());
  out.step = step.front();
  out.usual = step[step.size() / 2];
  return out;
}

template <class Real>
void print_roofline(Case& of, Machine m) {
  set_threads(m.threads);
  const Body* const body[2] = {&of.system.rail(), &of.system.wheel()};
  m.flops = peak_flops<Real>(m.threads);
  m.triad = triad_bandwidth();
  double size = 0;
  for (const Body* b : body) size += static_cast<double>(b->layout.size) / 3;
  m.nodal = nodal_bandwidth(static_cast<std::ptrdiff_t>(size));
  const CachedTimes cached[2] = {cached_times<Real, SweepKind::extrude>(m.threads),
                                 cached_times<Real, SweepKind::revolve>(m.threads)};
  MassScaling real_masses;  // as those of the base case
  Needs needs{};
  double elements = 0, kernel = 0, nodal = 0;
  for (const BodyId id : kBodies) {
    const std::size_t k = index_of(id);
    RollingBody rolling(*body[k], of.system.surfaces[k], real_masses, {});
    chain_tiles(rolling, false);
    add_needs(rolling, needs);
    needs[static_cast<std::size_t>(StepPart::ends)] +=
        rolling.turns() ? static_cast<double>(of.system.axle.bore.size()) * Need{10, 6, 24}
                        : static_cast<double>(of.system.absorbers.size()) * Need{5, 3, 32};
    const Counts n = counts_of(rolling);
    elements += n.elements;
    kernel += n.elements * cached[rolling.turns()].element / m.threads;
    nodal += n.nodes * cached[rolling.turns()].node / m.threads;
  }
  const Measured steps = measure_steps(of.stepper, 400);
  fmt::print("\n## {} thread{}\n", m.threads, m.threads > 1 ? "s" : "");
  fmt::print(
      "| threads | FMA [GF/s] | triad [GB/s] | nodal values [GB/s] | kernel in cache, extruded [M/s] | revolved | "
      "gather, "
      "scatter and update in cache [ns a node], extruded | revolved |\n|---|---|---|---|---|---|---|---|\n");
  print_machine(m, cached);
  fmt::print(
      "\n| part | operations | instructions | bytes | all operations fused [ms] | instructions [ms] | memory [ms] | "
      "measured [ms] | roof/measured |\n|---|---|---|---|---|---|---|---|---|\n");
  Need all;
  for (std::size_t p = 0; p < kStepParts; ++p) {
    if (p == static_cast<std::size_t>(StepPart::exchange)) continue;  // one rank
    print_row(kStepPartNames[p], needs[p], steps.part[p], elements, m);
    all += needs[p];
  }
  print_row("whole step", all, steps.step, elements, m);
  const double of_elements = steps.part[static_cast<std::size_t>(StepPart::elements)];
  fmt::print(
      "\nElements and updates: kernel at its rate in cache {:.2f} ms, gather, scatter and update at theirs {:.2f} "
      "ms, the rest {:.2f} ms.\n",
      1e3 * kernel, 1e3 * nodal, 1e3 * (of_elements - kernel - nodal));
  fmt::print("Whole steps: {:.1f} million element steps a second, by the median {:.1f}, at the roof {:.1f}.\n",
             1e-6 * elements / steps.step, 1e-6 * elements / steps.usual, 1e-6 * elements / roof_seconds(all, m));
}

void run(double millimetres, bool single) {
  set_threads(2);
  Case of(
      base_case(millimetres, single ? ArithmeticPrecision::single_precision : ArithmeticPrecision::double_precision));
  fmt::print(
      "Base case, {} mm, {} precision, {} elements, packs of {} bytes. Operations, instructions (a fused "
      "multiply-add is one) and bytes: an element and step.\n",
      millimetres, single ? "single" : "double", of.system.model.rail.elements() + of.system.model.wheel.elements(),
      kPackBytes);
  for (const int threads : {1, 2}) {
    if (single)
      print_roofline<float>(of, {threads});
    else
      print_roofline<double>(of, {threads});
  }
}

}  // namespace
}  // namespace railstrata

int main(int count, char** words) {
  double millimetres = 1;
  bool single = false;
  for (int k = 1; k < count; ++k) {
    if (std::string(words[k]) == "single")
      single = true;
    else
      millimetres = std::atof(words[k]);
  }
  if (!(millimetres > 0)) {
    fmt::print(stderr, "usage: roofline [MILLIMETRES] [single]\n");
    return 2;
  }
  railstrata::run(millimetres, single);
}
