#include "bridge/functions.hpp"
#include "core/parallel.hpp"
#include "runs/run_job.hpp"

namespace railstrata::bridge {
namespace {

void carry_out(Call& call, const LoadedCase& loaded, bool resume, bool force) {
  std::vector<std::string> notes;
  call.control.on_progress = [&call](const std::string& phase, double fraction, int) {
    if (!phase.empty()) call.report({phase, fraction});
  };
  call.control.on_warning = [&notes](const std::string& text) { notes.push_back(text); };
  FemOptions options;
  options.times.checkpoint_every = call.number("checkpoint_every");
  options.times.limit = call.number("limit");
  const JobOrder order{call.text("folder"), resume, force, false, {{"railstrata.run (Python)"}, max_threads()}};
  const JobEnd end = RunJob(loaded, order, options, call.control).carry_out();
  call.answer["stopped"] = end == JobEnd::stopped || end == JobEnd::out_of_time;
  call.answer["notes"] = notes;
}

void run_case(Call& call) { carry_out(call, *call.made<LoadedCase>("case"), false, call.flag("force")); }
void go_on(Call& call) { carry_out(call, case_to_resume(call.text("folder")), true, false); }

}  // namespace

Functions run_functions() { return {{"run", run_case}, {"resume", go_on}}; }

}  // namespace railstrata::bridge
