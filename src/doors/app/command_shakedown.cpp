#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "app/case_of.hpp"
#include "app/commands.hpp"
#include "app/common_options.hpp"
#include "core/engine.hpp"
#include "core/faults.hpp"
#include "fatigue/row_strength.hpp"

namespace railstrata {
namespace {

/// The theorems of shakedown judge elastic stresses.
void require_elastic_run(const LoadedCase& loaded) {
  if (!loaded.spec.run.plasticity) return;
  throw CaseError("shakedown is judged by the elastic stresses of a case, and run.plasticity = true asks for others",
                  "leave run.plasticity out; `railstrata run` follows yielding itself", loaded.file.string());
}

/// Without a strength there is nothing to hold the stresses against.
void require_strength(const LoadedCase& loaded) {
  if (strength_to_judge(loaded.spec)) return;
  const bool both = loaded.spec.run.judged == JudgedBodies::both;
  throw CaseError(both ? "the case gives no strength of rail, wheel or layers"
                       : "the case gives no strength of the body that run.judged names, nor of its layers",
                  "give yield_strength = \"500 MPa\", or grade = \"R260\", in [material.rail], [material.wheel] or a "
                  "[[layer]]",
                  loaded.file.string());
}

ExitCode command_shakedown(const CommandOptions& options) {
  const LoadedCase loaded = load_case_of(options);
  require_strength(loaded);
  if (options.shakedown.engine == "fem") {
    require_elastic_run(loaded);
    if (!options.cell.empty())
      throw CaseError("--cell: finite elements have no cells",
                      "take it out, and give mesh.element_size, or --engine bem");
  }
  CommandOptions solve = options;
  solve.out = output_folder_of(options, loaded, "-shakedown");
  solve.shakedown.maps = true;
  return options.shakedown.engine == "fem" ? command_run(solve) : command_bem(solve);
}

void declare_shakedown(CLI::App& sub, CommandOptions& options) {
  add_case(sub, options);
  add_output(sub, options, "results/<case name>-shakedown");
  sub.add_option("--engine", options.shakedown.engine, fmt::format("Where the stresses come from: {}", engines_text()))
      ->check(CLI::IsMember(engine_words()))
      ->capture_default_str();
  add_cell(sub, options);
  add_no_report(sub, options);
}

}  // namespace

const Command kShakedownCommand{
    "shakedown",
    "Does it last? Load factors to first yield and to shakedown, by layer, and the strength that every depth asks for",
    "Examples:\n  railstrata shakedown cases/paper/base.toml --set material.rail.grade=R260\n  railstrata shakedown "
    "cases/quick --set material.rail.yield_strength=\"480 MPa\" --set layer.0.yield_strength=\"900 MPa\" --engine fem "
    "--out results/quick-shakedown\n",
    declare_shakedown, command_shakedown};

}  // namespace railstrata
