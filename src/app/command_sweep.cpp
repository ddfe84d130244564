#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include "app/case_of.hpp"
#include "app/commands.hpp"
#include "app/common_options.hpp"
#include "app/control.hpp"
#include "app/option_values.hpp"
#include "io/output_folder.hpp"
#include "judge/check_limits.hpp"
#include "many/sweep.hpp"
#include "many/sweep_page.hpp"

namespace railstrata {
namespace {

std::string cell_text(double v, int width, int digits) {
  return fmt::format("  {:>{}}", std::isfinite(v) ? fixed(v, digits) : "-", width);
}

/// What the terminal shows of a case.
struct Shown {
  const char *heading, *path;
  double factor;
  int width, digits;
};
constexpr Shown kShown[] = {{"p_max MPa", "/contact/p_max_Pa", 1e-6, 9, 1},
                            {"q_max MPa", "/contact/q_max_Pa", 1e-6, 9, 1},
                            {"area mm²", "/contact/patch_area_m2", 1e6, 8, 1},
                            {"slip %", "/contact/slip_area_fraction", 100, 6, 1},
                            {"creep 1e-3", "/contact/creepage_x", 1e3, 10, 3}};

/// Notes of cases that the case itself does not have, each once.
void warn_of_notes(const LoadedCase& base, const std::vector<SweepCase>& cases) {
  std::set<std::string> told(base.static_notes.begin(), base.static_notes.end());
  told.insert(base.notes.begin(), base.notes.end());
  for (const SweepCase& c : cases) {
    if (!c.loaded) continue;
    for (const auto* notes : {&c.loaded->notes, &c.loaded->static_notes})
      for (const std::string& note : *notes)
        if (told.insert(note).second) spdlog::warn("{}", note);
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
    const CheckRow* row = find_check(name);
    fmt::print("  {} of {} cases: {}\n", cases_with, cases.size(), row ? std::string(row->name) : name);
  }
}

void print_table(const std::vector<SweepCase>& cases, const std::vector<Axis>& keys) {
  std::vector<std::size_t> width;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    width.push_back(keys[k].key.size());
    for (const std::string& v : keys[k].values) width[k] = std::max(width[k], v.size());
    fmt::print("{:<{}}  ", keys[k].key, width[k]);
  }
  const bool several =
      std::any_of(cases.begin(), cases.end(), [](const SweepCase& c) { return remarks_of(c.summary).patches > 1; });
  for (const Shown& s : kShown) fmt::print("  {:>{}}", s.heading, s.width);
  fmt::print("{}\n", several ? "  patches" : "");
  for (const SweepCase& c : cases) {
    if (!c.done) continue;
    for (std::size_t k = 0; k < keys.size(); ++k) fmt::print("{:<{}}  ", c.values[k], width[k]);
    if (!c.summary.is_null()) {
      for (const Shown& s : kShown)
        fmt::print("{}", cell_text(column_value({s.heading, s.path, s.factor}, c.summary), s.width, s.digits));
      if (several) fmt::print("  {:>7}", remarks_of(c.summary).patches);
    }
    fmt::print("{}\n", c.fault.empty() ? "" : "  " + c.fault);
  }
  if (several)
    fmt::print(
        "\nof several patches: the numbers of the one with the largest pressure; sweep.csv has F_x, F_y and F_z of "
        "all\n");
  print_warnings(cases);
}

nlohmann::ordered_json as_json(const std::vector<SweepCase>& cases, const std::vector<Axis>& keys,
                               const std::vector<ResultColumn>& columns) {
  auto out = nlohmann::ordered_json::array();
  for (const SweepCase& c : cases) {
    if (!c.done) continue;
    nlohmann::ordered_json row;
    for (std::size_t k = 0; k < keys.size(); ++k) row[keys[k].key] = c.values[k];
    for (const ResultColumn& column : columns) {
      const double v = column_value(column, c.summary);
      row[column.name] = std::isfinite(v) ? nlohmann::ordered_json(v) : nlohmann::ordered_json(nullptr);
    }
    row["fault"] = c.fault.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(c.fault);
    const ResultRemarks remarks = remarks_of(c.summary);
    row["patches"] = remarks.patches;
    row["checks"] = remarks.checks;
    row["warnings"] = remarks.warnings;
    out.push_back(std::move(row));
  }
  return out;
}

ExitCode command_sweep(const CommandOptions& options) {
  const std::vector<Axis> keys = parse_axes("--vary", options.sweep.vary);
  const LoadedCase base = load_half_space_case_of(options);
  std::vector<SweepCase> cases = plan_sweep(base, options.overrides, keys);
  warn_of_notes(base, cases);
  InfluenceCache cache;
  SweepOptions sweep;
  sweep.bem.cell = cell_size(options.cell);
  sweep.bem.cache = &cache;
  sweep.stresses = options.sweep.stresses;
  const std::vector<ResultColumn> columns = result_columns(options.sweep.stresses);

  const std::filesystem::path out = output_folder_of(options, base, "-sweep");
  const FolderHold hold = prepare_output_folder(out, options.force);
  write_origin(out, base, options.command_line, options.threads);
  spdlog::info("{} cases; the table grows in {}", cases.size(), (out / "sweep.csv").string());
  SweepTable table(out / "sweep.csv", table_origin(base), keys, columns);
  sweep.control = &control_by_signals();
  std::size_t done = 0;
  sweep.ended = [&] {
    table.add_done(cases);
    control().progress("sweep", static_cast<double>(++done) / static_cast<double>(cases.size()));
  };
  run_sweep(cases, sweep);
  control().progress("");

  if (options.json)
    fmt::print("{}\n", as_json(cases, keys, columns).dump(2));
  else
    print_table(cases, keys);
  if (control().stop) {
    spdlog::warn("stopped; {} holds the first cases", (out / "sweep.csv").string());
    return ExitCode::interrupted;
  }
  if (options.page) {
    write_sweep_page(out / "report.html", base.spec.title, keys, cases, columns);
    spdlog::info("everything on one page: {}", (out / "report.html").string());
  }
  const auto faults = std::count_if(cases.begin(), cases.end(), [](const SweepCase& c) { return !c.fault.empty(); });
  if (faults > 0) spdlog::warn("{} of {} cases failed: see the column fault", faults, cases.size());
  return faults > 0 ? ExitCode::failed_checks : ExitCode::ok;
}

void declare_sweep(CLI::App& sub, CommandOptions& options) {
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

}  // namespace

const Command kSweepCommand{
    "sweep", "Half-space solutions over every combination of values, one table out",
    "Examples:\n  railstrata sweep cases/paper/layer_3mm_2E0.toml --vary layer.0.thickness=\"1 mm,2 mm,3 mm\" --vary "
    "layer.0.young_ratio=0.5,1,2\n"
    "  railstrata sweep cases/paper/base.toml --vary drive.traction_coefficient=0.1,0.2,0.3 --stresses --out "
    "results/traction\n",
    declare_sweep, command_sweep};

}  // namespace railstrata
