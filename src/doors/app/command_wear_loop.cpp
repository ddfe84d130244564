#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <nlohmann/json.hpp>

#include "app/case_of.hpp"
#include "app/commands.hpp"
#include "app/common_options.hpp"
#include "app/control.hpp"
#include "app/option_values.hpp"
#include "core/faults.hpp"
#include "fatigue/rail_damage.hpp"
#include "record/csv.hpp"
#include "record/json.hpp"
#include "record/output_file.hpp"
#include "text/units.hpp"
#include "wear/wear_loop_job.hpp"

namespace railstrata {
namespace {

double depth_option(const std::string& text) {
  const double depth = length_of("--max-wear", text);
  if (depth > 0 && depth <= kMostWearOfOneProfile) return depth;
  throw CaseError(fmt::format("--max-wear {}: must be above 0 and at most 1 mm", text), "take e.g. \"0.05 mm\"");
}

ExitCode command_wear_loop(const CommandOptions& options) {
  if (options.wear_loop.steps == 0 && options.wear_loop.passages == 0)
    throw CaseError("wear-loop: how far?", "give --steps 10, or --passages 2e6, or both");
  LoadedCase loaded = load_half_space_case_of(options);
  const WearLoopOrder order{job_order_of(options, loaded, "-wear-loop", options.wear_loop.resume),
                            options.wear_loop.steps, options.wear_loop.passages,
                            depth_option(options.wear_loop.max_wear), cell_size(options.cell)};
  return code_of(carry_out_wear_loop(std::move(loaded), order, control_by_signals(), [&](const WornRail& rail) {
    if (!options.json) return;
    const nlohmann::ordered_json end{{"steps", rail.step},
                                     {"passages", rail.passages},
                                     {"worn_area_m2", rail.area},
                                     {"rail_profile", rail.file.string()}};
    fmt::print("{}\n", json_text(end, 2));
  }));
}

void declare_wear_loop(CLI::App& sub, CommandOptions& options) {
  add_case(sub, options);
  add_output(sub, options, "results/<case name>-wear-loop");
  add_cell(sub, options);
  sub.add_option("--steps", options.wear_loop.steps, "End after so many steps")->check(CLI::Range(1, 9999));
  sub.add_option("--passages", options.wear_loop.passages, "End after so many passages of the whole collective")
      ->check(CLI::Range(1.0, 1e15))
      ->check(finite());
  sub.add_option("--max-wear", options.wear_loop.max_wear, "Depth at the deepest place in one step")
      ->capture_default_str();
  sub.add_flag("--resume", options.wear_loop.resume, "Go on with the loop of the folder where it stopped");
  add_no_report(sub, options);
}

}  // namespace

const Command kWearLoopCommand{
    "wear-loop",
    "Wear of the case's load collective taken off the rail's profile, step by step: the worn profiles, and how the "
    "contact changes",
    "Examples:\n  railstrata wear-loop cases/collective/mixed_traffic.toml --steps 10\n  railstrata wear-loop "
    "cases/collective/mixed_traffic.toml --passages 1e5 --max-wear \"0.002 mm\" --out results/worn\n  railstrata "
    "wear-loop cases/collective/mixed_traffic.toml --passages 2e5 --out results/worn --resume\n\nCtrl-C: nothing of "
    "the step under way is kept, everything before is.\n",
    declare_wear_loop, command_wear_loop};

}  // namespace railstrata
