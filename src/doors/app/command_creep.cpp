#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

#include <nlohmann/json.hpp>

#include "app/case_of.hpp"
#include "app/common_options.hpp"
#include "app/control.hpp"
#include "app/progress.hpp"
#include "ask/half_space_need.hpp"
#include "creep/creep_curve.hpp"
#include "creep/creep_table_job.hpp"
#include "io/output_folder.hpp"
#include "record/csv.hpp"
#include "result/result_table.hpp"
#include "usetab/usetab_file.hpp"

namespace railstrata {
namespace {

struct CreepOptions {
  std::string of = "creepage";    ///< --of: the word of what varies along a curve
  double largest = 0;             ///< --largest: creepage, or spin in 1/m; 0: chosen
  int points = 21;                ///< --points
  bool both_sides = false;        ///< --both-sides: braking and driving, left and right
  std::vector<std::string> axes;  ///< --axis: a table in place of a curve
  std::string scaled;             ///< --scaled ANGLES:SPINS:SIZES; empty: a plain table
  int places = 200;               ///< --places, where interpolation is compared with direct solutions
  bool resume = false;            ///< --resume
  bool usetab = false;            ///< --usetab
  int usetab_cells = 20;          ///< --cells, along either axis of the ellipse
};

CurveAxis axis_of(const CreepOptions& own) {
  CurveAxis out = curve_axis(own.of);
  if (own.largest > out.bound)
    throw CaseError(fmt::format("--largest {:g} is out of range", own.largest),
                    fmt::format("write at most {:g} for --of {}", out.bound, out.word));
  if (own.largest > 0) out.largest = own.largest;
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

ExitCode creep_curve_in_folder(const CreepOptions& own, const CommandOptions& options) {
  const CurveAxis axis = axis_of(own);
  const std::vector<double> varied = curve_values(axis, axis.largest, own.points, own.both_sides);
  const LoadedCase loaded = load_case_of(options, uses::kCreepCurve);
  const std::filesystem::path out = output_folder_of(options, loaded, "-creep-curve");
  BemOptions bem;
  bem.cell = cell_size(options.cell);
  const Placement placement = place(loaded.spec, loaded.folder());
  require_memory(half_space_need(loaded.spec, placement, bem.cell), bem.cell);
  answer_interrupt_with("\nstopped: nothing was written\n");
  const std::vector<CsvColumn> table = [&] {
    const Waiting waiting(fmt::format("creep curve of {} points", varied.size()));
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

/// "10:7:9"
std::optional<ScaledCounts> scaled_counts(const std::string& text) {
  if (text.empty()) return std::nullopt;
  ScaledCounts out;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%d:%d:%d%c", &out.angles, &out.spins, &out.sizes, &rest) == 3)
    if (std::min({out.angles, out.spins, out.sizes}) >= 4 && std::max({out.angles, out.spins, out.sizes}) <= 1000)
      return out;
  throw CaseError(fmt::format("--scaled {}", text), "give three numbers from 4 to 1000: --scaled 10:7:9");
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

ExitCode creep_table_in_folder(const CreepOptions& own, const CommandOptions& options) {
  std::vector<NumberAxis> axes = parse_number_axes("--axis", own.axes);
  const LoadedCase base = load_case_of(options, uses::kCreepTable);
  CreepTableOrder order{job_order_of(options, output_folder_of(options, base, "-creep-table"), own.resume),
                        std::move(axes), scaled_counts(own.scaled), cell_size(options.cell), own.places};
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

ExitCode command_creep(const CreepOptions& own, const CommandOptions& options) {
  if (own.usetab) return write_usetab(own.usetab_cells, options);
  if (options.case_file.empty())
    throw CaseError("creep: no case was named", "name a case file; --usetab alone takes none");
  return own.axes.empty() ? creep_curve_in_folder(own, options) : creep_table_in_folder(own, options);
}

void declare_curve(CLI::App& sub, CreepOptions& own, CLI::Option* axis) {
  sub.add_option(
         "--of", own.of,
         "What varies along a curve: creepage (longitudinal, default), lateral_creepage or spin; the rest is as "
         "in the case")
      ->check(CLI::IsMember(creep_curve_words()))
      ->excludes(axis);
  sub.add_option("--largest", own.largest, "Of a curve: largest creepage (default: 0.02), or spin in 1/m (5)")
      ->check(CLI::Range(1e-6, 1000.0))
      ->check(finite())
      ->excludes(axis);
  sub.add_option("--points", own.points,
                 "Of a curve: creepages, spaced geometrically over two and a half decades (default: 21)")
      ->check(CLI::Range(2, 1000))
      ->excludes(axis);
  sub.add_flag("--both-sides", own.both_sides,
               "The curve through zero: driving and braking, slip to the gauge and to the field side")
      ->excludes(axis);
}

void declare_table(CLI::App& sub, CreepOptions& own, CLI::Option* axis) {
  sub.add_option(
         "--scaled", own.scaled,
         "A table in scaled creepages, with so many angles of creepage, spins and sizes of creepage (10:7:9); of "
         "the axes creepage_x, creepage_y and spin the ends count")
      ->type_name("ANGLES:SPINS:SIZES")
      ->needs(axis);
  sub.add_option("--places", own.places,
                 "Of a table: places where interpolation is compared with a solution (default: 200; 0: none)")
      ->check(CLI::Range(0, 100'000))
      ->needs(axis);
  sub.add_flag("--resume", own.resume, "Go on with a table that was stopped")->needs(axis);
}

CommandWork declare_creep(CLI::App& sub, CommandOptions& options) {
  const auto own = std::make_shared<CreepOptions>();
  add_case(sub, options);
  sub.get_option("case")->required(false);
  auto* axis =
      add_repeated(sub, "--axis", own->axes, "WORD=VALUES",
                   "A table in place of a curve, over this axis: creepage_x, creepage_y, spin, load, friction, "
                   "lateral_shift, yaw or a key of the case; values \"v1,v2,...\", \"from:to:count\" or, dense about "
                   "0, \"+-largest:count\"; once for each axis");
  declare_curve(sub, *own, axis);
  declare_table(sub, *own, axis);
  auto* usetab = sub.add_flag("--usetab", own->usetab,
                              "Kalker's table of ellipses of steel, as programs with a USETAB reader take it; no case")
                     ->excludes(axis);
  sub.add_option("--cells", own->usetab_cells, "Of --usetab: cells along either axis of the ellipse (default: 20)")
      ->check(CLI::Range(6, 100))
      ->needs(usetab);
  add_output(sub, options, "results/<case name>-creep-curve, -creep-table, results/usetab");
  add_cell(sub, options);
  add_no_report(sub, options);
  return [own, &options] { return command_creep(*own, options); };
}

}  // namespace

extern const Command kCreepCommand{
    "creep", "Creep forces: a curve against creepage or spin, or a table over axes of your choice for vehicle codes",
    "Examples:\n  railstrata creep cases/paper/base.toml\n  railstrata creep cases/paper/layer_3mm_2E0.toml --of "
    "lateral_creepage --both-sides --set drive.traction_coefficient=0\n  railstrata creep cases/paper/base.toml --axis "
    "creepage_x=+-0.02:21 --axis creepage_y=+-0.02:21 --axis load=\"40 kN,80 kN,120 kN\" --out results/table\n  "
    "railstrata creep cases/paper/base.toml --scaled 10:7:9 --axis creepage_x=-0.02,0.02 --axis "
    "creepage_y=-0.02,0.02 --axis spin=\"-0.5,0.5 1/m\" --out results/scaled-table\n  railstrata creep --usetab "
    "--out results/usetab\n\nCtrl-C: a table keeps what is solved, --resume goes on with it.\n",
    declare_creep};

}  // namespace railstrata
