#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "app/case_of.hpp"
#include "app/commands.hpp"
#include "app/option_values.hpp"
#include "app/processors.hpp"
#include "app/progress.hpp"
#include "app/signals.hpp"
#include "app/summary_text.hpp"
#include "app/write_page.hpp"
#include "core/shell_word.hpp"
#include "io/folder_kind.hpp"
#include "io/output_folder.hpp"
#include "io/provenance.hpp"
#include "runs/write_fem_result.hpp"

namespace railstrata {
namespace {

/// The phases of a run on the screen: a line as each begins, a bar while it rolls.
class PhaseReport {
 public:
  explicit PhaseReport(bool shown) : shown_(shown) {}
  void meshing() { spdlog::info("meshing wheel and rail"); }
  void preload() { spdlog::info("static preload"); }
  void preload_step(double residual, double wanted, int iterations) {
    spdlog::debug("preload: residual {:.1e} (wanted {:.0e}), {} iterations", residual, wanted, iterations);
  }
  void rolling(double fraction, const HistoryRow& row) {
    if (!bar_) bar_.emplace("rolling", shown_);
    bar_->update(fraction);
    spdlog::debug("rolling: x {:.1f} mm, F_z {:.2f} kN, F_x/F_z {:.3f}, p_max {:.0f} MPa", 1e3 * row.position,
                  1e-3 * row.forces.z, row.forces.x / row.forces.z, 1e-6 * row.p_max);
  }
  void checkpoint(const RunState& state) {
    clear();
    spdlog::info("checkpoint at x = {:.2f} mm", 1e3 * state.stepper.state.axle.x);
  }
  void warning(const std::string& text) {
    clear();
    spdlog::warn("{}", text);
  }
  void results() { bar_.reset(); }

 private:
  void clear() {
    if (bar_) bar_->clear();
  }
  bool shown_;
  std::optional<Progress> bar_;
};

bool has_checkpoint(const std::filesystem::path& folder) {
  return std::filesystem::exists(checkpoint_file(folder)) || std::filesystem::exists(previous_checkpoint_file(folder));
}

// The case of the folder, as it was run.
LoadedCase case_of_folder(const CommandOptions& options) {
  if (!options.case_file.empty() || !options.overrides.empty() || !options.out.empty() || options.force)
    throw CaseError("--resume goes on with the run of a folder as it was begun",
                    "leave out the case, --set, --out and --force; another case is another run");
  if (!std::filesystem::is_directory(options.run.resume))
    throw CaseError(fmt::format("--resume {}: there is no such folder", options.run.resume.string()),
                    "name the result folder of a run that was interrupted");
  if (std::filesystem::exists(options.run.resume / "summary.json") && !has_checkpoint(options.run.resume))
    throw CaseError(fmt::format("there is nothing to resume: {} holds a finished run", options.run.resume.string()),
                    "start another with `railstrata run CASE`");
  if (!std::filesystem::exists(options.run.resume / "case.toml"))
    throw CaseError(fmt::format("{} has no case.toml, which a run goes on with", options.run.resume.string()),
                    "name the result folder of a run that was interrupted, or put its case.toml back");
  return load_case(options.run.resume / "case.toml");
}

std::string resume_command(const std::filesystem::path& folder) {
  return fmt::format("railstrata run --resume {}", shell_word(folder.string()));
}

// What can be done once the machine lets us write again.
std::string how_to_go_on(const std::filesystem::path& folder) {
  return has_checkpoint(folder) ? fmt::format(", then go on with\n    {}", resume_command(folder))
                                : std::string(", then start the run again with --force");
}

/// What is to be computed, and where; `begun`: the state to go on from.
struct RunJob {
  LoadedCase loaded;
  std::filesystem::path out;
  CheckpointOrigin origin;
  FolderHold hold;
  std::optional<RunState> begun;
};

CheckpointOrigin origin_of(const LoadedCase& loaded, std::string identity) {
  return {std::move(identity), version_text(), table_origin(loaded)};
}

RunJob resumed_job(const CommandOptions& options) {
  LoadedCase loaded = case_of_folder(options);
  const std::filesystem::path& out = options.run.resume;
  CheckpointOrigin origin = origin_of(loaded, identity_in_folder(out, loaded));
  FolderHold hold(out);
  if (!has_checkpoint(out))
    throw CaseError(
        fmt::format("there is nothing to resume in {}: the run was stopped before its first checkpoint", out.string()),
        fmt::format("start it again: {}", command_again(out)));
  FoundCheckpoint found = read_checkpoint(out, origin.case_sha256);
  for (const std::string& note : found.notes) spdlog::warn("{}; the checkpoint before it is taken", note);
  if (found.checkpoint.origin.program != origin.program)
    spdlog::warn("the run was begun by RailStrata {}, this is {}: it goes on, but not with the bits of a run in one go",
                 found.checkpoint.origin.program, origin.program);
  remove_abandoned_parts(out);
  origin.provenance = found.checkpoint.origin.provenance;
  spdlog::info("{}: goes on in {} at x = {:.2f} mm, t = {:.4g} ms", loaded.spec.title, out.string(),
               1e3 * found.checkpoint.run.stepper.state.axle.x, 1e3 * found.checkpoint.run.stepper.state.time);
  return {std::move(loaded), out, std::move(origin), std::move(hold), std::move(found.checkpoint.run)};
}

RunJob new_job(const CommandOptions& options) {
  LoadedCase loaded = load_case_of(options);
  require_finite_elements(loaded);
  const std::filesystem::path out = output_folder_of(options, loaded);
  place(loaded.spec, loaded.folder());  // faults of the input before a folder is made
  require_apart(out, loaded);
  FolderHold hold = prepare_output_folder(out, options.force);
  spdlog::info("{}: results go to {}", loaded.spec.title, out.string());
  CheckpointOrigin origin = origin_of(loaded, case_identity(loaded));
  return {std::move(loaded), out, std::move(origin), std::move(hold), {}};
}

/// What is left of a solution when its files are written.
struct RunOutcome {
  std::vector<Summary> summaries;
  bool stopped = false, limit_reached = false;
};

FemSolution solve(RunJob& job, const RollingSystem& system, FemWriter& writer, const FemOptions& options,
                  PhaseReport& report) {
  FemObserver observer;
  writer.observe(
      observer, [&](const RunState& state) { report.checkpoint(state); },
      [&](const std::string& text) { report.warning(text); });
  observer.preload = [&](double residual, double wanted, int iterations) {
    report.preload_step(residual, wanted, iterations);
  };
  observer.rolling = [&](double fraction, const HistoryRow& row) { report.rolling(fraction, row); };
  try {
    return solve_fem(system, observer, options, std::move(job.begun));
  } catch (const NumericalError& e) {
    if (!std::filesystem::exists(checkpoint_file(job.out))) throw;
    throw NumericalError(
        fmt::format("{}\n    the last good state is in {}", e.what(), checkpoint_file(job.out).string()));
  }
}

RunOutcome solve_and_write(RunJob& job, const CommandOptions& options, const FemOptions& fem) {
  PhaseReport report(spdlog::default_logger()->level() <= spdlog::level::info);
  report.meshing();
  const RollingSystem system = fem_system(job.loaded.spec, job.loaded.folder());
  if (!job.begun) {
    clear_old_results(job.out);
    write_origin(job.out, job.loaded, options.command_line, options.threads);
  }
  FemWriter writer(system, job.out, job.origin, job.begun ? &*job.begun : nullptr);
  if (!job.begun) report.preload();
  const FemSolution solution = solve(job, system, writer, fem, report);
  report.results();
  writer.write(solution);
  RunOutcome out{{}, solution.stopped, solution.limit_reached};
  for (const FemPosition& position : solution.positions) out.summaries.push_back(position.summary);
  return out;
}

void warn_of_shared_processors(int threads) {
  if (const std::string many = oversubscription(threads); !many.empty()) spdlog::warn("{}", many);
  if (const std::string busy = competition(threads); !busy.empty()) spdlog::info("{}", busy);
}

}  // namespace

ExitCode command_run(const CommandOptions& options) {
  FemOptions fem;
  fem.wishes = {&stop_flag(), &save_flag()};  // from here on a signal is a wish
  fem.times.checkpoint_every = wall_time("--checkpoint-every", options.run.checkpoint_every);
  fem.times.limit = wall_time("--max-time", options.run.max_time);
  if (options.run.resume.empty() && options.case_file.empty())
    throw CaseError("run: no case was named",
                    "name a case file, or go on with an interrupted run: railstrata run --resume FOLDER");
  RunJob job = options.run.resume.empty() ? new_job(options) : resumed_job(options);
  warn_of_shared_processors(options.threads);
  const RunOutcome outcome = [&] {
    try {
      return solve_and_write(job, options, fem);
    } catch (EnvironmentError& e) {
      if (!e.remedy.empty()) e.remedy += how_to_go_on(job.out);
      throw;
    } catch (const Interrupted& e) {  // before there was anything to keep
      throw Interrupted(fmt::format("{}\n    remedy: start it again: {}", e.what(), command_again(job.out)));
    }
  }();

  for (const Summary& s : outcome.summaries) print_summary(s, options.json);
  if (outcome.stopped) {
    spdlog::warn("stopped {}; go on with\n    {}", outcome.limit_reached ? "for --max-time" : "on request",
                 resume_command(job.out));
    return outcome.limit_reached ? ExitCode::unfinished : ExitCode::interrupted;
  }
  const bool page_ok = !options.page || add_report(job.out),
             all_ok = page_ok && std::all_of(outcome.summaries.begin(), outcome.summaries.end(), all_checks_hold);
  if (!all_ok) spdlog::warn("a check failed: read the results with care");
  return all_ok ? ExitCode::ok : ExitCode::failed_checks;
}

}  // namespace railstrata
