#include "app/folder_comparison.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

#include "core/faults.hpp"
#include "core/printable.hpp"
#include "io/provenance.hpp"
#include "record/csv.hpp"
#include "record/json.hpp"
#include "record/output_file.hpp"
#include "report/pictures.hpp"
#include "result/result_table.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

struct Row {
  ResultColumn column;
  double a, b;         ///< SI
  double noise = 0;    ///< below it is what round-off leaves
  std::string of_a{};  ///< patch
  std::string of_b{};
  double shown(double v) const { return std::abs(v) <= noise ? 0 : v; }
  /// NaN where b is not above the noise.
  double relative() const {
    return std::abs(b) <= noise ? std::numeric_limits<double>::quiet_NaN() : (a - b) / std::abs(b);
  }
};

std::size_t patches_of(const ResultFolder& r) { return 1 + r.further.size(); }

/// The part of the contact that a number belongs to: "patch", "patch 1 of 2", "2 patches".
std::string of_text(const ResultFolder& r, const ResultColumn& column) {
  const std::size_t patches = patches_of(r);
  if (patches == 1) return "patch";
  return column.of_all_patches ? fmt::format("{} patches", patches) : fmt::format("patch 1 of {}", patches);
}

double noise_of(const ResultFolder& r, const ResultNumber* n) {
  if (!n) return 0;
  return round_off_size(n->round_off, [&](std::string_view path) { return r.number(std::string(path)); });
}

/// The columns of tables that either result has, but for the time it took.
std::vector<Row> rows_of(const ResultFolder& a, const ResultFolder& b) {
  std::vector<Row> rows;
  for (const ResultColumn& c : table_columns()) {
    const double of_a = a.number(c.path), of_b = b.number(c.path);
    if (c.path.starts_with("/run/") || c.is_error_bar() || (std::isnan(of_a) && std::isnan(of_b))) continue;
    const ResultNumber* n = find_number(c.path);
    rows.push_back({c, of_a, of_b, std::max(noise_of(a, n), noise_of(b, n)), of_text(a, c), of_text(b, c)});
  }
  return rows;
}

/// y of the largest pressure, m.
double place_of(const ResultFolder& r) {
  return r.field.y[static_cast<std::size_t>(std::max_element(r.field.p.begin(), r.field.p.end()) - r.field.p.begin())];
}

/// Notes on differences that the table does not show.
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
    const Unit& unit = r.column.shown_unit;
    fmt::print("  {:<36} {:>12} {:>12} {:>12}{}\n",
               fmt::format("{}{}{}", r.column.title, unit.shown.empty() ? "" : ", ", unit.shown),
               number(unit.factor * r.shown(r.a), "{:.4g}"), number(unit.factor * r.shown(r.b), "{:.4g}"),
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

nlohmann::ordered_json as_json(const ResultFolder& a, const ResultFolder& b, const std::vector<Row>& rows,
                               const FieldComparison& g) {
  const auto side = [](const ResultFolder& r) {
    return nlohmann::ordered_json{
        {"folder", r.folder.string()}, {"engine", r.engine}, {"title", r.title}, {"patches", patches_of(r)}};
  };
  const auto field = [](const FieldDifference& d) {
    return nlohmann::ordered_json{
        {"rms_relative", json_number(d.rms)}, {"largest_relative", json_number(d.largest)}, {"x_m", d.x}, {"y_m", d.y}};
  };
  nlohmann::ordered_json out{{"a", side(a)}, {"b", side(b)}};
  for (const Row& r : rows)
    out["numbers"][r.column.key()] = {{"a", json_number(r.a)},
                                      {"b", json_number(r.b)},
                                      {"relative_difference", json_number(r.relative())},
                                      {"of_a", r.of_a},
                                      {"of_b", r.of_b}};
  out["fields"] = {{"pressure", field(g.p)}, {"traction", field(g.q)}};
  out["notes"] = notes_of(a, b);
  return out;
}

std::string csv_text(const std::vector<Row>& rows) {
  std::string out = "quantity,a,b,relative_difference,of_a,of_b\n";
  for (const Row& r : rows) {
    const ResultColumn& c = r.column;
    fmt::format_to(std::back_inserter(out), "{},{},{},{},{},{}\n", c.name, c.factor * r.a, c.factor * r.b, r.relative(),
                   r.of_a, r.of_b);
  }
  return out;
}

void write_fields(const fs::path& file, const std::vector<std::string>& origin, const FieldComparison& g) {
  struct Point {
    double x, y, p_a, p_b, q_a, q_b;
  };
  std::vector<Point> points;
  for (std::size_t k = 0; k < g.p_a.size(); ++k)
    points.push_back({g.x[k / g.y.size()], g.y[k % g.y.size()], g.p_a[k], g.p_b[k], g.q_a[k], g.q_b[k]});
  write_csv(file, origin, points,
            Columns<Point>{{"x", unit::kMillimetres, &Point::x},
                           {"y", unit::kMillimetres, &Point::y},
                           {"p_a", unit::kMPa, &Point::p_a},
                           {"p_b", unit::kMPa, &Point::p_b},
                           {"q_a", unit::kMPa, &Point::q_a},
                           {"q_b", unit::kMPa, &Point::q_b}});
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

}  // namespace

fs::path comparison_folder(const fs::path& a, const fs::path& b) {
  return fs::path("results") / fmt::format("{}-against-{}", last_name(a), last_name(b));
}

FolderComparison::FolderComparison(const fs::path& folder_a, const fs::path& folder_b)
    : a_(read_result_folder(folder_a)), b_(read_result_folder(folder_b)) {
  for (const ResultFolder* side : {&a_, &b_})
    for (const ResultDoubt& doubt : result_doubts(*side)) spdlog::warn("{}: {}", side->folder.string(), doubt.text);
  fields_ = compare_fields_of(a_, b_);
}

void FolderComparison::write(const fs::path& out) const {
  const std::vector<std::string> origin{
      fmt::format("RailStrata {}", version_text()),
      fmt::format("a: {} ({}); b: {} ({})", a_.folder.string(), a_.engine, b_.folder.string(), b_.engine),
      "x from the axle in the rolling direction, y towards the field side; q: magnitude of the traction"};
  const std::vector<Row> rows = rows_of(a_, b_);
  write_whole_file(out / "compare.json", json_text(as_json(a_, b_, rows, fields_), 2) + "\n");
  write_whole_file(out / "compare.csv", csv_text(rows));
  write_fields(out / "fields.csv", origin, fields_);
  write_whole_file(out / "compare.svg",
                   comparison_svg({"A: " + last_name(a_.folder) + " (" + a_.engine + ")", a_.field},
                                  {"B: " + last_name(b_.folder) + " (" + b_.engine + ")", b_.field}, fields_));
}

void FolderComparison::print(bool json) const {
  const std::vector<Row> rows = rows_of(a_, b_);
  if (json)
    fmt::print("{}\n", json_text(as_json(a_, b_, rows, fields_), 2));
  else
    print_table(a_, b_, rows, fields_);
  for (const std::string& note : notes_of(a_, b_)) spdlog::info("{}", note);
}

}  // namespace railstrata
