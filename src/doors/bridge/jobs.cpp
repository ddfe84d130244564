// Jobs in folders: runs and passes.
#include "bridge/call.hpp"
#include "core/parallel.hpp"
#include "runs/pass_folder.hpp"
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

PassOrder order_of(const Call& call) {
  PassOrder out;
  out.folder = call.text("folder");
  out.passes = call.whole("passes");
  out.resume = call.flag("resume");
  out.force = call.flag("force");
  out.page = call.flag("page");
  out.cell = call.number("cell");
  out.roll_length = call.number("roll_length");
  out.checkpoint_every = call.number("checkpoint_every");
  out.command = {{"railstrata.passes (Python)"}, max_threads()};
  return out;
}

/// Progress: the pass under way and how far all are.
void solve_passes(Call& call) {
  const auto loaded = call.made<LoadedCase>("case");
  const PassOrder order = order_of(call);
  std::vector<std::string> notes;
  call.control.on_warning = [&notes](const std::string& text) { notes.push_back(text); };
  call.control.on_progress = [&call](const std::string&, double fraction, int pass) {
    if (pass > 0) call.report({pass, fraction});
  };
  const PassesEnd end = call.flag("rolled") ? rolled_passes_in_folder(*loaded, order, call.control)
                                            : passes_in_folder(*loaded, order, call.control);
  call.answer = {{"passes", end.passes}, {"stopped", end.end == JobEnd::stopped}, {"notes", notes}};
}

}  // namespace

Functions job_functions() { return {{"run", run_case}, {"resume", go_on}, {"passes", solve_passes}}; }

}  // namespace railstrata::bridge
