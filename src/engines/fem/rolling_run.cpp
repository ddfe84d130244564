#include "fem/rolling_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "body/plastic_pass.hpp"
#include "body/traversal.hpp"
#include "core/faults.hpp"
#include "fem/guards.hpp"

namespace railstrata {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

PlasticExtent of_both(const PlasticExtent& a, const PlasticExtent& b) {
  return {std::max(a.accumulated, b.accumulated), std::max(a.strain, b.strain), a.yielded + b.yielded};
}

void add_remains(const RollingSystem& sys, const PlasticHistory& rail, const PlasticHistory& wheel, RunResult& out) {
  out.plastic = of_both(plastic_extent(sys.rail(), rail), plastic_extent(sys.wheel(), wheel));
  const PlasticPeak in_rail = plastic_peak(sys.rail(), rail), in_wheel = plastic_peak(sys.wheel(), wheel);
  const bool rail_more = in_rail.accumulated >= in_wheel.accumulated;
  out.remains = {rail_more ? BodyId::rail : BodyId::wheel, rail_more ? in_rail : in_wheel,
                 plastic_work(sys.rail(), rail) + plastic_work(sys.wheel(), wheel),
                 backstress_energy(sys.rail(), rail) + backstress_energy(sys.wheel(), wheel)};
}

constexpr long kStepsBetweenGoodStates = 1024;  // a copy of the state costs less than a step

// The wheel positions at which a wanted position is sampled: every rail station of the window, so that samples fall on
// the same points of the mesh.
std::vector<double> sample_positions(const RollingSystem& s, double position) {
  const ContactSurface& rail = s.rail_surface();
  const auto& at = rail.stations.at;
  const auto near =
      std::lower_bound(at.begin(), at.end(), rail.rises ? rail.contact_at - position / rail.radius : position);
  const double spacing = rail.radius * (*near - *std::prev(near));
  constexpr double kRounding = 1e-6;  // half a window of two and a half elements is three by every instruction set
  const int half = std::max(1, static_cast<int>(std::lround(0.5 * s.model.spec.run.window / spacing + kRounding)));
  std::vector<double> out;
  for (int k = -half; k <= half; ++k) out.push_back(position + k * spacing);
  return out;
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

// A state of some moment is kept without the tables of its result: they only grow, so its own are the first rows and
// samples of those there are later.
void swap_tables(RunResult& a, RunResult& b) {
  a.history.swap(b.history);
  a.positions.swap(b.positions);
}

// Back to what the tables were after so many rows and samples.
void cut_tables(RunResult& result, std::size_t rows, std::size_t samples, const std::vector<Wanted>& wanted) {
  std::vector<std::size_t> count(result.positions.size(), 0);
  for (std::size_t k = 0; k < samples; ++k) ++count[wanted[k].group];
  for (std::size_t g = 0; g < count.size(); ++g) result.positions[g].samples.resize(count[g]);
  result.history.resize(rows);
}

/// Rolls from a state to the last sample, or until it is to stop.
class Roller {
 public:
  Roller(const RollingSystem& system, const RunObserver& observer, Stepper& stepper, RunState run,
         Clock::time_point start)
      : sys_(system),
        observer_(observer),
        stepper_(stepper),
        run_(std::move(run)),
        wanted_(wanted_samples(system)),
        end_(std::max(system.model.x_end, wanted_.back().position)),
        frame_spacing_(end_ / std::max(system.model.spec.run.output.series_frames, 1)),
        start_(start),
        earlier_seconds_(run_.result.wall_seconds) {
    result().limits = stepper_.plan().limits;
    result().dt = stepper_.dt();
  }

  RunResult roll() {
    try {
      while (!result().stopped && !all_sampled())
        if (attend_to_demand())
          step();
        else
          result().stopped = true;
    } catch (const NumericalError&) {
      save_last_good_state();
      throw;
    }
    return finish();
  }

 private:
  // False when the run is to stop.
  bool attend_to_demand() {
    if (!stepper_.is_restart_point()) return true;
    const Demand demand = observer_.demand ? observer_.demand() : Demand::go_on;
    if (demand != Demand::go_on)
      time_output([&] { save(demand == Demand::save_and_stop); });
    else if (observer_.save && stepper_.state().step % kStepsBetweenGoodStates == 0)
      time_output([&] { keep_state(); });
    return demand != Demand::save_and_stop;
  }
  void step() {
    const bool record = stepper_.position() >= run_.next_history;
    if (record) stepper_.want_energy();
    stepper_.check_next_at(next_look());
    stepper_.step();
    require_sound(stepper_);
    require_forward(stepper_);
    if (record) record_history();
    if (observer_.frame && stepper_.position() >= run_.next_frame) show_frame();
    take_due_samples();
  }
  double likely_end() const { return sys_.model.until_repeated ? sys_.model.likely_end(stepper_.position()) : end_; }
  // Where more than scalars is read of a step, or energies are asked for.
  double next_look() const {
    double next = std::min(run_.next_history, wanted_[run_.next_sample].position);
    if (observer_.frame) next = std::min(next, run_.next_frame);
    return next;
  }
  void record_history() {
    run_.next_history += sys_.model.spec.run.history_interval;
    const EnergyBalance& now = stepper_.energy();
    if (!run_.started) {
      run_.start_energy = now;
      run_.started = true;
    }
    if (sys_.varies_along() || result().history.size() % GuardLimits{}.rows_between_shapes == 0) stepper_.complete();
    const HistoryRow row = history_row(stepper_, run_.start_energy);
    run_.largest_closure = std::max(run_.largest_closure, std::abs(row.closure));
    run_.largest_energy = std::max({run_.largest_energy, now.torque_work, now.strain});
    require_within_bounds(stepper_, row, run_.largest_energy, result().history.size());
    result().hourglass_share = std::max(result().hourglass_share, now.hourglass / now.strain);
    result().run_up_damping_energy = now.damping;
    result().history.push_back(row);
    time_output([&] {
      if (observer_.history) observer_.history(row);
      if (observer_.progress) observer_.progress(stepper_.position() / likely_end(), row);
    });
  }
  void show_frame() {
    run_.next_frame += frame_spacing_;
    run_.frame_times.push_back(stepper_.state().time);
    stepper_.complete();
    time_output([&] { observer_.frame(take_sample(stepper_)); });
  }
  void take_due_samples() {
    for (; !all_sampled() && stepper_.position() >= wanted_[run_.next_sample].position; ++run_.next_sample) {
      stepper_.complete();
      result().penetration = std::max(result().penetration, stepper_.forces().penetration);
      const std::size_t group = wanted_[run_.next_sample].group;
      time_output([&] { result().positions[group].samples.push_back(take_sample(stepper_)); });
      if (sys_.model.until_repeated) look_whether_repeated(group);
    }
  }
  void look_whether_repeated(std::size_t group) {
    std::vector<PositionSamples>& positions = result().positions;
    const PositionSamples& window = positions[group];
    const bool whole = window.samples.size() == sample_positions(sys_, window.position).size();
    if (!whole || !observer_.repeats) return;
    time_output([&] { repeated_ = observer_.repeats(std::span(positions).first(group + 1)); });
    if (repeated_) positions.resize(group + 1);
  }
  void keep_state() {
    stepper_.complete();
    require_finite(stepper_);
    result().wall_seconds = wall_seconds();
    result().reached_edge = stepper_.reached_edge();
    good_ = {};  // one at a time
    RunResult tables;
    swap_tables(tables, result());
    good_ = run_;
    swap_tables(tables, result());
    good_rows_ = result().history.size();
    good_.stepper = stepper_.restart_state();
  }
  void save(bool stopping) {
    if (!observer_.save) return;
    keep_state();
    swap_tables(good_.result, result());
    observer_.save(good_, stopping);
    swap_tables(good_.result, result());
  }
  void save_last_good_state() {
    if (!observer_.save || good_.stepper.dt == 0) return;
    cut_tables(result(), good_rows_, good_.next_sample, wanted_);
    swap_tables(good_.result, result());
    observer_.save(good_, false);
  }
  // A position measured in a part of its window only is none.
  void drop_unfinished_positions() {
    std::vector<PositionSamples>& positions = result().positions;
    while (!positions.empty() &&
           positions.back().samples.size() < sample_positions(sys_, positions.back().position).size())
      positions.pop_back();
  }
  RunResult finish() {
    stepper_.complete();
    if (result().stopped)
      drop_unfinished_positions();
    else if (observer_.finished)
      observer_.finished(stepper_.state());
    result().closure = run_.largest_energy > 0 ? run_.largest_closure / run_.largest_energy : 0;
    result().reached_edge = stepper_.reached_edge();
    result().steps = stepper_.state().step;
    const RollingState& state = stepper_.state();
    add_remains(sys_, state.bodies[kRail].history, state.bodies[kWheel].history, result());
    result().wall_seconds = wall_seconds();
    return std::move(run_.result);
  }
  RunResult& result() { return run_.result; }
  bool all_sampled() const { return repeated_ || run_.next_sample == wanted_.size(); }
  double wall_seconds() const { return earlier_seconds_ + seconds_since(start_); }
  template <class Output>
  void time_output(Output&& output) {
    const auto start = Clock::now();
    output();
    result().output_wall_seconds += seconds_since(start);
  }

  const RollingSystem& sys_;
  const RunObserver& observer_;
  Stepper& stepper_;
  RunState run_;
  std::vector<Wanted> wanted_;
  double end_, frame_spacing_;  // m
  Clock::time_point start_;
  double earlier_seconds_;  // of the sittings before this one
  bool repeated_ = false;   // the last windows
  RunState good_;           // the last state that was looked at, without tables; saved when a guard ends the run
  std::size_t good_rows_ = 0;
};

// A static case has one position with one sample.
PositionSamples still_contact(const RollingSystem& sys, const PreloadResult& preload) {
  const PlasticHistory &rail = preload.history[kRail], &wheel = preload.history[kWheel];
  const Field u_wheel = yawed_displacement(sys.wheel(), sys.wheel_surface().yaw, preload.u[kWheel]);
  const AxlePose pose{0, 0, preload.axle_z, 0};
  PositionSamples still{0.0, {take_sample(sys, {preload.u[kRail], rail}, {u_wheel, wheel}, preload.tractions, pose)}};
  RollingSample& sample = still.samples.front();
  sample.axle.z = preload.axle_z;
  const Vec3 force = preload.contact_force;
  sample.forces = {.x = force.x, .y = force.y, .z = force.z, .penetration = preload.penetration};
  return still;
}

double hourglass_share(const RollingSystem& sys, PreloadResult& preload) {
  const StrainEnergy rail = Traversal(sys.rail()).energy(preload.u[kRail], 0, preload.history[kRail]);
  const StrainEnergy wheel = Traversal(sys.wheel()).energy(preload.u[kWheel], 0, preload.history[kWheel]);
  return (rail.hourglass + wheel.hourglass) / (rail.strain + wheel.strain);
}

void drop_fields(PreloadResult& preload) {
  preload.u = {};
  preload.history = {};
  preload.before = {};
}

}  // namespace

RunResult run_rolling(const RollingSystem& sys, const RunObserver& observer, const RailBefore* before,
                      const StepBy& by) {
  const RunSpec& run = sys.model.spec.run;
  const auto start = Clock::now();
  RunResult out;
  out.elements = sys.model.rail.elements() + sys.model.wheel.elements();
  out.nodes = sys.model.rail.nodes() + sys.model.wheel.nodes();
  PreloadResult preload = solve_preload(sys, run.preload_tolerance, observer.preload, before, by.ranks, by.friction);
  out.preload_wall_seconds = preload.wall_seconds;

  if (!run.rolling) {
    out.positions.push_back(still_contact(sys, preload));
    out.hourglass_share = hourglass_share(sys, preload);
    out.penetration = preload.penetration;
    add_remains(sys, preload.history[kRail], preload.history[kWheel], out);
    drop_fields(preload);
    out.preload = std::move(preload);
    out.wall_seconds = seconds_since(start);
    return out;
  }

  Stepper stepper(sys, preload, by.ranks);
  stepper.use(by.engine);
  drop_fields(preload);
  out.preload = std::move(preload);
  for (double target : sorted_targets(sys)) out.positions.push_back({target, {}});
  RunState state;
  state.result = std::move(out);
  return Roller(sys, observer, stepper, std::move(state), start).roll();
}

RunResult resume_rolling(const RollingSystem& sys, const RunObserver& observer, RunState state, const StepBy& by) {
  const auto start = Clock::now();
  Stepper stepper(sys, std::move(state.stepper), by.ranks);
  stepper.use(by.engine);
  state.stepper = {};
  return Roller(sys, observer, stepper, std::move(state), start).roll();
}

}  // namespace railstrata
