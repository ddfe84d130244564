#include <CLI/CLI.hpp>

#include <memory>

#include "app/case_of.hpp"
#include "app/common_options.hpp"
#include "app/control.hpp"
#include "core/engine.hpp"
#include "core/faults.hpp"
#include "runs/pass_folder.hpp"

namespace railstrata {
namespace {

struct PassesOptions {
  std::string engine = "bem";               ///< --engine
  int passes = 20;                          ///< --passes, since the first one
  bool resume = false;                      ///< --resume
  std::string checkpoint_every = "10 min";  ///< --checkpoint-every: a wall time; fem
  std::string roll_length;                  ///< --roll-length: a length; empty: chosen; fem
};

/// m; 0: chosen.
double roll_length(const PassesOptions& options) {
  return options.roll_length.empty() ? 0 : length_of("--roll-length", options.roll_length);
}

/// Options of the finite elements alone, which the stationary method would pass over in silence.
void require_stationary(const PassesOptions& options) {
  if (!options.roll_length.empty())
    throw CaseError("--roll-length: the stationary method rolls no length", "take it out, or add --engine fem");
}

PassOrder order_of(const PassesOptions& own, const CommandOptions& options, const LoadedCase& loaded) {
  PassOrder order;
  static_cast<JobOrder&>(order) = job_order_of(options, output_folder_of(options, loaded, "-passes"), own.resume);
  order.passes = own.passes;
  return order;
}

ExitCode command_rolled_passes(const PassesOptions& own, const CommandOptions& options) {
  if (!options.cell.empty())
    throw CaseError("--cell: finite elements have no cells",
                    "take it out, and give mesh.element_size, or --engine bem");
  CommandOptions plastic = options;  // with run.plasticity, so that what it asks of others is checked
  plastic.overrides.emplace_back("run.plasticity=true");
  plastic.overrides.emplace_back("run.rolling=true");
  LoadedCase loaded = load_case_of(plastic, uses::kRolledPasses);
  PassOrder order = order_of(own, options, loaded);
  order.roll_length = roll_length(own);
  order.checkpoint_every = wall_time("--checkpoint-every", own.checkpoint_every);
  return code_of(rolled_passes_in_folder(std::move(loaded), order, control_by_signals()).end);
}

ExitCode command_passes(const PassesOptions& own, const CommandOptions& options) {
  if (own.engine == engine_word(Engine::fem)) return command_rolled_passes(own, options);
  require_stationary(own);
  LoadedCase loaded = load_case_of(options, uses::kPasses);
  PassOrder order = order_of(own, options, loaded);
  order.cell = cell_size(options.cell);
  return code_of(passes_in_folder(std::move(loaded), order, control_by_signals()).end);
}

CommandWork declare_passes(CLI::App& sub, CommandOptions& options) {
  const auto own = std::make_shared<PassesOptions>();
  add_case(sub, options);
  add_output(sub, options, "results/<case name>-passes");
  sub.add_option("--engine", own->engine, "bem: stationary method on half-spaces; fem: every pass is rolled")
      ->check(CLI::IsMember({engine_word(Engine::bem), engine_word(Engine::fem)}))
      ->capture_default_str();
  add_cell(sub, options);
  sub.add_option("--passes", own->passes, "End after so many passes of a wheel, since the first one")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  sub.add_flag("--resume", own->resume, "Go on with the passes of the folder: the same bits as in one go");
  add_no_report(sub, options);
  sub.add_option("--checkpoint-every", own->checkpoint_every,
                 "fem: save the pass under way this often (default: \"10 min\"; 0: only when stopped)");
  sub.add_option(
      "--roll-length", own->roll_length,
      "fem: rolled in a pass (default: 12 half-lengths of the patch); stations in its middle are the result");
  return [own, &options] { return command_passes(*own, options); };
}

}  // namespace

extern const Command kPassesCommand{
    "passes",
    "Wheel after wheel over a rail that yields: residual stress, plastic strain of every pass, and whether it settles "
    "or ratchets",
    "Examples:\n  railstrata passes cases/paper/base.toml --set material.rail.hardening=R260 --passes 20\n  "
    "railstrata "
    "passes cases/paper/base.toml --set material.rail.yield_strength=\"750 MPa\" --passes 200 --out "
    "results/yields\n  railstrata passes cases/paper/base.toml --set material.rail.yield_strength=\"750 MPa\" "
    "--passes 400 --out results/yields --resume\n\nCtrl-C: the pass under way is given up, those before it are kept.\n",
    declare_passes};

}  // namespace railstrata
