#include "bridge/functions.hpp"
#include "core/parallel.hpp"
#include "runs/folder_run.hpp"

namespace railstrata::bridge {
namespace {

void solve_run(Call& call, FolderRun& run) {
  std::vector<std::string> notes = run.notes;
  call.control.on_progress = [&call](const std::string& phase, double fraction, int) { call.tell({phase, fraction}); };
  call.control.on_warning = [&notes](const std::string& text) { notes.push_back(text); };
  FemOptions options;
  options.control = &call.control;
  options.times.checkpoint_every = call.number("checkpoint_every");
  options.times.limit = call.number("limit");
  const RunCommand command{{"railstrata.run (Python)"}, max_threads()};
  call.answer["stopped"] = solve_in_folder(run, command, options).stopped;
  call.answer["notes"] = notes;
}

void run_case(Call& call) {
  FolderRun run = begin_run(*call.made<LoadedCase>("case"), call.text("folder"), call.flag("force"));
  solve_run(call, run);
}

void go_on(Call& call) {
  FolderRun run = resume_run(call.text("folder"));
  solve_run(call, run);
}

}  // namespace

Functions run_functions() { return {{"run", run_case}, {"resume", go_on}}; }

}  // namespace railstrata::bridge
