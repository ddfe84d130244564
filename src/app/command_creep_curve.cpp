#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cmath>

#include <nlohmann/json.hpp>

#include "app/case_of.hpp"
#include "app/commands.hpp"
#include "app/option_values.hpp"
#include "app/waiting.hpp"
#include "bem/creep_curve.hpp"
#include "core/faults.hpp"
#include "io/csv.hpp"
#include "io/output_folder.hpp"
#include "runs/half_space_need.hpp"

namespace railstrata {
namespace {

constexpr double kDecades = 2.5;

// Creepages of a driving wheel: negative.
std::vector<double> creepages(const CommandOptions& options) {
  std::vector<double> out;
  for (int i = 0; i < options.creep_curve.points; ++i)
    out.push_back(-options.creep_curve.largest *
                  std::pow(10.0, -kDecades * (options.creep_curve.points - 1 - i) / (options.creep_curve.points - 1)));
  return out;
}

// Forces on the wheel, a driving one's positive.
struct Column {
  const char* name;
  double (*value)(const CreepCurvePoint&);
};
constexpr Column kColumns[] = {{"creepage", [](const CreepCurvePoint& p) { return p.creepage; }},
                               {"full", [](const CreepCurvePoint& p) { return -p.full; }},
                               {"fastsim", [](const CreepCurvePoint& p) { return -p.fastsim; }},
                               {"polach", [](const CreepCurvePoint& p) { return -p.polach; }},
                               {"vermeulen_johnson", [](const CreepCurvePoint& p) { return -p.vermeulen_johnson; }},
                               {"linear", [](const CreepCurvePoint& p) { return -p.linear; }},
                               {"slip_area_fraction", [](const CreepCurvePoint& p) { return p.slip_fraction; }}};

std::vector<CsvColumn> table_of(const std::vector<CreepCurvePoint>& curve) {
  std::vector<CsvColumn> out;
  for (const Column& c : kColumns) {
    out.push_back({c.name, {}});
    for (const CreepCurvePoint& p : curve) out.back().values.push_back(c.value(p));
  }
  return out;
}

void print_table(const std::vector<CsvColumn>& table) {
  fmt::print("F_x/(f F_z) on the wheel; a driving wheel has creepage < 0 and F_x > 0\n\n");
  for (const CsvColumn& c : table) fmt::print("{:>{}}", c.name, c.name.size() > 10 ? 20 : 12);
  fmt::print("\n");
  for (std::size_t i = 0; i < table.front().values.size(); ++i) {
    for (const CsvColumn& c : table) {
      if (&c == &table.front())
        fmt::print("{:>12.3e}", c.values[i]);
      else
        fmt::print("{:>{}.4f}", c.values[i], c.name.size() > 10 ? 20 : 12);
    }
    fmt::print("\n");
  }
}

nlohmann::ordered_json as_json(const std::string& title, const std::vector<CsvColumn>& table) {
  nlohmann::ordered_json out{{"title", title}};
  for (const CsvColumn& c : table) out[c.name] = c.values;
  return out;
}

}  // namespace

ExitCode command_creep_curve(const CommandOptions& options) {
  const LoadedCase loaded = load_case_of(options);
  const std::filesystem::path out = output_folder_of(options, loaded, "-creep-curve");
  BemOptions bem;
  bem.cell = cell_size(options.cell);
  const Placement placement = place(loaded.spec, loaded.folder());
  require_memory(half_space_need(loaded.spec, placement, bem.cell), bem.cell);
  answer_interrupt_with("\nstopped: nothing was written\n");
  const std::vector<CsvColumn> table = [&] {
    const Waiting waiting(fmt::format("creep curve of {} points", options.creep_curve.points),
                          spdlog::should_log(spdlog::level::info));
    return table_of(creep_curve(loaded.spec, placement, creepages(options), bem));
  }();

  const FolderHold hold = prepare_output_folder(out, options.force);
  write_origin(out, loaded, options.command_line, options.threads);
  std::vector<std::string> origin = table_origin(loaded);
  origin.back() =
      "F_x/(f F_z) on the wheel against longitudinal creepage; full: half-space theory with the case's layers; the "
      "others: the Hertz ellipse, homogeneous bodies";
  write_csv(out / "creep_curve.csv", origin, table);
  if (options.json)
    fmt::print("{}\n", as_json(loaded.spec.title, table).dump(2));
  else
    print_table(table);
  spdlog::info("results are in {}", out.string());
  return ExitCode::ok;
}

}  // namespace railstrata
