#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>

#include <nlohmann/json.hpp>

#include "app/case_of.hpp"
#include "app/commands.hpp"
#include "app/common_options.hpp"
#include "app/control.hpp"
#include "app/option_values.hpp"
#include "io/csv.hpp"
#include "io/output_file.hpp"
#include "io/output_folder.hpp"
#include "io/table_file.hpp"
#include "many/table_error.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

constexpr const char *kTable = "creep_table.h5", *kBegun = "creep_table.begun.h5", *kIdentity = "creep_table.identity";

std::string text_in(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string with_unit(const std::string& name, std::string unit) {
  for (char& c : unit)
    if (c == ' ' || c == '/') c = '_';
  return unit.empty() ? name : name + "_" + unit;
}

std::vector<CsvColumn> columns_of(const ForceTable& table) {
  std::vector<CsvColumn> out;
  std::size_t after = table.points();
  for (const TableAxis& axis : table.axes) {
    after /= axis.at.size();
    out.push_back({with_unit(axis.name, axis.unit), {}});
    for (std::size_t k = 0; k < table.points(); ++k) out.back().values.push_back(axis.at[k / after % axis.at.size()]);
  }
  for (const TableNumber& number : table.numbers) out.push_back({with_unit(number.name, number.unit), number.values});
  return out;
}

nlohmann::ordered_json as_json(const CreepTable& table, const TableError& error) {
  nlohmann::ordered_json out;
  for (const TableAxis& axis : table.table().axes)
    out["axes"].push_back({{"name", axis.name}, {"unit", axis.unit}, {"values", axis.at}});
  out["points"] = table.points();
  out["missing"] = table.missing();
  out["faults"] = table.faults();
  out["interpolation"]["places"] = error.places;
  for (const TableError::Number& n : error.numbers)
    out["interpolation"]["numbers"].push_back({{"name", n.name},
                                               {"unit", n.unit},
                                               {"largest", n.largest},
                                               {"mean", n.mean},
                                               {"of_largest_value", n.scale > 0 ? n.largest / n.scale : 0.0}});
  return out;
}

void print(const CreepTable& table, const TableError& error) {
  for (const TableAxis& axis : table.table().axes)
    fmt::print("  {:<16} {:>4} values, {:g} to {:g} {}\n", axis.name, axis.at.size(), axis.at.front(), axis.at.back(),
               axis.unit);
  if (error.places > 0) {
    fmt::print("\ninterpolation against {} solutions between the points, of the table's largest value\n", error.places);
    fmt::print("  {:<16} {:>9} {:>9}\n", "", "largest", "mean");
    for (const TableError::Number& n : error.numbers)
      if (n.scale > 0)
        fmt::print("  {:<16} {:>7.2f} % {:>7.2f} %\n", n.name, 100 * n.largest / n.scale, 100 * n.mean / n.scale);
  }
  for (const std::string& fault : table.faults()) spdlog::warn("{}", fault);
}

TableRemarks table_remarks(const LoadedCase& base, const TableError& error) {
  std::string origin, accuracy;
  for (const std::string& line : table_origin(base)) origin += (origin.empty() ? "" : "; ") + line;
  for (const TableError::Number& n : error.numbers)
    accuracy += fmt::format("{}{} {:.3g} {}", accuracy.empty() ? "" : ", ", n.name, n.largest, n.unit);
  TableRemarks out{{"origin", origin}};
  if (error.places > 0)
    out.emplace_back("interpolation_error",
                     fmt::format("largest differences at {} places: {}", error.places, accuracy));
  return out;
}

/// Now and then what is there is kept.
class Keeper {
 public:
  Keeper(const CreepTable& table, fs::path file) : table_(table), file_(std::move(file)) {}
  void now_and_then() {
    constexpr std::chrono::seconds kApart{20};
    if (std::chrono::steady_clock::now() - last_ > kApart) keep();
  }
  void keep() {
    write_force_table(file_, table_.table(), {});
    last_ = std::chrono::steady_clock::now();
  }

 private:
  const CreepTable& table_;
  fs::path file_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

ExitCode stopped(Keeper& keeper) {
  keeper.keep();
  spdlog::warn("stopped; go on with --resume");
  return ExitCode::interrupted;
}

ExitCode command_creep_table(const CommandOptions& options) {
  std::vector<NumberAxis> axes = parse_number_axes("--axis", options.creep_table.axes);
  const LoadedCase base = load_half_space_case_of(options, CaseUse::steady_rolling);
  if (!base.spec.run.rolling)
    spdlog::warn("run.rolling = false has no effect: a creep table is of steady rolling, with the case's friction");
  if (base.spec.transient.kind != TransientKind::none)
    spdlog::warn("[transient] has no effect: a creep table is of steady rolling");
  CreepTable table(base, options.overrides, std::move(axes));
  CreepTableOptions how;
  how.bem.cell = cell_size(options.cell);
  how.control = &control_by_signals();

  require_table_files();
  const fs::path out = output_folder_of(options, base, "-creep-table");
  const bool resume = options.creep_table.resume;
  const FolderHold hold = prepare_output_folder(out, options.force || resume);
  const std::string identity = fmt::format("{} {:.17g}\n", case_identity(base), how.bem.cell);
  if (resume && fs::exists(out / kBegun)) {
    if (text_in(out / kIdentity) != identity)
      throw CaseError(fmt::format("{}: no table of this very case", out.string()),
                      "give the case, the --set and the --cell of its beginning, or another --out without --resume");
    table.take(read_force_table(out / kBegun));
  }
  write_whole_file(out / kIdentity, identity);
  write_origin(out, base, options.command_line, options.threads);
  Keeper keeper(table, out / kBegun);
  spdlog::info("{} points", table.points());
  how.solved = [&](std::size_t done) {
    how.control->progress("creep table", static_cast<double>(done) / static_cast<double>(table.points()));
    keeper.now_and_then();
  };
  table.solve(how);
  how.control->progress("");
  if (how.control->stop) return stopped(keeper);
  const TableError error = interpolation_error(table, options.creep_table.places, how);
  if (how.control->stop) return stopped(keeper);
  for (const std::string& axis : table.idle_axes())
    spdlog::warn("--axis {}: no number of the table changes with it", axis);
  write_force_table(out / kTable, table.table(), table_remarks(base, error));
  std::vector<std::string> origin = table_origin(base);
  origin.emplace_back("forces on the wheel: along x, lateral in the contact plane, along its normal; moment about it");
  write_csv(out / "creep_table.csv", origin, columns_of(table.table()));
  write_whole_file(out / "creep_table.json", as_json(table, error).dump(2) + "\n");
  fs::remove(out / kBegun);
  fs::remove(out / kIdentity);
  if (options.json)
    fmt::print("{}\n", as_json(table, error).dump(2));
  else
    print(table, error);
  spdlog::info("results are in {}", out.string());
  if (table.missing() > 0) spdlog::warn("{} of {} points have no answer", table.missing(), table.points());
  return table.missing() > 0 ? ExitCode::failed_checks : ExitCode::ok;
}

void declare_creep_table(CLI::App& sub, CommandOptions& options) {
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

}  // namespace

const Command kCreepTableCommand{
    "creep-table", "Table of creep forces over axes of your choice, for vehicle codes: HDF5, CSV and a reader in C",
    "Examples:\n  railstrata creep-table cases/paper/base.toml --axis creepage_x=+-0.02:21 --axis "
    "creepage_y=+-0.02:21 "
    "--axis spin=\"-0.5:0.5 1/m:5\" --axis load=\"40 kN,80 kN,120 kN\" --out results/table\n  railstrata creep-table "
    "cases/paper/layer_3mm_2E0.toml --axis layer.0.thickness=\"1 mm,2 mm,3 mm\" --axis creepage_x=+-0.01:15\n",
    declare_creep_table, command_creep_table};

}  // namespace railstrata
