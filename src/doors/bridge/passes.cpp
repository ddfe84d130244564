#include "bridge/functions.hpp"
#include "core/parallel.hpp"
#include "runs/pass_folder.hpp"

namespace railstrata::bridge {
namespace {

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

Functions pass_functions() { return {{"passes", solve_passes}}; }

}  // namespace railstrata::bridge
