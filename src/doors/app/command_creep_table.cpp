#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <optional>

#include <nlohmann/json.hpp>

#include "app/case_of.hpp"
#include "app/commands.hpp"
#include "app/common_options.hpp"
#include "app/control.hpp"
#include "app/option_values.hpp"
#include "creep/creep_table_job.hpp"
#include "record/csv.hpp"
#include "record/output_file.hpp"

namespace railstrata {
namespace {

/// "12:17:13"
std::optional<ScaledCounts> scaled_counts(const std::string& text) {
  if (text.empty()) return std::nullopt;
  ScaledCounts out;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%d:%d:%d%c", &out.angles, &out.spins, &out.sizes, &rest) == 3)
    if (std::min({out.angles, out.spins, out.sizes}) >= 4 && std::max({out.angles, out.spins, out.sizes}) <= 1000)
      return out;
  throw CaseError(fmt::format("--scaled {}", text), "give three numbers from 4 to 1000: --scaled 12:17:13");
}

void print(const CreepTable& table, const TableError& error) {
  fmt::print("{} points\n", table.points());
  for (const TableAxis& axis : table.table().axes)
    fmt::print("  {:<16} {:>4} values, {:g} to {:g} {}\n", axis.name, axis.at.size(), axis.at.front(), axis.at.back(),
               axis.unit);
  if (table.table().scaling)
    for (const TableAxis& axis : table.table().scaling->asked)
      fmt::print("  {:<16}             {:g} to {:g} {}\n", axis.name, axis.at.front(), axis.at.back(), axis.unit);
  if (error.places > 0) {
    const TableError::CreepForce& force = error.creep_force;
    fmt::print(
        "\ncreep force against {} solutions, of friction times normal force\n"
        "  half below {:.3f} %, 95 % below {:.3f} %, largest {:.3f} % at {}\n",
        error.places, 100 * force.half, 100 * force.most, 100 * force.largest, table.place_words(force.where));
    fmt::print("\ninterpolation of the numbers, of the largest value there\n");
    fmt::print("  {:<16} {:>9} {:>9}\n", "", "largest", "mean");
    for (const TableError::Number& n : error.numbers)
      if (n.scale > 0)
        fmt::print("  {:<16} {:>7.2f} % {:>7.2f} %\n", n.name, 100 * n.largest / n.scale, 100 * n.mean / n.scale);
  }
  for (const std::string& fault : table.faults()) spdlog::warn("{}", fault);
}

ExitCode command_creep_table(const CommandOptions& options) {
  std::vector<NumberAxis> axes = parse_number_axes("--axis", options.creep_table.axes);
  const LoadedCase base = load_half_space_case_of(options, CaseUse::steady_rolling);
  if (!base.spec.run.rolling)
    spdlog::warn("run.rolling = false has no effect: a creep table is of steady rolling, with the case's friction");
  if (base.spec.transient.kind != TransientKind::none)
    spdlog::warn("[transient] has no effect: a creep table is of steady rolling");
  CreepTableOrder order{job_order_of(options, base, "-creep-table", options.creep_table.resume),
                        options.overrides,
                        std::move(axes),
                        scaled_counts(options.creep_table.scaled),
                        cell_size(options.cell),
                        options.creep_table.places};
  const auto show = [&](const CreepTable& table, const TableError& error, const nlohmann::ordered_json& json) {
    if (options.json)
      fmt::print("{}\n", json.dump(2));
    else
      print(table, error);
    spdlog::info("results are in {}", order.folder.string());
    if (table.missing() > 0) spdlog::warn("{} of {} points have no answer", table.missing(), table.points());
  };
  return code_of(carry_out_creep_table(base, order, control_by_signals(), show));
}

void declare_creep_table(CLI::App& sub, CommandOptions& options) {
  add_case(sub, options);
  add_output(sub, options, "results/<case name>-creep-table");
  add_cell(sub, options);
  add_repeated(sub, "--axis", options.creep_table.axes, "WORD=VALUES",
               "An axis: creepage_x, creepage_y, spin, load, friction, lateral_shift, yaw or a key of the case; values "
               "\"v1,v2,...\", \"from:to:count\" or, dense about 0, \"+-largest:count\"")
      ->required();
  sub.add_option(
         "--scaled", options.creep_table.scaled,
         "A table in scaled creepages, with so many angles of creepage, angles of spin and sizes (12:17:13); of "
         "the axes creepage_x, creepage_y and spin the ends count")
      ->type_name("ANGLES:SPINS:SIZES");
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
    "cases/paper/base.toml --scaled 12:17:13 --axis creepage_x=-0.02,0.02 --axis creepage_y=-0.02,0.02 --axis "
    "spin=\"-0.5,0.5 1/m\" --axis load=\"40 kN,80 kN,120 kN\" --out results/scaled-table\n  railstrata creep-table "
    "cases/paper/layer_3mm_2E0.toml --axis layer.0.thickness=\"1 mm,2 mm,3 mm\" --axis creepage_x=+-0.01:15\n",
    declare_creep_table, command_creep_table};

}  // namespace railstrata
