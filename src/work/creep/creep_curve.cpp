#include "creep/creep_curve.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "many/axis.hpp"
#include "record/number_text.hpp"
#include "record/output_file.hpp"
#include "report/page.hpp"

namespace railstrata {
namespace {

constexpr CurveAxis kAxes[] = {
    {"creepage", VariedCreepage::longitudinal, unit::kNone, "F_x", "longitudinal creepage (negative: driving)", -1,
     0.02, 0.5},
    {"lateral_creepage", VariedCreepage::lateral, unit::kNone, "lateral force", "lateral creepage", 1, 0.02, 0.5},
    {"spin", VariedCreepage::spin, unit::kPerMetre, "lateral force", "spin", 1, 5, 1000}};

struct Chart {
  const char *id, *title, *note, *y;
};
constexpr Chart kCharts[] = {
    {"creep", "Creep curve", "Force on the wheel over friction limit. Kalker's linear theory is in the table.",
     "force / (f F_n)"},
    {"slip", "Slip", "By the full theory.", "slip area / patch area"},
    {"across", "The other force", "By the full theory, on the wheel.", "other force / (f F_n)"},
    {"moment", "Moment about the contact normal", "By the full theory, on the wheel.", "moment / (f F_n)"}};

using P = CreepCurvePoint;
/// A column with its line on a chart.
struct CurveColumn {
  const char* symbol;
  Unit unit;
  std::function<double(const P&)> value;
  const char* heading;
  std::string_view chart = {};
  const char *line = "full half-space theory, with the case's layers", *dash = "solid";
};
std::function<double(const P&)> on_wheel(double P::*on_rail) {
  return [on_rail](const P& p) { return 0.0 - p.*on_rail; };
}
const CurveColumn kColumns[] = {
    {"full", unit::kNone, on_wheel(&P::full), "full theory", "creep"},
    {"fastsim", unit::kNone, on_wheel(&P::fastsim), "FASTSIM", "creep", "FASTSIM, Hertz ellipse", "dash"},
    {"polach", unit::kNone, on_wheel(&P::polach), "Polach", "creep", "Polach", "dot"},
    {"vermeulen_johnson", unit::kNone, on_wheel(&P::vermeulen_johnson), "Vermeulen-Johnson", "creep",
     "Vermeulen-Johnson", "dashdot"},
    {"linear", unit::kNone, on_wheel(&P::linear), "Kalker, linear"},
    {"slip_area_fraction", unit::kNone, &P::slip_fraction, "slip area / patch area", "slip"},
    {"full_across", unit::kNone, on_wheel(&P::across), "other force", "across"},
    {"full_moment", unit::kMillimetres, on_wheel(&P::moment), "moment", "moment"}};

ReportTable points_of(const CurveAxis& axis, const std::vector<CsvColumn>& table) {
  ReportTable out{.id = "points",
                  .title = "Points",
                  .note = "Forces and moment over f F_n, on the wheel. creep_curve.csv has every digit.",
                  .columns = {titled(axis.label, axis.unit.shown)},
                  .rows = {}};
  for (const CurveColumn& c : kColumns) out.columns.push_back(titled(c.heading, c.unit.shown));
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
  Columns<P> columns{axis.column()};
  for (const CurveColumn& c : kColumns) columns.push_back({c.symbol, c.unit, c.value});
  return csv_columns(curve, columns);
}

void write_creep_curve_page(const std::filesystem::path& page, const std::string& title, const CurveAxis& axis,
                            const std::vector<CsvColumn>& table, const std::vector<std::string>& notes) {
  Report report;
  report.title = fmt::format("{}: creep curve", title);
  for (const Chart& c : kCharts) {
    ReportChart& chart =
        report.charts.emplace_back(ReportChart{c.id, c.title, c.note, titled(axis.label, axis.unit.shown), c.y, {}});
    for (std::size_t k = 0; k < std::size(kColumns); ++k) {
      if (kColumns[k].chart != c.id) continue;
      chart.y = titled(c.y, kColumns[k].unit.shown);
      chart.series.push_back(
          {.name = kColumns[k].line, .x = table.front().values, .y = table[k + 1].values, .dash = kColumns[k].dash});
    }
  }
  report.charts.front().y = fmt::format("{} / (f F_n)", axis.force);
  if (!notes.empty()) report.charts.front().note += fmt::format(" {}", fmt::join(notes, " "));
  report.tables = {points_of(axis, table)};
  write_whole_file(page, report_page(report));
}

}  // namespace railstrata
