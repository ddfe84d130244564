#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <nlohmann/json.hpp>

#include "app/case_of.hpp"
#include "app/creep_kinds.hpp"
#include "app/option_values.hpp"
#include "app/waiting.hpp"
#include "ask/half_space_need.hpp"
#include "core/faults.hpp"
#include "creep/creep_curve.hpp"
#include "io/output_folder.hpp"
#include "record/csv.hpp"
#include "result/result_table.hpp"

namespace railstrata {
namespace {

CurveAxis axis_of(const CreepCurveOptions& options) {
  CurveAxis out = curve_axis(options.of);
  if (options.largest > out.bound)
    throw CaseError(fmt::format("--largest {:g} is out of range", options.largest),
                    fmt::format("write at most {:g} for --of {}", out.bound, out.word));
  if (options.largest > 0) out.largest = options.largest;
  return out;
}

/// Wide enough for the name and a blank.
std::size_t width(const CsvColumn& c) { return c.name.size() > 10 ? 20 : 12; }

void print_table(const CurveAxis& axis, const std::vector<CsvColumn>& table) {
  fmt::print("{}/(f F_n) on the wheel; a driving wheel has creepage < 0 and F_x > 0\n\n", axis.force);
  for (const CsvColumn& c : table) fmt::print("{:>{}}", c.name, width(c));
  fmt::print("\n");
  for (std::size_t i = 0; i < table.front().values.size(); ++i) {
    for (const CsvColumn& c : table) {
      if (&c == &table.front())
        fmt::print("{:>{}.3e}", c.values[i], width(c));
      else
        fmt::print("{:>{}}", fixed(c.values[i], 4), width(c));
    }
    fmt::print("\n");
  }
}

nlohmann::ordered_json as_json(const std::string& title, const std::vector<CsvColumn>& table,
                               const std::vector<std::string>& notes) {
  nlohmann::ordered_json out{{"title", title}};
  for (const CsvColumn& c : table) out[c.name] = c.values;
  out["notes"] = notes;
  return out;
}

}  // namespace

ExitCode creep_curve_in_folder(const CreepCurveOptions& wanted, const CommandOptions& options) {
  const CurveAxis axis = axis_of(wanted);
  const std::vector<double> varied = curve_values(axis, axis.largest, wanted.points, wanted.both_sides);
  const LoadedCase loaded = load_case_of(options, uses::kCreepCurve);
  const std::filesystem::path out = output_folder_of(options, loaded, "-creep-curve");
  BemOptions bem;
  bem.cell = cell_size(options.cell);
  const Placement placement = place(loaded.spec, loaded.folder());
  require_memory(half_space_need(loaded.spec, placement, bem.cell), bem.cell);
  answer_interrupt_with("\nstopped: nothing was written\n");
  const std::vector<CsvColumn> table = [&] {
    const Waiting waiting(fmt::format("creep curve of {} points", varied.size()),
                          spdlog::should_log(spdlog::level::info));
    return curve_table(axis, creep_curve(loaded.spec, placement, axis.varied, varied, bem));
  }();

  const FolderHold hold = prepare_output_folder(out, options.force);
  write_origin(out, loaded, options.command_line, options.threads);
  std::vector<std::string> origin = table_origin(loaded);
  origin.back() = fmt::format(
      "{}/(f F_n) on the wheel against {}; full: half-space theory with the case's layers, its other force and its "
      "moment over f F_n beside it; the others: the Hertz ellipse, homogeneous bodies",
      axis.force, table.front().name);
  const std::vector<std::string> notes = idle_in(uses::kCreepCurve, loaded.spec);
  origin.insert(origin.end(), notes.begin(), notes.end());
  write_csv(out / "creep_curve.csv", origin, table);
  if (options.page) write_creep_curve_page(out / "report.html", loaded.spec.title, axis, table, notes);
  if (options.json)
    fmt::print("{}\n", as_json(loaded.spec.title, table, notes).dump(2));
  else
    print_table(axis, table);
  spdlog::info("results are in {}", out.string());
  return ExitCode::ok;
}

}  // namespace railstrata
