#include "app/program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <new>
#include <system_error>

#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/mpi_ranks.hpp"
#include "app/processors.hpp"
#include "app/reference_commands.hpp"
#include "app/surroundings.hpp"
#include "app/usage.hpp"
#include "core/engine.hpp"
#include "core/nearest_word.hpp"
#include "core/parallel.hpp"
#include "core/printable.hpp"
#include "io/json_text.hpp"
#include "io/provenance.hpp"

namespace railstrata {
namespace {

/// "fem (finite elements: …), bem (…)".
std::string engines_text() {
  std::string out;
  for (const EngineRow& row : kEngines)
    out += fmt::format("{}{} ({}: {})", out.empty() ? "" : ", ", row.word, row.title, row.about);
  return out;
}

using Command = ExitCode (*)(const CommandOptions&);

/// An option that is written again for each further value.
CLI::Option* add_repeated(CLI::App& sub, const std::string& name, std::vector<std::string>& values, const char* word,
                          const char* what) {
  return sub.add_option(name, values, what)->allow_extra_args(false)->option_text(word);
}

void add_set(CLI::App& sub, CommandOptions& options, const char* what) {
  add_repeated(sub, "--set", options.overrides, "KEY=VALUE", what);
}

void add_case(CLI::App& sub, CommandOptions& options) {
  sub.add_option("case", options.case_file, "Case file, or a folder with case.toml")->required();
  add_set(sub, options, "Override a key: --set mesh.element_size=\"2 mm\"; once for each key");
}

/// `--out ""` is an empty variable of a script; the folder that is taken without --out is not meant.
CLI::Option* add_out(CLI::App& sub, CommandOptions& options, const std::string& what) {
  return sub.add_option("-o,--out", options.out, what)
      ->check(
          CLI::Validator([](const std::string& text) { return std::string(text.empty() ? "names nothing" : ""); }, ""));
}

void add_output(CLI::App& sub, CommandOptions& options, const char* preset) {
  add_out(sub, options, fmt::format("Folder for the results (default: {})", preset));
  sub.add_flag("--force", options.force, "Write into a folder that is not empty; files of the same name are replaced");
}

void add_case_and_output(CLI::App& sub, CommandOptions& options) {
  add_case(sub, options);
  add_output(sub, options, "results/<case name>");
}

void add_no_report(CLI::App& sub, CommandOptions& options) {
  sub.add_flag_callback(
      "--no-report", [&options] { options.page = false; }, "Do not write report.html");
}

void add_run(CLI::App& sub, CommandOptions& options) {
  add_case_and_output(sub, options);
  sub.get_option("case")->required(false);
  sub.add_option("--resume", options.run.resume,
                 "Go on with the interrupted run of this result folder: the same bits as in one go")
      ->type_name("FOLDER");
  sub.add_option("--checkpoint-every", options.run.checkpoint_every,
                 "Wall time between checkpoints (default: \"10 min\"; 0: only when stopped)");
  sub.add_option("--max-time", options.run.max_time,
                 "Stop in time for a batch limit, with a checkpoint: \"110 min\" (exit code 5)");
  add_no_report(sub, options);
}

void add_demo(CLI::App& sub, CommandOptions& options) {
  add_output(sub, options, "results/quick");
  add_set(sub, options, "Override a key of the case; once for each key");
  add_no_report(sub, options);
}

void add_cell(CLI::App& sub, CommandOptions& options) {
  sub.add_option("--cell", options.cell, "Cells of the potential contact area (default: \"0.25 mm\")");
}

void add_bem(CLI::App& sub, CommandOptions& options) {
  add_case(sub, options);
  add_output(sub, options, "results/<case name>-bem");
  add_cell(sub, options);
  sub.add_flag_callback(
      "--no-single-track", [&options] { options.shakedown.single_track = false; },
      "Of shakedown leave out the limit for one track, which takes some seconds");
  add_no_report(sub, options);
}

/// CLI::Range takes what is no number.
CLI::Validator finite() {
  return {[](const std::string& text) {
            return std::isfinite(std::strtod(text.c_str(), nullptr)) ? std::string() : text + " is no finite number";
          },
          "FINITE"};
}

void add_creep_curve(CLI::App& sub, CommandOptions& options) {
  add_case(sub, options);
  add_output(sub, options, "results/<case name>-creep-curve");
  add_cell(sub, options);
  sub.add_option(
         "--of", options.creep_curve.of,
         "What varies: creepage (longitudinal, default), lateral_creepage or spin; the rest is as the case says")
      ->check(CLI::IsMember(creep_curve_words()));
  sub.add_option("--largest", options.creep_curve.largest, "Largest creepage (default: 0.02), or spin in 1/m (5)")
      ->check(CLI::Range(1e-6, 1000.0))
      ->check(finite());
  sub.add_option("--points", options.creep_curve.points,
                 "Creepages, spaced geometrically over two and a half decades (default: 21)")
      ->check(CLI::Range(2, 1000));
  sub.add_flag("--both-sides", options.creep_curve.both_sides,
               "The curve through zero: driving and braking, slip to the gauge and to the field side");
  add_no_report(sub, options);
}

void add_creep_table(CLI::App& sub, CommandOptions& options) {
  add_case(sub, options);
  add_output(sub, options, "results/<case name>-creep-table");
  add_cell(sub, options);
  add_repeated(sub, "--axis", options.creep_table.axes, "WORD=VALUES",
               "An axis: creepage_x, creepage_y, spin, load, friction, lateral_shift, yaw or a key of the case; values "
               "\"v1,v2,...\", \"from:to:count\" or, dense about 0, \"+-largest:count\"")
      ->required();
  sub.add_option("--places", options.creep_table.places,
                 "Places where interpolation is compared with a solution (default: 200; 0: none)")
      ->check(CLI::Range(0, 100'000));
  sub.add_flag("--resume", options.creep_table.resume, "Go on with a table that was stopped");
}

void add_usetab(CLI::App& sub, CommandOptions& options) {
  add_output(sub, options, "results/usetab");
  sub.add_option("--cells", options.usetab_cells, "Cells along either axis of the ellipse (default: 20)")
      ->check(CLI::Range(6, 100));
}

void add_sweep(CLI::App& sub, CommandOptions& options) {
  add_case(sub, options);
  add_output(sub, options, "results/<case name>-sweep");
  add_cell(sub, options);
  add_repeated(
      sub, "--vary", options.sweep.vary, "KEY=VALUES",
      "A key and its values: --vary layer.0.young_ratio=0.5,1,2; once for each key: every combination is solved")
      ->required();
  sub.add_flag("--stresses", options.sweep.stresses,
               "Largest stresses in the rail too (takes longer than the contact)");
  add_no_report(sub, options);
}

void add_collective(CLI::App& sub, CommandOptions& options) {
  add_case(sub, options);
  add_output(sub, options, "results/<case name>-collective");
  add_cell(sub, options);
  add_no_report(sub, options);
}

void add_wear_loop(CLI::App& sub, CommandOptions& options) {
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

void add_study(CLI::App& sub, CommandOptions& options) {
  sub.add_option("study", options.case_file, "Study file, or a folder with study.toml")->required();
  add_set(sub, options, "Override a key in all cases: --set mesh.element_size=\"2 mm\"; once for each key");
  add_out(
      sub, options,
      "Folder for the results (default: results/<study name>); a study that is there already goes on where it stopped");
  sub.add_flag("--force", options.force, "Write into a folder that is not empty and holds no study");
  sub.add_option("--jobs", options.study.jobs, "Cases at a time; they share the threads (default: one thread a case)")
      ->check(CLI::Range(1, 1024));
  sub.add_option("--engine", options.study.engine, fmt::format("Only the cases of one engine: {}", engines_text()))
      ->check(CLI::IsMember(engine_words()));
  add_repeated(sub, "--group", options.study.groups, "NAME", "Only the cases of this group; once for each group");
  sub.add_option("--shard", options.study.shard,
                 "i/n: only every n-th case from the i-th on, for n machines that share the folder");
  auto* list = sub.add_flag("--list", options.study.list,
                            "List the cases with index, state and estimates of time and memory; compute nothing. With "
                            "--json also key and command");
  sub.add_option("--batch", options.study.batch,
                 "Print a job script for the cases to do, with time and memory from the estimates: slurm")
      ->check(CLI::IsMember({"slurm"}))
      ->excludes(list);
  sub.add_option("--only", options.study.only, "Only the case of this index, as --list counts")
      ->check(CLI::Range(1, 1000000));
  sub.add_flag_callback(
      "--no-wait", [&options] { options.study.wait = false; },
      "End when all that is left is being computed by other processes; else wait for it, and take over from "
      "those that die");
  sub.add_option("--lease", options.study.lease,
                 "A process that has not touched the claim of its case for so long is held for dead (by the clock of "
                 "the file server)")
      ->capture_default_str();
  sub.add_flag("--dry-run", options.study.dry_run, "List the cases and what is done of them; compute nothing");
  add_no_report(sub, options);
}

void add_shakedown(CLI::App& sub, CommandOptions& options) {
  add_case(sub, options);
  add_output(sub, options, "results/<case name>-shakedown");
  sub.add_option("--engine", options.shakedown.engine, fmt::format("Where the stresses come from: {}", engines_text()))
      ->check(CLI::IsMember(engine_words()))
      ->capture_default_str();
  add_cell(sub, options);
  add_no_report(sub, options);
}

void add_material(CLI::App& sub, CommandOptions& options) {
  MaterialOptions& m = options.material;
  sub.add_option("card", options.case_file, "Case file with the material, e.g. one with [material.rail] alone")
      ->required();
  add_set(sub, options, "Override a key of the card; once for each key");
  auto* strain = sub.add_option("--strain", m.strain, "A path of strains: CSV with e_xx, e_yy, e_zz, e_xy, e_yz, e_xz");
  sub.add_option("--stress", m.stress,
                 "A path of stresses: CSV with s_xx_MPa, …; what has no column is free of stress, e_xx prescribes a "
                 "strain instead")
      ->excludes(strain);
  sub.add_option("--increments", m.increments, "Equal steps from row to row (default: 100); the error falls as 1/N")
      ->check(CLI::Range(1, 10000000));
  sub.add_option("--cycles", m.cycles, "Times through the rows (default: 1)")->check(CLI::Range(1, 1000000));
  auto* loop = sub.add_option("--calibrate", m.calibrate,
                              "Fit the law to a stabilised loop: CSV with strain, stress_MPa, once around");
  sub.add_option("--cyclic-curve", m.cyclic_curve,
                 "Fit it to amplitudes of stabilised cycles: CSV with strain_amplitude, stress_amplitude_MPa")
      ->excludes(loop);
  sub.add_option("--monotonic", m.monotonic,
                 "With a fit: a tensile curve, for the isotropic part: CSV with strain, stress_MPa");
  sub.add_option("--backstresses", m.backstresses,
                 "Of a fit (default: one more as long as it lowers the error by a quarter)")
      ->check(CLI::Range(1, 4));
  sub.add_option("--of", m.of, "The material: rail (default), wheel or a layer's name");
  sub.add_option("--depth", m.depth, "Of a material graded with depth: where (default: its top)");
  add_out(sub, options, "The table to write, NAME.csv, or the card of a fit, NAME.toml; the picture is NAME.svg");
  sub.add_flag("--force", options.force, "Replace a file that this command has not written");
}

void add_passes(CLI::App& sub, CommandOptions& options) {
  add_case(sub, options);
  add_output(sub, options, "results/<case name>-passes");
  sub.add_option("--engine", options.passes.engine,
                 "bem: stationary method, pressure and friction of the half-spaces; fem: every pass is rolled")
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

void add_compare(CLI::App& sub, CommandOptions& options) {
  sub.add_option("a", options.case_file, "Result folder A")->required();
  sub.add_option("b", options.reference, "Result folder B: differences are relative to it")->required();
  add_output(sub, options, "results/<folder A>-against-<folder B>");
}

void add_report(CLI::App& sub, CommandOptions& options) {
  sub.add_option("folders", options.report.folders,
                 "Result folders of `run` or `bem`; the second is drawn beside the first")
      ->required();
  add_out(sub, options, "The page to write, NAME.html (default: report.html in the folder, made anew if it is there)");
  sub.add_flag("--force", options.force, "Replace the file that --out names");
  sub.add_flag_callback(
      "--no-reference", [&options] { options.report.reference = false; },
      "Do not set a finite element result against the half-space solution of its case");
  sub.add_flag("--what-if", options.report.what_if,
               "Put the explorer on the case of the first folder into the page: some 1.1 MB more");
}

void add_explore(CLI::App& sub, CommandOptions& options) {
  sub.add_option("case", options.case_file,
                 "Case file, or a folder with case.toml (default: cases/paper/layer_3mm_2E0.toml)");
  add_set(sub, options, "Override a key of the case; once for each key");
  add_out(sub, options, "The page to write, NAME.html (default: explore.html)");
  sub.add_flag("--force", options.force, "Replace a file of this name");
  add_cell(sub, options);
}

void add_export(CLI::App& sub, CommandOptions& options) {
  sub.add_option("case", options.case_file, "Case file, or a folder with case.toml: a case's or a result's")
      ->required();
  add_set(sub, options, "Override a key of the case; once for each key");
  sub.add_option("--to", options.export_to.to, "The program that reads it")
      ->check(CLI::IsMember(export_words()))
      ->required();
  add_output(sub, options, "results/<case name>-<program>");
  sub.add_flag("--friction", options.export_to.friction,
               "abaqus, calculix, lsdyna: the contact has the case's friction coefficient (default: none, as in the "
               "preload here)");
  add_cell(sub, options);
}

void add_schema(CLI::App& sub, CommandOptions& options) {
  auto* json = sub.add_flag("--json-schema", options.schema.json_schema, "JSON schema (default)");
  sub.add_flag("--markdown", options.schema.markdown, "Reference page in Markdown")->excludes(json);
  sub.add_flag("--results", options.schema.results,
               "Of results instead of cases: every number of summary.json, every check");
}

void add_nothing(CLI::App&, CommandOptions&) {}
ExitCode done_by_parsing(const CommandOptions&) { return ExitCode::ok; }

struct Entry {
  const char *name, *what, *examples;
  void (*add_options)(CLI::App&, CommandOptions&);
  Command run;
};
constexpr Entry kEntries[] = {
    {"demo", "Run the shipped case cases/quick, in a minute or two, and tell what the results are",
     "Examples:\n  railstrata demo\n  railstrata demo --out /tmp/quick\n", add_demo, command_demo},
    {"check", "Read a case and tell what a run would be: contact point, mesh, stable step, memory, time. Runs nothing",
     "Examples:\n  railstrata check cases/quick\n  railstrata check cases/paper/base.toml --set mesh.element_size=\"2 "
     "mm\"\n  railstrata check cases/paper/base.toml --json\n",
     add_case, command_check},
    {"mesh", "Make the meshes and write them as VTU with a table of their quality",
     "Examples:\n  railstrata mesh cases/quick --out /tmp/mesh\n", add_case_and_output, command_mesh},
    {"run", "Run a case: static preload, rolling, results",
     "Examples:\n  railstrata run cases/quick\n  railstrata run cases/paper/base.toml --threads 4 --out results/base\n "
     " railstrata run cases/quick --set layer.0.thickness=\"1 mm\" --out results/thin\n"
     "  railstrata run cases/paper/base.toml --max-time \"110 min\"; railstrata run --resume results/base\n\n"
     "Ctrl-C, SIGTERM: finish the step, write a checkpoint, say how to go on (a second one quits at once). SIGUSR1: "
     "write a checkpoint, go on.\n",
     add_run, command_run},
    {"bem", "Solve a case by half-space theory, in about a second: the files and numbers of `run`, no meshes",
     "Examples:\n  railstrata bem cases/paper/base.toml\n  railstrata bem cases/quick --cell \"0.5 mm\" --out "
     "results/quick-coarse\n  railstrata bem cases/paper/base.toml --set drive.traction_coefficient=0.3 --json\n",
     add_bem, command_bem},
    {"shakedown",
     "Does it last? Load factors to first yield and to shakedown, by layer, and the strength that every depth asks for",
     "Examples:\n  railstrata shakedown cases/paper/base.toml --set material.rail.grade=R260\n  railstrata shakedown "
     "cases/quick --set material.rail.yield_strength=\"480 MPa\" --set layer.0.yield_strength=\"900 MPa\" --engine fem "
     "--out results/quick-shakedown\n",
     add_shakedown, command_shakedown},
    {"material",
     "A material law along a path of strain or stress, or fitted to a test: tables, a ready card, a picture",
     "Examples:\n  railstrata material cases/material/r260.toml --strain cases/material/strain_path.csv --increments "
     "200 --out loops.csv\n  railstrata material cases/material/r260.toml --stress cases/material/ratchetting.csv "
     "--cycles 50 --out ratchetting.csv\n  railstrata material cases/material/r260.toml --calibrate "
     "cases/material/loop.csv --monotonic cases/material/tension.csv --out fitted.toml\n\nCtrl-C: nothing is "
     "written.\n",
     add_material, command_material},
    {"passes",
     "Wheel after wheel over a rail that yields: residual stress, plastic strain of every pass, and whether it settles "
     "or ratchets",
     "Examples:\n  railstrata passes cases/paper/base.toml --set material.rail.hardening=R260 --passes 20\n  "
     "railstrata "
     "passes cases/paper/base.toml --set material.rail.yield_strength=\"750 MPa\" --passes 200 --out "
     "results/yields\n  railstrata passes cases/paper/base.toml --set material.rail.yield_strength=\"750 MPa\" "
     "--passes 400 --out results/yields --resume\n\nCtrl-C: the pass under way is finished and kept.\n",
     add_passes, command_passes},
    {"compare", "Two results, of either engine, on one grid: a table, the differences of the fields, a picture",
     "Examples:\n  railstrata compare results/quick results/quick-bem\n  railstrata compare results/thin results/thick "
     "--out results/thin-against-thick\n",
     add_compare, command_compare},
    {"creep-curve",
     "Force against longitudinal or lateral creepage or spin, by the full half-space theory and by the fast ones",
     "Examples:\n  railstrata creep-curve cases/paper/base.toml\n  railstrata creep-curve cases/quick --largest 0.01 "
     "--points 11 --cell \"0.5 mm\" --out results/creep\n  railstrata creep-curve cases/paper/layer_3mm_2E0.toml --of "
     "lateral_creepage --both-sides --set drive.traction_coefficient=0\n",
     add_creep_curve, command_creep_curve},
    {"creep-table", "Table of creep forces over axes of your choice, for vehicle codes: HDF5, CSV and a reader in C",
     "Examples:\n  railstrata creep-table cases/paper/base.toml --axis creepage_x=+-0.02:21 --axis "
     "creepage_y=+-0.02:21 "
     "--axis spin=\"-0.5:0.5 1/m:5\" --axis load=\"40 kN,80 kN,120 kN\" --out results/table\n  railstrata creep-table "
     "cases/paper/layer_3mm_2E0.toml --axis layer.0.thickness=\"1 mm,2 mm,3 mm\" --axis creepage_x=+-0.01:15\n",
     add_creep_table, command_creep_table},
    {"usetab", "Kalker's table of creep forces of ellipses of steel, as programs with a USETAB reader take it",
     "Examples:\n  railstrata usetab --out results/usetab\n  railstrata usetab --cells 30\n", add_usetab,
     command_usetab},
    {"sweep", "Half-space solutions over every combination of values, one table out",
     "Examples:\n  railstrata sweep cases/paper/layer_3mm_2E0.toml --vary layer.0.thickness=\"1 mm,2 mm,3 mm\" --vary "
     "layer.0.young_ratio=0.5,1,2\n"
     "  railstrata sweep cases/paper/base.toml --vary drive.traction_coefficient=0.1,0.2,0.3 --stresses --out "
     "results/traction\n",
     add_sweep, command_sweep},
    {"collective",
     "All rows of the case's load collective by half-space theory, and what their passages do to the rail together: "
     "wear, rolling contact fatigue, shakedown, by position across it",
     "Examples:\n  railstrata collective cases/collective/mixed_traffic.toml\n  railstrata collective "
     "cases/collective/mixed_traffic.toml --set load.0.passages=1e6 --out results/more-freight\n",
     add_collective, command_collective},
    {"wear-loop",
     "Wear of the case's load collective taken off the rail's profile, step by step: the worn profiles, and how the "
     "contact changes",
     "Examples:\n  railstrata wear-loop cases/collective/mixed_traffic.toml --steps 10\n  railstrata wear-loop "
     "cases/collective/mixed_traffic.toml --passages 1e5 --max-wear \"0.002 mm\" --out results/worn\n  railstrata "
     "wear-loop cases/collective/mixed_traffic.toml --passages 2e5 --out results/worn --resume\n\nCtrl-C: nothing of "
     "the step under way is kept, everything before is.\n",
     add_wear_loop, command_wear_loop},
    {"study",
     "Many cases from one file, by both engines, several at a time; goes on where it stopped; a table and a page over "
     "all of them",
     "Examples:\n  railstrata study cases/paper/study.toml --dry-run\n  railstrata study cases/paper/study.toml "
     "--engine bem --out results/study\n  railstrata study cases/paper/study.toml --out results/study --jobs 2 "
     "--threads 2\n  railstrata study cases/paper/study.toml --out /shared/study --shard 3/8     # one of eight "
     "machines\n",
     add_study, command_study},
    {"report",
     "One page on a result, or on several side by side: verdict, patch, stresses, history; opens in any browser, "
     "without a network",
     "Examples:\n  railstrata report results/quick\n  railstrata report results/thin results/thick --out "
     "thin-thick.html\n",
     add_report, command_report},
    {"explore",
     "One page with the half-space engine inside: sliders for layers, load and drive, and a contact that follows them",
     "Examples:\n  railstrata explore\n  railstrata explore cases/paper/layer_3mm_2E0.toml --out layer.html\n",
     add_explore, command_explore},
    {"export",
     "The case in the files of other programs: mesh and static preload for Abaqus, CalculiX and LS-DYNA; case and "
     "half-space result for CONTACT",
     "Examples:\n  railstrata export cases/quick --to calculix --out /tmp/quick-ccx\n  railstrata export "
     "cases/verification/hertz_sphere.toml --to contact\n",
     add_export, command_export},
    {"schema", "Print the JSON schema of case files for editors, or the reference of cases or results",
     "Examples:\n  railstrata schema --json-schema > case.schema.json\n  railstrata schema --markdown\n  railstrata "
     "schema --results --markdown\n",
     add_schema, command_schema},
    {"info", "Built-in profiles, compiler, instruction set, libraries, threads",
     "Examples:\n  railstrata info\n  railstrata info --json\n", add_nothing, command_info},
    {"completion", "Print the script that completes commands, options, keys of --set, their words and units in a shell",
     "Examples:\n  source <(railstrata completion bash)\n  railstrata completion bash > "
     "~/.local/share/bash-completion/completions/railstrata\n",
     [](CLI::App& sub, CommandOptions&) { add_completion(sub); }, done_by_parsing},
    {"manual", "Print the manual page of the program, of a command or of case files, or write all of them",
     "Examples:\n  railstrata manual run | man -l -\n  railstrata manual --out ~/.local/share/man\n",
     [](CLI::App& sub, CommandOptions&) { add_manual(sub); }, done_by_parsing},
};

/// `run` shares its work among ranks; processes of `study` share cases by their claims.
bool may_be_ranks(Command command) { return command == command_run || command == command_study; }

std::vector<std::string> command_names() {
  std::vector<std::string> names;
  for (const Entry& e : kEntries) names.emplace_back(e.name);
  return names;
}

/// CLI11 calls an unknown command "extra arguments"; this finds the word that was meant.
void check_command_word(const std::vector<std::string>& words) {
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i] == "-j" || words[i] == "--threads") {
      ++i;
      continue;
    }
    if (words[i].starts_with("-")) continue;
    const std::vector<std::string> names = command_names();
    if (std::find(names.begin(), names.end(), words[i]) != names.end()) return;
    const std::string meant = nearest_word(words[i], names);
    throw CaseError(fmt::format("unknown command \"{}\"", words[i]),
                    fmt::format("{}commands: {}", meant.empty() ? "" : fmt::format("did you mean {}? ", meant),
                                fmt::join(names, ", ")));
  }
}

/// The text of a line of the log.
class PrintableText : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& out) override {
    const std::string text = printable({message.payload.data(), message.payload.size()});
    out.append(text.data(), text.data() + text.size());
  }
  std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<PrintableText>(); }
};

void set_up_log(bool quiet, int verbose) {
  auto logger = std::make_shared<spdlog::logger>("railstrata", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<PrintableText>('*').set_pattern("%^%l:%$ %*");
  logger->set_formatter(std::move(formatter));
  logger->set_level(quiet ? spdlog::level::warn : verbose > 0 ? spdlog::level::debug : spdlog::level::info);
  spdlog::set_default_logger(logger);
}

/// Words are written into JSON and TOML files.
void require_utf8(const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    try {
      nlohmann::json(word).dump();
    } catch (const nlohmann::json::type_error&) {
      throw CaseError(fmt::format("\"{}\" is not UTF-8", word), "give files and folders names in UTF-8");
    }
  }
}

/// For messages, which must not fail in their turn.
void say(FILE* stream, const std::string& text) {
  std::fputs(text.c_str(), stream);
  std::fflush(stream);
}

int tell(ExitCode code, const std::string& text) {
  say(stderr, printable(fmt::format("error: {}\n", text)));
  return static_cast<int>(code);
}

int tell(const CaseError& e, bool json) {
  if (json) {
    auto all = nlohmann::ordered_json::array();
    for (const Diagnostic& d : e.diagnostics)
      all.push_back({{"where", d.where}, {"message", d.message}, {"remedy", d.remedy}});
    say(stdout, json_text(nlohmann::ordered_json{{"errors", all}}, 2) + "\n");
  }
  for (const Diagnostic& d : e.diagnostics)
    say(stderr, printable(fmt::format("{}{}error: {}{}\n", d.where, d.where.empty() ? "" : ": ", d.message,
                                      d.remedy.empty() ? "" : "\n    remedy: " + d.remedy)));
  return static_cast<int>(ExitCode::user);
}

int parse_and_run(const std::vector<std::string>& given, CommandOptions& options) {
  CLI::App app{"RailStrata: rolling contact of a wheel on a layered rail", "railstrata"};
  app.footer(
      "Examples:\n  railstrata check cases/quick\n  railstrata run cases/quick --threads 2\n  railstrata bem "
      "cases/quick\n  railstrata run --help\n\nExit codes: 0 done, 1 a check of the result failed, 2 the input is "
      "wrong, "
      "3 the numbers went wrong, 4 the machine could not, 5 stopped for --max-time (resume it), 70 a fault of the "
      "program, 130 interrupted\n");
  app.set_version_flag("--version", "railstrata " + version_text());
  app.require_subcommand(1);
  app.fallthrough();
  bool quiet = false;
  int verbose = 0;
  options.threads = default_threads();
  app.add_option("-j,--threads", options.threads, "Threads (default: OMP_NUM_THREADS, or one a core)")
      ->check(CLI::Range(1, kMostThreads));
  app.add_flag("--json", options.json, "Results on standard output as JSON");
  app.add_flag("-q,--quiet", quiet, "Only warnings and errors");
  app.add_flag("-v,--verbose", verbose, "Say more");
  std::vector<std::pair<CLI::App*, Command>> commands;
  for (const Entry& e : kEntries) {
    CLI::App* sub = app.add_subcommand(e.name, e.what);
    sub->footer(e.examples);
    e.add_options(*sub, options);
    commands.emplace_back(sub, e.run);
  }
  require_utf8(given);
  if (given.size() == 1) {  // no mistake to name, and yet nothing done: what there is, and the code of a mistake
    say(stdout, app.help());
    return static_cast<int>(ExitCode::user);
  }
  const std::vector<std::string> words = with_help_spelled_out(given);
  check_command_word(words);
  try {
    std::vector<std::string> reversed(words.rbegin(), words.rend() - 1);
    app.parse(reversed);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);  // help or version, on standard output
    options.json = std::find(words.begin(), words.end(), "--json") != words.end();
    throw usage_error(app, e, words, command_names());
  }
  set_up_log(quiet, verbose);
  set_threads(options.threads);
  for (const auto& [sub, command] : commands) {
    if (!sub->parsed()) continue;
    if (!may_be_ranks(command)) refuse_ranks(sub->get_name());
    return static_cast<int>(command(options));
  }
  return static_cast<int>(ExitCode::user);
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  settle_in();
  CommandOptions options;
  options.command_line.assign(argv, argv + argc);
  try {
    const int code = parse_and_run(options.command_line, options);
    if (std::fflush(stdout) != 0)
      throw std::system_error(errno, std::generic_category(), "cannot write to standard output");
    if (std::ferror(stdout)) throw std::system_error(EIO, std::generic_category(), "cannot write to standard output");
    return code;
  } catch (const CaseError& e) {
    leave_words_to_rank_0();  // a mistake is that of all
    return tell(e, options.json);
  } catch (const NumericalError& e) {
    return tell(ExitCode::numerics, e.what());
  } catch (const Interrupted& e) {
    return tell(ExitCode::interrupted, e.what());
  } catch (const EnvironmentError& e) {
    return tell(ExitCode::environment,
                e.remedy.empty() ? e.what() : fmt::format("{}\n    remedy: {}", e.what(), e.remedy));
  } catch (const std::system_error& e) {  // of a file system, or of standard output
    return tell(ExitCode::environment, e.what());
  } catch (const std::bad_alloc&) {
    return tell(ExitCode::environment, "not enough memory; `railstrata check` tells what a case needs");
  } catch (const std::exception& e) {
    return tell(ExitCode::internal,
                fmt::format("{} (a fault of the program: please report it with the case file)", e.what()));
  }
}

}  // namespace railstrata
