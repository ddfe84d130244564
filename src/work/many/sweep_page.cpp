#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "many/case_page.hpp"
#include "many/sweep.hpp"
#include "record/json.hpp"
#include "record/output_file.hpp"
#include "report/page.hpp"

namespace railstrata {
namespace {

constexpr std::size_t kMostLines = 12;

/// The axis along which the charts run: of those whose values are all numbers the one with most; null: there is none.
const Axis* along(const std::vector<Axis>& axes) {
  const Axis* best = nullptr;
  for (const Axis& axis : axes) {
    const bool numbers = std::all_of(axis.values.begin(), axis.values.end(),
                                     [](const std::string& v) { return std::isfinite(axis_value(v).first); });
    if (numbers && axis.values.size() > 1 && (!best || axis.values.size() > best->values.size())) best = &axis;
  }
  return best;
}

/// "thickness h 1 mm, friction coefficient 0.3": the values of all keys but one.
std::string line_name(const CaseRow& row, const std::string& without) {
  std::string out;
  for (const auto& [key, value] : row.values)
    if (key != without) out += fmt::format("{}{} {}", out.empty() ? "" : ", ", key_name(key), shown_value(value));
  return out.empty() ? "all cases" : out;
}

std::vector<LinePoint> points_over(const std::string& key, const std::vector<CaseRow>& rows) {
  std::vector<LinePoint> out;
  std::set<std::string> lines;
  for (const CaseRow& row : rows) {
    std::string name = line_name(row, key);
    if (lines.size() < kMostLines) lines.insert(name);
    if (lines.contains(name)) out.push_back({&row, std::move(name)});
  }
  return out;
}

}  // namespace

void write_sweep_page(const std::filesystem::path& page, const std::string& title, const std::vector<Axis>& axes,
                      const std::vector<CaseRow>& rows) {
  Report report;
  report.title = fmt::format("{}: sweep", title);
  report.answers = cases_answers(rows);
  if (const Axis* axis = along(axes)) {
    const std::vector<LinePoint> points = points_over(axis->key, rows);
    const std::string x = axis_title(key_name(axis->key), axis->values);
    const std::string note =
        points.size() < rows.size() ? fmt::format("The first {} lines; the table has all of them.", kMostLines) : "";
    for (const ResultColumn* column : shown_columns(rows)) {
      const std::string named = column_title(column->name);
      report.charts.push_back({column->name, named, note, x, named, {}});
      add_trend(report.charts.back(), axis->key, column->name, points);
    }
  }
  report.tables = {cases_table("sweep.csv has more columns and every digit.", value_columns(rows), rows)};
  write_whole_file(page, report_page(report));
}

}  // namespace railstrata
