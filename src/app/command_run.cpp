#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <optional>

#include "app/commands.hpp"
#include "app/processors.hpp"
#include "app/progress.hpp"
#include "app/summary_text.hpp"
#include "core/shell_word.hpp"
#include "io/provenance.hpp"
#include "model/model.hpp"
#include "runs/output_folder.hpp"
#include "runs/run_fem.hpp"
#include "runs/stop_flag.hpp"
#include "runs/write_report.hpp"

namespace railstrata {
namespace {

// One bar or line of progress per phase.
class PhaseReport {
 public:
  explicit PhaseReport(bool shown) : shown_(shown) {}
  void operator()(const std::string& phase, double fraction, const std::string& detail) {
    if (phase == "warning" || phase == "checkpoint") {
      if (bar_) bar_->clear();
      if (phase == "warning")
        spdlog::warn("{}", detail);
      else
        spdlog::info("checkpoint at {}", detail);
      return;
    }
    if (phase != phase_) {
      phase_ = phase;
      bar_.reset();
      if (phase == "rolling")
        bar_.emplace("rolling", shown_);
      else if (phase != "results")
        spdlog::info("{}", phase == "mesh" ? "meshing wheel and rail" : "static preload");
    }
    if (bar_) bar_->update(fraction);
    if (!detail.empty()) spdlog::debug("{}: {}", phase, detail);
  }

 private:
  bool shown_;
  std::string phase_;
  std::optional<Progress> bar_;
};

// The case of the folder, as it was run.
LoadedCase case_of_folder(const CommandOptions& options) {
  if (!options.case_file.empty() || !options.overrides.empty() || !options.out.empty() || options.force)
    throw CaseError("--resume goes on with the run of a folder as it was begun",
                    "leave out the case, --set, --out and --force; another case is another run");
  if (!std::filesystem::is_directory(options.resume))
    throw CaseError(fmt::format("--resume {}: there is no such folder", options.resume.string()),
                    "name the result folder of a run that was interrupted");
  if (std::filesystem::exists(options.resume / "summary.json") &&
      !std::filesystem::exists(checkpoint_file(options.resume)) &&
      !std::filesystem::exists(previous_checkpoint_file(options.resume)))
    throw CaseError(fmt::format("there is nothing to resume: {} holds a finished run", options.resume.string()),
                    "start another with `railstrata run CASE`");
  return load_case(options.resume / "case.toml");
}

std::string resume_command(const std::filesystem::path& folder) {
  return fmt::format("railstrata run --resume {}", shell_word(folder.string()));
}

// What can be done once the machine lets us write again.
std::string how_to_go_on(const std::filesystem::path& folder) {
  const bool kept =
      std::filesystem::exists(checkpoint_file(folder)) || std::filesystem::exists(previous_checkpoint_file(folder));
  return kept ? fmt::format(", then go on with\n    {}", resume_command(folder))
              : std::string(", then start the run again with --force");
}

}  // namespace

ExitCode command_run(const CommandOptions& options) {
  stop_flag();  // from here on a signal is a wish
  FemRequest request;
  request.times = {wall_time("--checkpoint-every", options.checkpoint_every),
                   wall_time("--max-time", options.max_time)};
  const bool resuming = !options.resume.empty();
  if (!resuming && options.case_file.empty())
    throw CaseError("case is required",
                    "name a case file, or go on with an interrupted run: railstrata run --resume FOLDER");
  const LoadedCase loaded = resuming ? case_of_folder(options) : load_case_of(options);
  const std::filesystem::path out = resuming ? options.resume : output_folder_of(options, loaded);
  request.case_sha256 = resuming ? identity_in_folder(out, loaded) : case_identity(loaded);
  request.program = version_text();
  request.provenance = table_origin(loaded);
  std::optional<FolderHold> hold;
  if (resuming) {
    hold.emplace(out);
    FoundCheckpoint found = read_checkpoint(out, request.case_sha256);
    for (const std::string& note : found.notes) spdlog::warn("{}; the checkpoint before it is taken", note);
    if (found.checkpoint.origin.program != request.program)
      spdlog::warn(
          "the run was begun by RailStrata {}, this is {}: it goes on, but not with the bits of a run in one go",
          found.checkpoint.origin.program, request.program);
    remove_abandoned_parts(out);
    request.provenance = found.checkpoint.origin.provenance;
    spdlog::info("{}: goes on in {} at x = {:.2f} mm, t = {:.4g} ms", loaded.spec.title, out.string(),
                 1e3 * found.checkpoint.run.stepper.state.axle.x, 1e3 * found.checkpoint.run.stepper.state.time);
    request.resume = std::move(found.checkpoint.run);
  } else {
    place(loaded.spec, loaded.folder());  // faults of the input before a folder is made
    require_apart(out, loaded);
    hold.emplace(prepare_output_folder(out, options.force));
    request.begin = [&] {
      clear_old_results(out);
      write_origin(out, loaded, options.command_line, options.threads);
    };
    spdlog::info("{}: results go to {}", loaded.spec.title, out.string());
  }

  if (const std::string many = oversubscription(options.threads); !many.empty()) spdlog::warn("{}", many);
  if (const std::string busy = competition(options.threads); !busy.empty()) spdlog::info("{}", busy);

  request.spec = loaded.spec;
  request.case_folder = loaded.folder();
  request.out = out;
  request.commit = commit_text();
  request.threads = options.threads;
  PhaseReport report(spdlog::default_logger()->level() <= spdlog::level::info);
  request.report = std::ref(report);
  const FemOutcome outcome = [&] {
    try {
      return run_fem(request);
    } catch (EnvironmentError& e) {
      if (!e.remedy.empty()) e.remedy += how_to_go_on(out);
      throw;
    }
  }();

  for (const Summary& s : outcome.summaries) print_summary(s, options.json);
  if (outcome.stopped) {
    spdlog::warn("stopped {}; go on with\n    {}", outcome.limit_reached ? "for --max-time" : "on request",
                 resume_command(out));
    return outcome.limit_reached ? ExitCode::unfinished : ExitCode::interrupted;
  }
  if (options.report) add_report(out, options.threads);
  const bool all_ok = std::all_of(outcome.summaries.begin(), outcome.summaries.end(), all_checks_hold);
  if (!all_ok) spdlog::warn("a check failed: read the results with care");
  return all_ok ? ExitCode::ok : ExitCode::failed_checks;
}

}  // namespace railstrata
