#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <optional>
#include <utility>

#include "app/case_of.hpp"
#include "app/commands.hpp"
#include "app/common_options.hpp"
#include "app/control.hpp"
#include "app/mpi_ranks.hpp"
#include "app/option_values.hpp"
#include "app/processors.hpp"
#include "app/summary_text.hpp"
#include "runs/folder_run.hpp"
#include "runs/ranked_run.hpp"
#include "runs/write_report.hpp"

namespace railstrata {
namespace {

// Throws CaseError for what does not go together with --resume.
void require_resume_alone(const CommandOptions& options) {
  if (!options.case_file.empty() || !options.overrides.empty() || !options.out.empty() || options.force)
    throw CaseError("--resume goes on with the run of a folder as it was begun",
                    "leave out the case, --set, --out and --force; another case is another run");
}

FolderRun resumed_run(const CommandOptions& options, const Ranks& ranks) {
  require_resume_alone(options);
  FolderRun run = resume_run(options.run.resume, ranks);
  for (const std::string& note : run.notes) spdlog::warn("{}", note);
  const auto& begun = run.begun->stepper.state;
  spdlog::info("{}: goes on in {} at x = {:.2f} mm, t = {:.4g} ms", run.loaded.spec.title, run.folder.string(),
               1e3 * begun.axle.x, 1e3 * begun.time);
  return run;
}

FolderRun new_run(const CommandOptions& options, const Ranks& ranks) {
  LoadedCase loaded = load_case_of(options);
  const std::filesystem::path out = output_folder_of(options, loaded);
  FolderRun run = begin_run(std::move(loaded), out, options.force, ranks);
  spdlog::info("{}: results go to {}", run.loaded.spec.title, out.string());
  return run;
}

/// What is left of a solution when its files are written.
struct RunOutcome {
  std::vector<Summary> summaries;
  bool stopped = false, limit_reached = false;
  std::optional<RunResidual> residual;
};

RunOutcome solve_and_write(FolderRun& run, const CommandOptions& options, const FemOptions& fem) {
  const FemSolution solution = solve_in_folder(run, {options.command_line, options.threads}, fem);
  RunOutcome out{{}, solution.stopped, solution.limit_reached, solution.residual};
  for (const FemPosition& position : solution.positions) out.summaries.push_back(position.summary);
  return out;
}

void report_residual(const RunResidual& residual) {
  spdlog::info("{}", words_of(residual));
  if (const std::string doubt = doubt_of(residual); !doubt.empty()) spdlog::warn("{}", doubt);
}

void warn_of_shared_processors(int threads) {
  if (const std::string many = oversubscription(threads); !many.empty()) spdlog::warn("{}", many);
  if (const std::string busy = competition(threads); !busy.empty()) spdlog::info("{}", busy);
}

// What of the ranks is not 0: silent.
ExitCode run_along(const CommandOptions& options, const FemOptions& fem) {
  spdlog::set_level(spdlog::level::off);
  if (!options.run.resume.empty()) require_resume_alone(options);
  RankedRun run = options.run.resume.empty() ? join_run(load_case_of(options), fem.ranks)
                                             : join_resumed_run(options.run.resume, fem.ranks);
  follow_run(run, fem);
  return ExitCode::ok;
}

ExitCode run_and_speak(const CommandOptions& options, const FemOptions& fem);

}  // namespace

ExitCode command_run(const CommandOptions& options) {
  FemOptions fem;
  fem.control = &control_by_signals();
  fem.times.checkpoint_every = wall_time("--checkpoint-every", options.run.checkpoint_every);
  fem.times.limit = wall_time("--max-time", options.run.max_time);
  if (options.run.resume.empty() && options.case_file.empty())
    throw CaseError("run: no case was named",
                    "name a case file, or go on with an interrupted run: railstrata run --resume FOLDER");
  MpiRanks mpi;
  fem.ranks = mpi.ranks();
  try {
    if (mpi.any_asked(fem.control->stop)) throw Interrupted("stopped before the run began; nothing was written");
    const ExitCode code = fem.ranks.speaks() ? run_and_speak(options, fem) : run_along(options, fem);
    mpi.leave();
    return code;
  } catch (const EnvironmentError&) {  // of this rank, or what it saw of another
    throw;
  } catch (...) {
    mpi.let_rank_0_speak();
    throw;
  }
}

namespace {

ExitCode run_and_speak(const CommandOptions& options, const FemOptions& fem) {
  FolderRun run = options.run.resume.empty() ? new_run(options, fem.ranks) : resumed_run(options, fem.ranks);
  warn_of_shared_processors(options.threads);
  const RunOutcome outcome = solve_and_write(run, options, fem);

  for (const Summary& s : outcome.summaries) print_summary(s, options.json);
  if (outcome.residual) report_residual(*outcome.residual);
  if (outcome.stopped) {
    spdlog::warn("stopped {}; go on with\n    {}", outcome.limit_reached ? "for --max-time" : "on request",
                 resume_command(run.folder));
    return outcome.limit_reached ? ExitCode::unfinished : ExitCode::interrupted;
  }
  const bool page_ok = !options.page || add_report(run.folder, control()),
             all_ok = page_ok && std::all_of(outcome.summaries.begin(), outcome.summaries.end(), all_checks_hold);
  if (!all_ok) spdlog::warn("a check failed: read the results with care");
  return all_ok ? ExitCode::ok : ExitCode::failed_checks;
}

}  // namespace
namespace {

void declare_run(CLI::App& sub, CommandOptions& options) {
  add_case_and_output(sub, options);
  sub.get_option("case")->required(false);
  sub.add_option("--resume", options.run.resume,
                 "Go on with the interrupted run of this result folder: the same bits as in one go")
      ->type_name("FOLDER");
  sub.add_option("--checkpoint-every", options.run.checkpoint_every,
                 "Wall time between checkpoints (default: \"10 min\"; 0: only when stopped)");
  sub.add_option("--max-time", options.run.max_time,
                 "Stop in time for a batch limit, with a checkpoint: \"110 min\" (exit code 5)");
  add_no_report(sub, options);
}

}  // namespace

const Command kRunCommand{
    "run",
    "Run a case: static preload, rolling, results",
    "Examples:\n  railstrata run cases/quick\n  railstrata run cases/paper/base.toml --threads 4 --out results/base\n "
    " railstrata run cases/quick --set layer.0.thickness=\"1 mm\" --out results/thin\n"
    "  railstrata run cases/paper/base.toml --max-time \"110 min\"; railstrata run --resume results/base\n\n"
    "Ctrl-C, SIGTERM: finish the step, write a checkpoint, say how to go on (a second one quits at once). SIGUSR1: "
    "write a checkpoint, go on.\n",
    declare_run,
    command_run,
    true};

}  // namespace railstrata
