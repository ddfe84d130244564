#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/case_of.hpp"
#include "app/commands.hpp"
#include "app/common_options.hpp"
#include "app/control.hpp"
#include "app/option_values.hpp"
#include "core/engine.hpp"
#include "core/faults.hpp"
#include "runs/pass_folder.hpp"

namespace railstrata {
namespace {

/// m; 0: chosen.
double roll_length(const PassesOptions& options) {
  if (options.wheels != "new")
    throw CaseError("--wheels same: on a short roll a wheel touches the rail at another place of its rim in every pass",
                    "--wheels new");
  return options.roll_length.empty() ? 0 : length_of("--roll-length", options.roll_length);
}

/// Options of the finite elements alone, which the stationary method would pass over in silence.
void require_stationary(const PassesOptions& options) {
  if (!options.roll_length.empty())
    throw CaseError("--roll-length: the stationary method rolls no length", "take it out, or add --engine fem");
  if (options.wheels != "new")
    throw CaseError("--wheels: the wheel of the stationary method is elastic, and the same for ever",
                    "take it out, or add --engine fem");
}

PassOrder order_of(const CommandOptions& options, const LoadedCase& loaded) {
  PassOrder order;
  static_cast<JobOrder&>(order) = job_order_of(options, loaded, "-passes", options.passes.resume);
  order.passes = options.passes.passes;
  return order;
}

ExitCode command_rolled_passes(const CommandOptions& options) {
  if (!options.cell.empty())
    throw CaseError("--cell: finite elements have no cells",
                    "take it out, and give mesh.element_size, or --engine bem");
  CommandOptions own = options;  // with run.plasticity, so that what it asks of others is checked
  own.overrides.emplace_back("run.plasticity=true");
  own.overrides.emplace_back("run.rolling=true");
  LoadedCase loaded = load_case_of(own, CaseUse::yielding);
  require_finite_elements(loaded);
  PassOrder order = order_of(options, loaded);
  order.roll_length = roll_length(options.passes);
  order.checkpoint_every = wall_time("--checkpoint-every", options.passes.checkpoint_every);
  return code_of(rolled_passes_in_folder(std::move(loaded), order, control_by_signals()).end);
}

ExitCode command_passes(const CommandOptions& options) {
  if (options.passes.engine == engine_word(Engine::fem)) return command_rolled_passes(options);
  require_stationary(options.passes);
  LoadedCase loaded = load_half_space_case_of(options, CaseUse::yielding);
  PassOrder order = order_of(options, loaded);
  order.cell = cell_size(options.cell);
  return code_of(passes_in_folder(std::move(loaded), order, control_by_signals()).end);
}

void declare_passes(CLI::App& sub, CommandOptions& options) {
  add_case(sub, options);
  add_output(sub, options, "results/<case name>-passes");
  sub.add_option("--engine", options.passes.engine, "bem: stationary method on half-spaces; fem: every pass is rolled")
      ->check(CLI::IsMember(engine_words()))
      ->capture_default_str();
  add_cell(sub, options);
  sub.add_option("--passes", options.passes.passes, "End after so many passes of a wheel, since the first one")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  sub.add_flag("--resume", options.passes.resume, "Go on with the passes of the folder: the same bits as in one go");
  add_no_report(sub, options);
  sub.add_option("--checkpoint-every", options.passes.checkpoint_every,
                 "fem: save the pass under way this often (default: \"10 min\"; 0: only when stopped)");
  sub.add_option(
      "--roll-length", options.passes.roll_length,
      "fem: rolled in a pass (default: 12 half-lengths of the patch); stations in its middle are the result");
  sub.add_option("--wheels", options.passes.wheels, "fem: of every pass: new")
      ->check(CLI::IsMember({"new", "same"}))
      ->capture_default_str();
}

}  // namespace

const Command kPassesCommand{
    "passes",
    "Wheel after wheel over a rail that yields: residual stress, plastic strain of every pass, and whether it settles "
    "or ratchets",
    "Examples:\n  railstrata passes cases/paper/base.toml --set material.rail.hardening=R260 --passes 20\n  "
    "railstrata "
    "passes cases/paper/base.toml --set material.rail.yield_strength=\"750 MPa\" --passes 200 --out "
    "results/yields\n  railstrata passes cases/paper/base.toml --set material.rail.yield_strength=\"750 MPa\" "
    "--passes 400 --out results/yields --resume\n\nCtrl-C: the pass under way is given up, those before it are kept.\n",
    declare_passes, command_passes};

}  // namespace railstrata
