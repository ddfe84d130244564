#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

#include "app/commands.hpp"
#include "app/common_options.hpp"
#include "core/faults.hpp"
#include "core/printable.hpp"
#include "io/csv.hpp"
#include "io/json_text.hpp"
#include "io/output_file.hpp"
#include "io/output_folder.hpp"
#include "io/provenance.hpp"
#include "io/result_doubts.hpp"
#include "io/result_folder.hpp"
#include "report/comparison_picture.hpp"
#include "result/compare.hpp"
#include "result/result_table.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

struct Quantity {
  const char *name, *unit, *key, *path;  ///< for people; for JSON, in SI units; where summary.json has it
  double scale;                          ///< SI to unit
};
constexpr Quantity kQuantities[] = {
    {"p_max", "MPa", "p_max_Pa", "/contact/p_max_Pa", 1e-6},
    {"q_max", "MPa", "q_max_Pa", "/contact/q_max_Pa", 1e-6},
    {"patch length", "mm", "patch_length_m", "/contact/patch_length_m", 1e3},
    {"patch width", "mm", "patch_width_m", "/contact/patch_width_m", 1e3},
    {"patch area", "mm2", "patch_area_m2", "/contact/patch_area_m2", 1e6},
    {"slip area fraction", "", "slip_area_fraction", "/contact/slip_area_fraction", 1},
    {"F_x", "kN", "F_x_N", "/contact/F_x_N", 1e-3},
    {"F_y", "kN", "F_y_N", "/contact/F_y_N", 1e-3},
    {"F_z", "kN", "F_z_N", "/contact/F_z_N", 1e-3},
    {"normal force in contact plane", "kN", "normal_force_N", "/contact/normal_force_N", 1e-3},
    {"lateral force in contact plane", "kN", "lateral_force_N", "/contact/lateral_force_N", 1e-3},
    {"creepage x", "1e-3", "creepage_x", "/contact/creepage_x", 1e3},
    {"spin", "1/m", "spin_per_m", "/contact/spin_per_m", 1},
    {"rail von Mises below surface", "MPa", "rail_subsurface_von_mises_Pa",
     "/stress/rail/subsurface/von_mises_max/value_Pa", 1e-6},
    {"its depth", "mm", "rail_subsurface_von_mises_depth_m", "/stress/rail/subsurface/von_mises_max/depth_m", 1e3},
    {"rail von Mises at surface", "MPa", "rail_surface_von_mises_Pa", "/stress/rail/surface/von_mises_max/value_Pa",
     1e-6},
};

struct Row {
  const Quantity& quantity;
  double a, b;         ///< SI
  double noise = 0;    ///< below it is what round-off leaves
  std::string of_a{};  ///< patch
  std::string of_b{};
  double shown(double v) const { return std::abs(v) <= noise ? 0 : v; }
  /// Of noise there is no share.
  double relative() const {
    return std::abs(b) <= noise ? std::numeric_limits<double>::quiet_NaN() : (a - b) / std::abs(b);
  }
};

std::size_t patches_of(const ResultFolder& r) { return 1 + r.further.size(); }

/// What a number of a result is of: "patch", "patch 1 of 2", "2 patches".
std::string of_text(const ResultFolder& r, const ResultNumber* n) {
  const std::size_t patches = patches_of(r);
  if (patches == 1) return "patch";
  return n && n->of_all_patches ? fmt::format("{} patches", patches) : fmt::format("patch 1 of {}", patches);
}

double noise_of(const ResultFolder& r, const ResultNumber* n) {
  if (!n) return 0;
  return round_off_size(n->round_off, [&](std::string_view path) { return r.number(std::string(path)); });
}

std::vector<Row> rows_of(const ResultFolder& a, const ResultFolder& b) {
  std::vector<Row> rows;
  for (const Quantity& q : kQuantities) {
    const ResultNumber* n = find_number(q.path);
    rows.push_back({q, a.number(q.path), b.number(q.path), std::max(noise_of(a, n), noise_of(b, n)), of_text(a, n),
                    of_text(b, n)});
  }
  return rows;
}

/// Of the largest pressure, m.
double place_of(const ResultFolder& r) {
  return r.field.y[static_cast<std::size_t>(std::max_element(r.field.p.begin(), r.field.p.end()) - r.field.p.begin())];
}

/// What the table cannot say.
std::vector<std::string> notes_of(const ResultFolder& a, const ResultFolder& b) {
  std::vector<std::string> out;
  for (const auto& [name, r] : {std::pair{"A", &a}, std::pair{"B", &b}})
    if (patches_of(*r) > 1)
      out.push_back(fmt::format(
          "{} touches at {} places: compared is the patch with the largest pressure (patch 1), but F_x, F_y "
          "and F_z are those of all",
          name, patches_of(*r)));
  const double apart = std::abs(place_of(a) - place_of(b)), width = a.number("/contact/patch_width_m");
  if (apart > 0.5 * width)
    out.push_back(
        fmt::format("the patches lie at different places: the largest pressure of A at y = {} mm, of B at y = {} mm "
                    "(model frame)",
                    fixed(1e3 * place_of(a), 1), fixed(1e3 * place_of(b), 1)));
  return out;
}

std::string number(double v, const char* format) {
  return std::isfinite(v) ? fmt::format(fmt::runtime(format), v) : "-";
}

void print_table(const ResultFolder& a, const ResultFolder& b, const std::vector<Row>& rows, const FieldComparison& g) {
  fmt::print("A  {} ({}): {}\nB  {} ({}): {}\n\n", printable(a.folder.string()), a.engine, printable(a.title),
             printable(b.folder.string()), b.engine, printable(b.title));
  const bool several = patches_of(a) > 1 || patches_of(b) > 1;
  fmt::print("  {:<36} {:>12} {:>12} {:>12}{}\n", "", "A", "B", "(A-B)/|B|", several ? "  of" : "");
  for (const Row& r : rows) {
    const Quantity& q = r.quantity;
    fmt::print("  {:<36} {:>12} {:>12} {:>12}{}\n", fmt::format("{}{}{}", q.name, *q.unit ? ", " : "", q.unit),
               number(q.scale * r.shown(r.a), "{:.4g}"), number(q.scale * r.shown(r.b), "{:.4g}"),
               number(100 * r.relative(), "{:+.2f} %"), several ? fmt::format("  A: {}, B: {}", r.of_a, r.of_b) : "");
  }
  const auto field = [](const char* name, const FieldDifference& d) {
    if (std::isfinite(d.rms))
      fmt::print("  {:<4} over the patch: rms {:.2f} %, largest {:.2f} % of B's maximum, at x {}, y {} mm\n", name,
                 100 * d.rms, 100 * d.largest, fixed(1e3 * d.x, 2), fixed(1e3 * d.y, 2));
  };
  fmt::print("\n");
  field("p", g.p);
  field("|q|", g.q);
}

nlohmann::ordered_json value(double v) {
  return std::isfinite(v) ? nlohmann::ordered_json(v) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json as_json(const ResultFolder& a, const ResultFolder& b, const std::vector<Row>& rows,
                               const FieldComparison& g) {
  const auto side = [](const ResultFolder& r) {
    return nlohmann::ordered_json{
        {"folder", r.folder.string()}, {"engine", r.engine}, {"title", r.title}, {"patches", patches_of(r)}};
  };
  const auto field = [](const FieldDifference& d) {
    return nlohmann::ordered_json{
        {"rms_relative", value(d.rms)}, {"largest_relative", value(d.largest)}, {"x_m", d.x}, {"y_m", d.y}};
  };
  nlohmann::ordered_json out{{"a", side(a)}, {"b", side(b)}};
  for (const Row& r : rows)
    out["numbers"][r.quantity.key] = {{"a", value(r.a)},
                                      {"b", value(r.b)},
                                      {"relative_difference", value(r.relative())},
                                      {"of_a", r.of_a},
                                      {"of_b", r.of_b}};
  out["fields"] = {{"pressure", field(g.p)}, {"traction", field(g.q)}};
  out["notes"] = notes_of(a, b);
  return out;
}

std::string csv_text(const std::vector<Row>& rows) {
  std::string out = "quantity,unit,a,b,relative_difference,of_a,of_b\n";
  for (const Row& r : rows) {
    const Quantity& q = r.quantity;
    fmt::format_to(std::back_inserter(out), "{},{},{},{},{},{},{}\n", q.name, q.unit, q.scale * r.a, q.scale * r.b,
                   r.relative(), r.of_a, r.of_b);
  }
  return out;
}

void write_fields(const fs::path& file, const std::vector<std::string>& origin, const FieldComparison& g) {
  std::vector<CsvColumn> table{{"x_mm", {}},    {"y_mm", {}},    {"p_a_MPa", {}},
                               {"p_b_MPa", {}}, {"q_a_MPa", {}}, {"q_b_MPa", {}}};
  for (std::size_t k = 0; k < g.p_a.size(); ++k) {
    const double row[] = {1e3 * g.x[k / g.y.size()], 1e3 * g.y[k % g.y.size()], 1e-6 * g.p_a[k],
                          1e-6 * g.p_b[k],           1e-6 * g.q_a[k],           1e-6 * g.q_b[k]};
    for (std::size_t c = 0; c < table.size(); ++c) table[c].values.push_back(row[c]);
  }
  write_csv(file, origin, table);
}

FieldComparison compare_fields_of(const ResultFolder& a, const ResultFolder& b) {
  try {
    return compare_fields(a.field, b.field);
  } catch (const std::invalid_argument& e) {
    throw CaseError(fmt::format("{} and {} cannot be compared: {}", a.folder.string(), b.folder.string(), e.what()),
                    "compare folders that `railstrata run` or `railstrata bem` has written");
  }
}

std::string last_name(const fs::path& folder) {
  return fs::absolute(folder / "").lexically_normal().parent_path().filename().string();
}

ExitCode command_compare(const CommandOptions& options) {
  const ResultFolder a = read_result_folder(options.case_file), b = read_result_folder(options.reference);
  const fs::path out =
      options.out.empty() ? fs::path("results") / fmt::format("{}-against-{}", last_name(a.folder), last_name(b.folder))
                          : options.out;
  for (const ResultFolder* side : {&a, &b})
    for (const ResultDoubt& doubt : result_doubts(*side)) spdlog::warn("{}: {}", side->folder.string(), doubt.text);
  const FieldComparison comparison = compare_fields_of(a, b);
  const std::vector<Row> rows = rows_of(a, b);
  const nlohmann::ordered_json json = as_json(a, b, rows, comparison);

  const FolderHold hold = prepare_output_folder(out, options.force);
  const std::vector<std::string> origin{
      fmt::format("RailStrata {}", version_text()),
      fmt::format("a: {} ({}); b: {} ({})", a.folder.string(), a.engine, b.folder.string(), b.engine),
      "x from the axle in the rolling direction, y towards the field side; q: magnitude of the traction"};
  const std::string text = json_text(json, 2) + "\n";
  write_whole_file(out / "compare.json", text);
  write_whole_file(out / "compare.csv", csv_text(rows));
  write_fields(out / "fields.csv", origin, comparison);
  write_whole_file(out / "compare.svg",
                   comparison_svg({"A: " + last_name(a.folder) + " (" + a.engine + ")", a.field},
                                  {"B: " + last_name(b.folder) + " (" + b.engine + ")", b.field}, comparison));
  if (options.json)
    fmt::print("{}", text);
  else
    print_table(a, b, rows, comparison);
  for (const std::string& note : notes_of(a, b)) spdlog::info("{}", note);
  spdlog::info("results are in {}", out.string());
  return ExitCode::ok;
}

void declare_compare(CLI::App& sub, CommandOptions& options) {
  sub.add_option("a", options.case_file, "Result folder A")->required();
  sub.add_option("b", options.reference, "Result folder B: differences are relative to it")->required();
  add_output(sub, options, "results/<folder A>-against-<folder B>");
}

}  // namespace

const Command kCompareCommand{
    "compare", "Two results, of either engine, on one grid: a table, the differences of the fields, a picture",
    "Examples:\n  railstrata compare results/quick results/quick-bem\n  railstrata compare results/thin results/thick "
    "--out results/thin-against-thick\n",
    declare_compare, command_compare};

}  // namespace railstrata
