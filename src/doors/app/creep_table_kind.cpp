#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#include <nlohmann/json.hpp>

#include "app/case_of.hpp"
#include "app/control.hpp"
#include "app/creep_kinds.hpp"
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

}  // namespace

ExitCode creep_table_in_folder(const CreepTableWords& wanted, const CommandOptions& options) {
  std::vector<NumberAxis> axes = parse_number_axes("--axis", wanted.axes);
  const LoadedCase base = load_case_of(options, uses::kCreepTable);
  CreepTableOrder order{job_order_of(options, base, "-creep-table", wanted.resume),
                        options.overrides,
                        std::move(axes),
                        scaled_counts(wanted.scaled),
                        cell_size(options.cell),
                        wanted.places};
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

}  // namespace railstrata
