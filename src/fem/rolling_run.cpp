#include "fem/rolling_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "core/faults.hpp"
#include "fem/guards.hpp"

namespace railstrata {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

constexpr long kStepsBetweenGoodStates = 1024;  // a copy of the state costs less than a step

// Half length of a sample: the patch and the stress field around it.
double sample_half_length(const RollingSystem& s) { return 1.5 * s.model.hertz.a + 2 * s.model.spec.mesh.element_size; }

BandSample band_sample(const Solid& solid, const ContactBand& band, const Field& u, double centre, double radius,
                       const AxlePose& pose, double half_length) {
  const Block& block = solid.body().blocks[band.block];
  const BlockLayout& lay = solid.layout().blocks[band.block];
  const auto& at = block.stations.at;
  const double period = block.stations.closed ? 2 * std::numbers::pi : 0;
  const int n = lay.stations;
  auto wrapped = [&](int j) { return ((j % n) + n) % n; };
  auto coordinate = [&](int j) {
    return block.stations.closed ? at[wrapped(j)] + period * std::floor(static_cast<double>(j) / n) : at[j];
  };
  if (period > 0) centre -= period * std::floor((centre - at.front()) / period);
  int middle = static_cast<int>(std::lower_bound(at.begin(), at.end(), centre) - at.begin());
  if (middle > 0 && (middle >= n || centre - at[middle - 1] < at[middle] - centre)) --middle;
  // The same number of stations on either side whatever the exact position, so that samples can be averaged station by
  // station.
  const int reach = static_cast<int>(std::ceil(half_length / radius / (coordinate(middle + 1) - coordinate(middle))));
  const int first = block.stations.closed ? middle - reach : std::max(middle - reach, 0);
  const int last = block.stations.closed ? middle + reach : std::min(middle + reach, lay.elements);

  BandSample s;
  s.columns = band.columns;
  s.rows = band.rows;
  s.stations = last - first;
  for (int j = first; j <= last; ++j) s.along.push_back(radius * (coordinate(j) - centre));
  for (int j = first; j < last; ++j)
    for (int q = 0; q < band.rows * band.columns; ++q)
      s.stress.push_back(solid.stress(u, band.block, q, block.stations.closed ? wrapped(j) : j));
  const bool turning = solid.body().kind == SweepKind::revolve;
  const double c = std::cos(pose.psi), sn = std::sin(pose.psi);
  for (int j = first; j <= last; ++j)
    for (int k = 0; k < (band.rows + 1) * (band.columns + 1); ++k) {
      const int station = block.stations.closed ? wrapped(j) : j;
      const std::ptrdiff_t i = lay.line(k, 0) + station;
      Vec3 d{u[i], u[i + lay.stride], u[i + 2 * lay.stride]};
      if (turning) {
        const Vec3 arm = solid.reference_position(band.block, k, station) - solid.body().origin;
        d -= Vec3{pose.x + (c - 1) * arm.x + sn * arm.z, 0, pose.z + (c - 1) * arm.z - sn * arm.x};
      }
      s.displacement.push_back(d);
    }
  return s;
}

double largest_pressure(const TractionMemory& t) {
  double p = 0;
  for (const NodeTraction& n : t.all()) p = std::max(p, n.p);
  return p;
}

// The wheel positions at which a wanted position is sampled: every rail station of the window, so that samples fall on
// the same points of the mesh.
std::vector<double> sample_positions(const RollingSystem& s, double position) {
  const auto& at = s.rail_surface.stations.at;
  const auto near = std::lower_bound(at.begin(), at.end(), position);
  const double spacing = *near - *std::prev(near);
  constexpr double kRounding = 1e-6;  // half a window of two and a half elements is three by every instruction set
  const int half = std::max(1, static_cast<int>(std::lround(0.5 * s.model.spec.run.window / spacing + kRounding)));
  std::vector<double> out;
  for (int k = -half; k <= half; ++k) out.push_back(position + k * spacing);
  return out;
}

HistoryRow history_row(const Stepper& st, const EnergyBalance& now, const EnergyBalance& start) {
  const RollingState& s = st.state();
  return {s.time,    st.position(), st.torque(), st.forces(), largest_pressure(s.tractions), st.creepage(),
          s.axle.vx, s.axle.vz,     s.axle.spin, now,         now.total() - start.total()};
}

std::vector<double> sorted_targets(const RollingSystem& sys) {
  std::vector<double> targets = sys.model.spec.run.positions;
  std::sort(targets.begin(), targets.end());
  return targets;
}

/// Where samples are wanted, in order of position, and for which of the wanted positions.
struct Wanted {
  double position;
  std::size_t group;
};
std::vector<Wanted> wanted_samples(const RollingSystem& sys) {
  std::vector<Wanted> wanted;
  std::size_t group = 0;
  for (double target : sorted_targets(sys)) {
    for (double x : sample_positions(sys, target)) wanted.push_back({x, group});
    ++group;
  }
  std::stable_sort(wanted.begin(), wanted.end(),
                   [](const Wanted& a, const Wanted& b) { return a.position < b.position; });
  return wanted;
}

RollingSample sample_now(const Stepper& st) {
  RollingSample s = take_sample(st.system(), st.state().u_rail, st.wheel_displacement(), st.state().tractions,
                                {st.state().axle.x, st.state().axle.z, st.state().axle.psi});
  s.time = st.state().time;
  s.axle = st.state().axle;
  s.forces = st.forces();
  s.creepage = st.creepage();
  return s;
}

// The tables of a result only grow: a state of some moment does without them, its own are the first rows and samples of
// those there are later.
void swap_tables(RunResult& a, RunResult& b) {
  a.history.swap(b.history);
  a.positions.swap(b.positions);
}

void cut_tables(RunResult& result, std::size_t rows, std::size_t samples, const std::vector<Wanted>& wanted) {
  std::vector<std::size_t> count(result.positions.size(), 0);
  for (std::size_t k = 0; k < samples; ++k) ++count[wanted[k].group];
  for (std::size_t g = 0; g < count.size(); ++g) result.positions[g].samples.resize(count[g]);
  result.history.resize(rows);
}

RunResult roll(const RollingSystem& sys, const RunObserver& observer, Stepper& st, RunState run,
               Clock::time_point start_time) {
  const CaseSpec& spec = sys.model.spec;
  RunResult& out = run.result;
  out.limits = st.plan().limits;
  out.dt = st.dt();
  const double earlier_seconds = out.wall_seconds;
  const std::vector<Wanted> wanted = wanted_samples(sys);
  const double end = std::max(sys.model.x_end, wanted.back().position);
  const int frames = std::max(spec.output.series_frames, 1);
  const auto timed = [&](auto&& output) {
    const auto start = Clock::now();
    output();
    out.output_wall_seconds += seconds_since(start);
  };
  RunState good;  // the last one that was looked at, without tables: saved on demand or when a guard speaks
  std::size_t good_rows = 0;
  auto remember = [&] {
    require_finite(st);
    out.wall_seconds = earlier_seconds + seconds_since(start_time);
    out.reached_edge = st.reached_edge();
    good = {};  // one at a time
    RunResult tables;
    swap_tables(tables, out);
    good = run;
    swap_tables(tables, out);
    good_rows = out.history.size();
    good.stepper = st.memory();
  };
  auto save = [&] {
    if (!observer.save) return;
    remember();
    swap_tables(good.result, out);
    observer.save(good);
    swap_tables(good.result, out);
  };

  auto one_step = [&] {
    const bool record = st.position() >= run.next_history;
    if (record) st.want_energy();
    st.step();
    require_sound(st);
    require_forward(st);
    if (record) {
      run.next_history += spec.run.history_interval;
      const EnergyBalance now = st.energy();
      if (!run.started) {
        run.start_energy = now;
        run.started = true;
      }
      const HistoryRow row = history_row(st, now, run.start_energy);
      run.largest_closure = std::max(run.largest_closure, std::abs(row.closure));
      run.largest_energy = std::max({run.largest_energy, now.torque_work, now.strain});
      require_within_bounds(st, row, run.largest_energy, out.history.size());
      out.hourglass_share = std::max(out.hourglass_share, now.hourglass / now.strain);
      out.run_up_damping_energy = now.damping;
      out.history.push_back(row);
      timed([&] {
        if (observer.history) observer.history(row);
        if (observer.progress) observer.progress(st.position() / end, row);
      });
    }
    if (observer.frame && st.position() >= run.next_frame) {
      run.next_frame += end / frames;
      run.frame_times.push_back(st.state().time);
      timed([&] { observer.frame(sample_now(st)); });
    }
    while (run.next_sample < wanted.size() && st.position() >= wanted[run.next_sample].position) {
      out.penetration = std::max(out.penetration, st.forces().penetration);
      timed([&] { out.positions[wanted[run.next_sample].group].samples.push_back(sample_now(st)); });
      ++run.next_sample;
    }
  };

  // False when the run is to stop.
  auto between_steps = [&] {
    if (!st.can_be_remembered()) return true;
    const Demand demand = observer.demand ? observer.demand() : Demand::go_on;
    if (demand != Demand::go_on)
      timed(save);
    else if (observer.save && st.state().step % kStepsBetweenGoodStates == 0)
      timed(remember);
    return demand != Demand::save_and_stop;
  };

  try {
    while (!out.stopped && run.next_sample < wanted.size())
      if (between_steps())
        one_step();
      else
        out.stopped = true;
  } catch (const NumericalError&) {
    if (observer.save && good.stepper.dt > 0) {
      cut_tables(out, good_rows, good.next_sample, wanted);
      swap_tables(good.result, out);
      observer.save(good);
    }
    throw;
  }
  if (out.stopped)  // a position half measured is none
    while (!out.positions.empty() &&
           out.positions.back().samples.size() < sample_positions(sys, out.positions.back().position).size())
      out.positions.pop_back();
  out.closure = run.largest_energy > 0 ? run.largest_closure / run.largest_energy : 0;
  out.reached_edge = st.reached_edge();
  out.steps = st.state().step;
  out.wall_seconds = earlier_seconds + seconds_since(start_time);
  return std::move(run.result);
}

}  // namespace

RollingSample take_sample(const RollingSystem& sys, const Field& u_rail, const Field& u_wheel,
                          const TractionMemory& tractions, const AxlePose& pose) {
  RollingSample out;
  const double half = sample_half_length(sys);
  out.position = pose.x;
  out.rail = band_sample(sys.rail.solid, sys.model.rail.contact, u_rail, pose.x, 1.0, {}, half);
  out.wheel = band_sample(sys.wheel.solid, sys.model.wheel.contact, u_wheel, pose.psi, sys.rolling_radius, pose, half);
  const auto& at = sys.rail_surface.stations.at;
  const int first =
      static_cast<int>(std::lower_bound(at.begin(), at.end(), out.rail.along.front() + pose.x - 1e-9) - at.begin());
  for (int j = first; j <= first + out.rail.stations; ++j)
    for (int c = 0; c < sys.rail_surface.columns; ++c) out.tractions.push_back(tractions.at(c, j));
  return out;
}

RunResult run_rolling(const RollingSystem& sys, const RunObserver& observer) {
  const RunSpec& run = sys.model.spec.run;
  const auto start_time = Clock::now();
  RunResult out;
  out.elements = sys.model.rail.elements() + sys.model.wheel.elements();
  out.nodes = sys.model.rail.nodes() + sys.model.wheel.nodes();
  PreloadResult preload = solve_preload(sys, run.preload_tolerance, observer.preload, observer.stop);
  out.preload_wall_seconds = preload.wall_seconds;

  if (!run.rolling) {
    PositionSamples still{
        0.0, {take_sample(sys, preload.u_rail, preload.u_wheel, preload.tractions, {0, preload.axle_z, 0})}};
    still.samples.front().axle.z = preload.axle_z;
    const Vec3 force = preload.contact_force;
    still.samples.front().forces = {.x = force.x, .y = force.y, .z = force.z, .penetration = preload.penetration};
    Field& ur = preload.u_rail;
    Field& uw = preload.u_wheel;
    const StrainEnergy rail = strain_energy(sys.rail, ur, 0), wheel = strain_energy(sys.wheel, uw, 0);
    out.hourglass_share = (rail.hourglass + wheel.hourglass) / (rail.strain + wheel.strain);
    out.penetration = preload.penetration;
    out.positions.push_back(std::move(still));
    preload.u_rail = preload.u_wheel = Field{};
    out.preload = std::move(preload);
    out.wall_seconds = seconds_since(start_time);
    return out;
  }

  Stepper st(sys, preload);
  preload.u_rail = preload.u_wheel = Field{};
  out.preload = std::move(preload);
  for (double target : sorted_targets(sys)) out.positions.push_back({target, {}});
  RunState state;
  state.result = std::move(out);
  return roll(sys, observer, st, std::move(state), start_time);
}

RunResult resume_rolling(const RollingSystem& sys, const RunObserver& observer, RunState state) {
  const auto start_time = Clock::now();
  Stepper st(sys, std::move(state.stepper));
  state.stepper = {};
  return roll(sys, observer, st, std::move(state), start_time);
}

}  // namespace railstrata
