#include "many/creep_curve.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "many/axis.hpp"
#include "record/output_file.hpp"
#include "report/page.hpp"

namespace railstrata {
namespace {

constexpr CurveAxis kAxes[] = {{"creepage", VariedCreepage::longitudinal, "creepage", "F_x",
                                "longitudinal creepage (negative: driving)", -1, 0.02, 0.5},
                               {"lateral_creepage", VariedCreepage::lateral, "lateral_creepage", "lateral force",
                                "lateral creepage", 1, 0.02, 0.5},
                               {"spin", VariedCreepage::spin, "spin_per_m", "lateral force", "spin [1/m]", 1, 5, 1000}};

struct Chart {
  const char *id, *title, *note, *y;
};
constexpr Chart kCharts[] = {
    {"creep", "Creep curve", "Force on the wheel over friction limit. Kalker's linear theory is in the table.",
     "force / (f F_n)"},
    {"slip", "Slip", "By the full theory.", "slip area / patch area"},
    {"across", "The other force", "By the full theory, on the wheel.", "other force / (f F_n)"},
    {"moment", "Moment about the contact normal", "By the full theory, on the wheel.", "moment / (f F_n) [mm]"}};

/// A column with its line on a chart.
struct CurveColumn {
  const char *name, *heading;
  double (*value)(const CreepCurvePoint&);
  std::string_view chart = {};
  const char *line = "full half-space theory, with the case's layers", *dash = "solid";
};
constexpr CurveColumn kColumns[] = {
    {"full", "full theory", [](const CreepCurvePoint& p) { return 0.0 - p.full; }, "creep"},
    {"fastsim", "FASTSIM", [](const CreepCurvePoint& p) { return 0.0 - p.fastsim; }, "creep", "FASTSIM, Hertz ellipse",
     "dash"},
    {"polach", "Polach", [](const CreepCurvePoint& p) { return 0.0 - p.polach; }, "creep", "Polach", "dot"},
    {"vermeulen_johnson", "Vermeulen-Johnson", [](const CreepCurvePoint& p) { return 0.0 - p.vermeulen_johnson; },
     "creep", "Vermeulen-Johnson", "dashdot"},
    {"linear", "Kalker, linear", [](const CreepCurvePoint& p) { return 0.0 - p.linear; }},
    {"slip_area_fraction", "slip area / patch area", [](const CreepCurvePoint& p) { return p.slip_fraction; }, "slip"},
    {"full_across", "other force", [](const CreepCurvePoint& p) { return 0.0 - p.across; }, "across"},
    {"full_moment_mm", "moment [mm]", [](const CreepCurvePoint& p) { return 0.0 - 1e3 * p.moment; }, "moment"}};

ReportTable points_of(const CurveAxis& axis, const std::vector<CsvColumn>& table) {
  ReportTable out{.id = "points",
                  .title = "Points",
                  .note = "Forces and moment over f F_n, on the wheel. creep_curve.csv has every digit.",
                  .columns = {axis.title},
                  .rows = {}};
  for (const CurveColumn& c : kColumns) out.columns.emplace_back(c.heading);
  for (std::size_t i = 0; i < table.front().values.size(); ++i) {
    auto& row = out.rows.emplace_back();
    for (const CsvColumn& c : table) row.emplace_back(c.values[i]);
  }
  return out;
}

}  // namespace

std::vector<std::string> creep_curve_words() {
  std::vector<std::string> out;
  for (const CurveAxis& axis : kAxes) out.emplace_back(axis.word);
  return out;
}

const CurveAxis& curve_axis(const std::string& word) {
  return *std::find_if(std::begin(kAxes), std::end(kAxes), [&](const CurveAxis& axis) { return axis.word == word; });
}

std::vector<double> curve_values(const CurveAxis& axis, double largest, int points, bool both_sides) {
  std::vector<double> out;
  for (int i = 0; i < points; ++i) out.push_back(axis.side * largest * decade_share(i, points - 1));
  if (!both_sides) return out;
  std::vector<double> whole;
  for (auto c = out.rbegin(); c != out.rend(); ++c) whole.push_back(-std::abs(*c));
  whole.push_back(0);
  for (const double c : out) whole.push_back(std::abs(c));
  return whole;
}

std::vector<CsvColumn> curve_table(const CurveAxis& axis, const std::vector<CreepCurvePoint>& curve) {
  std::vector<CsvColumn> out{{axis.column, {}}};
  for (const CurveColumn& c : kColumns) out.push_back({c.name, {}});
  for (const CreepCurvePoint& p : curve) {
    out.front().values.push_back(p.creepage);
    for (std::size_t k = 0; k < std::size(kColumns); ++k) out[k + 1].values.push_back(kColumns[k].value(p));
  }
  return out;
}

void write_creep_curve_page(const std::filesystem::path& page, const std::string& title, const CurveAxis& axis,
                            const std::vector<CsvColumn>& table, const std::vector<std::string>& notes) {
  Report report;
  report.title = fmt::format("{}: creep curve", title);
  for (const Chart& c : kCharts) {
    ReportChart& chart = report.charts.emplace_back(ReportChart{c.id, c.title, c.note, axis.title, c.y, {}});
    for (std::size_t k = 0; k < std::size(kColumns); ++k)
      if (kColumns[k].chart == c.id)
        chart.series.push_back(
            {.name = kColumns[k].line, .x = table.front().values, .y = table[k + 1].values, .dash = kColumns[k].dash});
  }
  report.charts.front().y = fmt::format("{} / (f F_n)", axis.force);
  if (!notes.empty()) report.charts.front().note += fmt::format(" {}", fmt::join(notes, " "));
  report.tables = {points_of(axis, table)};
  write_whole_file(page, report_page(report));
}

}  // namespace railstrata
