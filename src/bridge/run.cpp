#include "bridge/functions.hpp"
#include "core/parallel.hpp"
#include "runs/folder_run.hpp"

namespace railstrata::bridge {
namespace {

/// What a run says while it lasts: its phase and how far it is, and notes.
FolderRunObserver teller(Call& call, std::vector<std::string>& notes) {
  const auto phase = [&call](const char* name) { return [&call, name] { call.tell({name, 0.0}); }; };
  FolderRunObserver observer;
  observer.meshing = phase("meshing");
  observer.preload = phase("preload");
  observer.writing = [&call] { call.tell({"writing", 1.0}); };
  observer.rolling = [&call](double fraction, const HistoryRow&) { call.tell({"rolling", fraction}); };
  observer.warn = [&notes](const std::string& text) { notes.push_back(text); };
  return observer;
}

void solve_run(Call& call, FolderRun& run) {
  std::vector<std::string> notes = run.notes;
  FemOptions options;
  options.wishes.stop = &call.stop;
  options.times.checkpoint_every = call.number("checkpoint_every");
  options.times.limit = call.number("limit");
  const RunCommand command{{"railstrata.run (Python)"}, max_threads()};
  call.answer["stopped"] = solve_in_folder(run, command, teller(call, notes), options).stopped;
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
