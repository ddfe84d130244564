#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <utility>

#include "app/case_of.hpp"
#include "app/common_options.hpp"
#include "app/control.hpp"
#include "app/mpi_ranks.hpp"
#include "app/processors.hpp"
#include "app/summary_text.hpp"
#include "runs/run_job.hpp"

namespace railstrata {
namespace {

struct RunOptions {
  std::filesystem::path resume;             ///< --resume: a result folder with a checkpoint
  std::string checkpoint_every = "10 min";  ///< --checkpoint-every: a wall time
  std::string max_time = "never";           ///< --max-time: a wall time
};

// Throws CaseError for what does not go together with --resume.
void require_resume_alone(const CommandOptions& options) {
  if (!options.case_file.empty() || !options.overrides.empty() || !options.out.empty() || options.force)
    throw CaseError("--resume goes on with the run of a folder as it was begun",
                    "leave out the case, --set, --out and --force; another case is another run");
}

void report_residual(const RunResidual& residual) {
  spdlog::info("{}", describe(residual));
  if (const std::string doubt = doubt_of(residual); !doubt.empty()) spdlog::warn("{}", doubt);
}

void warn_of_shared_processors(int threads) {
  if (const std::string many = oversubscription(threads); !many.empty()) spdlog::warn("{}", many);
  if (const std::string busy = competition(threads); !busy.empty()) spdlog::info("{}", busy);
}

// Runs on ranks other than 0: no output.
ExitCode run_along(const std::filesystem::path& resumed, const CommandOptions& options, const FemOptions& fem) {
  spdlog::set_level(spdlog::level::off);
  follow_run(resumed.empty() ? load_case_of(options, uses::kFiniteElements) : load_case(resumed / "case.toml"), resumed,
             fem);
  return ExitCode::ok;
}

ExitCode run_and_report(const std::filesystem::path& resumed, const CommandOptions& options, const FemOptions& fem) {
  const bool resume = !resumed.empty();
  LoadedCase loaded = resume ? case_to_resume(resumed) : load_case_of(options, uses::kFiniteElements);
  const JobOrder order = job_order_of(options, resume ? resumed : output_folder_of(options, loaded), resume);
  RunJob job(std::move(loaded), order, fem, control());
  warn_of_shared_processors(options.threads);
  const auto show = [&] {
    for (const Summary& s : job.summaries()) print_summary(s, options.json);
    if (job.residual()) report_residual(*job.residual());
  };
  const JobEnd end = job.carry_out(show);
  if (end == JobEnd::failed_checks) spdlog::warn("a check failed: read the results with care");
  if (end == JobEnd::stopped || end == JobEnd::out_of_time) show();
  return code_of(end);
}

ExitCode command_run(const RunOptions& own, const CommandOptions& options) {
  FemOptions fem;
  fem.control = &control_by_signals();
  fem.times.checkpoint_every = wall_time("--checkpoint-every", own.checkpoint_every);
  fem.times.limit = wall_time("--max-time", own.max_time);
  if (own.resume.empty() && options.case_file.empty())
    throw CaseError("run: no case was named",
                    "name a case file, or go on with an interrupted run: railstrata run --resume FOLDER");
  if (!own.resume.empty()) require_resume_alone(options);
  MpiRanks mpi;
  fem.ranks = mpi.ranks();
  try {
    if (mpi.any_asked(fem.control->stop)) throw Interrupted("stopped before the run began; nothing was written");
    const ExitCode code =
        fem.ranks.is_root() ? run_and_report(own.resume, options, fem) : run_along(own.resume, options, fem);
    mpi.leave();
    return code;
  } catch (const EnvironmentError&) {  // of this rank, or what it saw of another
    throw;
  } catch (...) {
    mpi.wait_for_rank_0();
    throw;
  }
}

CommandWork declare_run(CLI::App& sub, CommandOptions& options) {
  const auto own = std::make_shared<RunOptions>();
  add_case(sub, options);
  add_output(sub, options, "results/<case name>");
  sub.get_option("case")->required(false);
  sub.add_option("--resume", own->resume,
                 "Go on with the interrupted run of this result folder: the same bits as in one go")
      ->type_name("FOLDER");
  sub.add_option("--checkpoint-every", own->checkpoint_every,
                 "Wall time between checkpoints (default: \"10 min\"; 0: only when stopped)");
  sub.add_option("--max-time", own->max_time,
                 "Stop in time for a batch limit, with a checkpoint: \"110 min\" (exit code 5)");
  add_no_report(sub, options);
  return [own, &options] { return command_run(*own, options); };
}

}  // namespace

extern const Command kRunCommand{
    "run", "Run a case: static preload, rolling, results",
    "Examples:\n  railstrata run cases/quick\n  railstrata run cases/paper/base.toml --threads 4 --out results/base\n "
    " railstrata run cases/quick --set layer.0.thickness=\"1 mm\" --out results/thin\n"
    "  railstrata run cases/paper/base.toml --max-time \"110 min\"; railstrata run --resume results/base\n\n"
    "Ctrl-C, SIGTERM: finish the step, write a checkpoint, print how to go on (a second one quits at once). SIGUSR1: "
    "write a checkpoint, go on.\n",
    declare_run, true};

}  // namespace railstrata
