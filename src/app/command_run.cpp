#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <optional>

#include "app/commands.hpp"
#include "app/output_folder.hpp"
#include "app/processors.hpp"
#include "app/progress.hpp"
#include "app/run_fem.hpp"
#include "app/stop_flag.hpp"
#include "app/summary_text.hpp"
#include "app/write_report.hpp"
#include "io/provenance.hpp"
#include "io/summary_json.hpp"
#include "model/model.hpp"

namespace railstrata {
namespace {

// One bar or line of progress per phase.
class PhaseReport {
 public:
  explicit PhaseReport(bool shown) : shown_(shown) {}
  void operator()(const std::string& phase, double fraction, const std::string& detail) {
    if (phase != phase_) {
      phase_ = phase;
      bar_.reset();
      if (phase == "rolling") bar_.emplace("rolling", shown_);
      else if (phase != "results") spdlog::info("{}", phase == "mesh" ? "meshing wheel and rail" : "static preload");
    }
    if (bar_) bar_->update(fraction);
    if (!detail.empty()) spdlog::debug("{}: {}", phase, detail);
  }

 private:
  bool shown_;
  std::string phase_;
  std::optional<Progress> bar_;
};

}  // namespace

ExitCode command_run(const CommandOptions& options) {
  const LoadedCase loaded = load_case_of(options);
  const std::filesystem::path out = output_folder_of(options, loaded);
  place(loaded.spec, loaded.folder());  // faults of the input before a folder is made
  prepare_output_folder(out, options.force);
  write_origin(out, loaded, options.command_line, options.threads);
  spdlog::info("{}: results go to {}", loaded.spec.title, out.string());

  if (const std::string many = oversubscription(options.threads); !many.empty()) spdlog::warn("{}", many);
  if (const std::string busy = competition(options.threads); !busy.empty()) spdlog::info("{}", busy);

  FemRequest request;
  request.spec = loaded.spec;
  request.case_folder = loaded.folder();
  request.out = out;
  request.provenance = table_origin(loaded);
  request.commit = commit_text();
  request.threads = options.threads;
  PhaseReport report(spdlog::default_logger()->level() <= spdlog::level::info);
  request.report = std::ref(report);
  request.stop = &stop_flag();
  const FemOutcome outcome = run_fem(request);

  for (const Summary& s : outcome.summaries) {
    if (options.json) fmt::print("{}\n", summary_json(s).dump(2));
    else fmt::print("{}", summary_text(s));
  }
  if (outcome.stopped) {
    spdlog::warn("stopped before the last wanted position; {} holds the history so far", out.string());
    return ExitCode::interrupted;
  }
  if (options.report) add_report(out, options.threads);
  const bool all_ok = std::all_of(outcome.summaries.begin(), outcome.summaries.end(), all_checks_hold);
  if (!all_ok) spdlog::warn("a check failed: read the results with care");
  return all_ok ? ExitCode::ok : ExitCode::failed_checks;
}

}  // namespace railstrata
