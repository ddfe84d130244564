#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <map>
#include <memory>
#include <set>

#include <nlohmann/json.hpp>

#include "app/case_list.hpp"
#include "app/case_of.hpp"
#include "app/common_options.hpp"
#include "app/control.hpp"
#include "clock/wheel_life.hpp"
#include "io/output_folder.hpp"
#include "judge/check_limits.hpp"
#include "many/each_case.hpp"
#include "many/sweep.hpp"
#include "record/json.hpp"

namespace railstrata {
namespace {

struct SweepWords {
  std::vector<std::string> vary;  ///< --vary
  bool stresses = false;          ///< --stresses
};

/// Notes of cases that the case itself does not have, each once.
void warn_of_notes(const LoadedCase& base, const std::vector<SweepCase>& cases) {
  const std::vector<std::string> known = notes_for(uses::kHalfSpaces, base);
  std::set<std::string> reported(known.begin(), known.end());
  for (const SweepCase& c : cases) {
    if (!c.loaded) continue;
    for (const std::string& note : notes_for(uses::kHalfSpaces, *c.loaded))
      if (reported.insert(note).second) spdlog::warn("{}", note);
  }
}

/// Each once, with the number of cases that have it.
void print_warnings(const std::vector<SweepCase>& cases) {
  std::map<std::string, int> count;
  for (const SweepCase& c : cases)
    if (c.done && c.summary.contains("warnings"))
      for (const auto& w : c.summary["warnings"]) ++count[w.value("name", "?")];
  if (!count.empty()) fmt::print("\nwarnings (column warnings of sweep.csv):\n");
  for (const auto& [name, cases_with] : count) {
    fmt::print("  {} of {} cases: {}\n", cases_with, cases.size(), check_words(name).name);
  }
}

void print_table(const CaseTable& table, const std::vector<SweepCase>& cases) {
  std::vector<CaseColumn> head = value_columns(table.rows);
  const bool several =
      std::any_of(table.rows.begin(), table.rows.end(), [](const CaseRow& row) { return row.remarks.patches > 1; });
  if (several) head.push_back({"patches", [](const CaseRow& row) { return fmt::format("{}", row.remarks.patches); }});
  print_rows(head, listed_numbers(), table.rows);
  if (several)
    fmt::print(
        "\nof several patches: the numbers of the one with the largest pressure; sweep.csv has F_x, F_y and F_z of "
        "all\n");
  print_warnings(cases);
}

ExitCode command_sweep(const SweepWords& own, const CommandOptions& options) {
  const std::vector<Axis> axes = parse_axes("--vary", own.vary);
  const LoadedCase base = load_case_of(options, uses::kHalfSpaces);
  std::vector<SweepCase> cases = plan_sweep(base, axes);
  warn_of_notes(base, cases);
  InfluenceCache cache;
  SweepOptions sweep;
  sweep.bem.cell = cell_size(options.cell);
  sweep.bem.cache = &cache;
  sweep.stresses = own.stresses || base.spec.life.crack.there();  // a crack's numbers are some of them
  const std::vector<ResultColumn> columns = result_columns(sweep.stresses);

  const std::filesystem::path out = output_folder_of(options, base, "-sweep");
  const FolderHold hold = prepare_output_folder(out, options.force);
  write_origin(out, base, options.command_line, options.threads);
  spdlog::info("{} cases; the table grows in {}", cases.size(), (out / "sweep.csv").string());
  std::vector<std::string> origin = table_origin(base);
  origin.push_back(patches_remark(columns));
  CaseTable table;
  const auto write = [&] {
    table = sweep_table(cases, axes, columns);
    write_cases(out / "sweep.csv", origin, table);
  };
  sweep.control = &control_by_signals();
  sweep.life_of = life_of_wheels;
  NowAndThen now_and_then;
  std::size_t done = 0;
  sweep.ended = [&] {
    now_and_then(write);
    control().progress("sweep", static_cast<double>(++done) / static_cast<double>(cases.size()));
  };
  run_sweep(cases, sweep);
  control().progress("");
  write();

  report_assumed(base, uses::kHalfSpaces);
  if (options.json)
    fmt::print("{}\n", json_of(table).dump(2));
  else
    print_table(table, cases);
  if (control().stop) {
    spdlog::warn("stopped; {} holds the cases that were solved", (out / "sweep.csv").string());
    return ExitCode::interrupted;
  }
  if (options.page) {
    write_sweep_page(out / "report.html", base.spec.title, axes, table.rows);
    spdlog::info("everything on one page: {}", (out / "report.html").string());
  }
  const auto faults = std::count_if(cases.begin(), cases.end(), [](const SweepCase& c) { return !c.fault.empty(); });
  if (faults > 0) spdlog::warn("{} of {} cases failed: see the column fault", faults, cases.size());
  return faults > 0 ? ExitCode::failed_checks : ExitCode::ok;
}

CommandWork declare_sweep(CLI::App& sub, CommandOptions& options) {
  const auto own = std::make_shared<SweepWords>();
  add_case(sub, options);
  add_output(sub, options, "results/<case name>-sweep");
  add_cell(sub, options);
  add_repeated(
      sub, "--vary", own->vary, "KEY=VALUES",
      "A key and its values: --vary layer.0.young_ratio=0.5,1,2; once for each key: every combination is solved")
      ->required();
  sub.add_flag("--stresses", own->stresses, "Largest stresses in the rail too (takes longer than the contact)");
  add_no_report(sub, options);
  return [own, &options] { return command_sweep(*own, options); };
}

}  // namespace

extern const Command kSweepCommand{
    "sweep", "Half-space solutions over every combination of values, one table out",
    "Examples:\n  railstrata sweep cases/paper/layer_3mm_2E0.toml --vary layer.0.thickness=\"1 mm,2 mm,3 mm\" --vary "
    "layer.0.young_ratio=0.5,1,2\n"
    "  railstrata sweep cases/paper/base.toml --vary drive.traction_coefficient=0.1,0.2,0.3 --stresses --out "
    "results/traction\n",
    declare_sweep};

}  // namespace railstrata
