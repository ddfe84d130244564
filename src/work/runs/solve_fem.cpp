#include "runs/solve_fem.hpp"

#include <chrono>
#include <utility>

#include "ask/judge.hpp"
#include "core/faults.hpp"
#include "device/device_of.hpp"
#include "fem/memory_need.hpp"
#include "judge/fem_summary.hpp"
#include "judge/window_change.hpp"
#include "model/rolling_start.hpp"
#include "passage/passage.hpp"
#include "rules/support.hpp"
#include "runs/device_at_hand.hpp"
#include "runs/steady_friction.hpp"

namespace railstrata {
namespace {

/// Lets the run ask the control, and hands the states that it asked for to the observer; the one that it stops at is
/// left in `stopped_at`.
void observe_states(RunControl& control, const RunObserver& observer, const FemOptions& options, RunObserver& run,
                    std::optional<RunState>& stopped_at) {
  run.demand = [&] {  // of several ranks what any of them asks for: signals and clocks differ
    Demand own = control.demand();
    if (own == Demand::save && !observer.save) own = Demand::go_on;  // nobody takes a checkpoint on the way
    return static_cast<Demand>(largest_of_all(options.ranks, static_cast<double>(own)));
  };
  if (!observer.save && !options.control && !(options.times.limit > 0)) return;
  run.save = [&](const RunState& state, bool stopping) {
    const auto start = std::chrono::steady_clock::now();
    if (observer.save) observer.save(state, stopping);
    control.saved(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    if (stopping) stopped_at = state;
  };
}

FemPosition position_of(const RollingSystem& system, const RunResult& run, const PositionSamples& samples) {
  FemPosition out;
  out.contact = mean_contact(system, samples);
  const Model& model = system.model;
  const double contact_y = model.placement.contact.point.y;
  out.rail = band_stress(model.rail, out.contact.rail, contact_y - model.rail.origin.y);
  out.wheel = band_stress(model.wheel, out.contact.wheel, contact_y - model.wheel.origin.y);
  out.summary = fem_summary(system, run, out.contact);
  CaseSpec here = model.spec;
  here.layers = layers_at(model.spec.layers, out.contact.position);
  out.streamlines = streamlines(here, out.contact.field);
  out.summary.damage = damage_summary(here, out.summary, out.streamlines);
  // its theorems judge elastic stresses that come again and again
  if (!model.spec.run.plasticity && varying_key(model.spec).empty())
    out.shakedown = fem_shakedown(model, out.contact.patch, {out.rail, band_surface(system, BodyId::rail, out.contact)},
                                  {out.wheel, band_surface(system, BodyId::wheel, out.contact)});
  judge_sections(model.spec, out.shakedown, out.summary);
  for (BodyFatigue& fatigue : passage_fatigue(system, run)) out.summary.fatigue.push_back(std::move(fatigue));
  sign(out.summary);
  return out;
}

WindowChange last_change(const RollingSystem& system, std::span<const PositionSamples> windows) {
  return change_between(mean_contact(system, windows[windows.size() - 2]), mean_contact(system, windows.back()),
                        system.spec().drive);
}

/// Of a run until windows repeat, with what they still differ by.
FemPosition last_window(const RollingSystem& system, const RunResult& run) {
  FemPosition out = position_of(system, run, run.positions.back());
  if (run.positions.size() < 2) return out;
  const WindowChange change = last_change(system, run.positions);
  out.summary.contact.error = change.change;
  warn_of_change(change, out.summary);
  sign(out.summary);
  return out;
}

/// On the rank that has the positions.
bool has_residual(const RollingSystem& system, const FemOptions& options) {
  return options.residual && system.model.spec.run.plasticity && options.ranks.is_root();
}

RunResult roll(const RollingSystem& system, const RunObserver& observer, const RunControl& control,
               const FemOptions& options, std::optional<RunState> begun) {
  require_device(system.model.spec, options.ranks);
  const std::unique_ptr<device::Device> device = device::device_of(system.model.spec);
  const StepBy by{options.ranks, device::engine_on(device.get()), steady_friction(system.model.spec)};
  try {
    return begun ? resume_rolling(system, observer, *std::move(begun), by)
                 : run_rolling(system, observer, options.before, by);
  } catch (const Interrupted&) {
    if (!control.limit_reached()) throw;
    throw EnvironmentError(
        "the static preload alone takes longer than --max-time allows: there is nothing to resume yet",
        "give the run more time");
  }
}

}  // namespace

RollingSystem fem_system(const CaseSpec& spec, const std::filesystem::path& folder) {
  require_support(uses::kFiniteElements, spec);
  const Model model = build_model(spec, folder);
  require_memory(model);
  return RollingSystem(model);
}

FemSolution solve_fem(const RollingSystem& system, const RunObserver& observer, const FemOptions& options,
                      std::optional<RunState> begun) {
  Control& asked = control_or_none(options.control);
  RunControl control(options.times, asked);
  RunObserver run_observer = observer;
  run_observer.preload = [&](double residual, double wanted, int iterations) {
    asked.detail("preload: residual {:.1e} (wanted {:.0e}), {} iterations", residual, wanted, iterations);
    return !control.must_stop();
  };
  if (!observer.progress)
    run_observer.progress = [&](double fraction, const HistoryRow& row) {
      asked.progress("rolling", fraction);
      asked.detail("rolling: x {:.1f} mm, F_z {:.2f} kN, F_x/F_z {:.3f}, p_max {:.0f} MPa", 1e3 * row.position,
                   1e-3 * row.forces.z, row.forces.x / row.forces.z, 1e-6 * row.p_max);
    };
  std::optional<RunResidual> residual;
  run_observer.finished = [&](const RollingState& state) {
    if (observer.finished) observer.finished(state);
    if (has_residual(system, options) && varying_key(system.model.spec).empty()) residual = run_residual(system, state);
  };
  run_observer.repeats = [&](std::span<const PositionSamples> windows) {
    const bool own = options.ranks.is_root() && windows.size() > 1 && repeats(last_change(system, windows));
    return largest_of_all(options.ranks, own) > 0;
  };
  std::optional<RunState> stopped_at;
  observe_states(control, observer, options, run_observer, stopped_at);

  RunResult run = roll(system, run_observer, control, options, std::move(begun));
  if (has_residual(system, options)) {
    if (!system.model.spec.run.rolling) residual.emplace().none = "the wheel stands where it was put on";
    if (!varying_key(system.model.spec).empty()) residual.emplace().none = "the rail is not the same all along";
  }
  FemSolution out;
  out.stopped = run.stopped;
  out.limit_reached = control.limit_reached();
  out.state = std::move(stopped_at);
  if (!options.ranks.is_root()) return out;
  if (system.model.until_repeated && !run.positions.empty())
    out.positions.push_back(last_window(system, run));
  else
    for (const PositionSamples& samples : run.positions) {
      if (samples.samples.empty()) break;
      out.positions.push_back(position_of(system, run, samples));
    }
  out.residual = std::move(residual);
  out.history = std::move(run.history);
  return out;
}

}  // namespace railstrata
