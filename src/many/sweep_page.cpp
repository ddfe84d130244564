#include "many/sweep_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "io/output_file.hpp"
#include "report/page.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostLines = 12;

/// What the page shows of a case, as far as the sweep has computed it.
constexpr std::string_view kShown[] = {"p_max_MPa",          "q_max_MPa",  "patch_area_mm2",
                                       "slip_area_fraction", "creepage_x", "rail_subsurface_von_mises_MPa",
                                       "t_gamma_N"};

bool shown(const ResultColumn& column) {
  return std::find(std::begin(kShown), std::end(kShown), column.name) != std::end(kShown);
}

/// The place of the key along the axes: of those whose values are all numbers the one with most; -1: there is none.
int axis_key(const std::vector<Axis>& keys) {
  int best = -1;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const std::vector<std::string>& values = keys[k].values;
    const bool numbers = std::all_of(values.begin(), values.end(),
                                     [](const std::string& v) { return std::isfinite(axis_value(v).first); });
    if (numbers && values.size() > 1 &&
        (best < 0 || values.size() > keys[static_cast<std::size_t>(best)].values.size()))
      best = static_cast<int>(k);
  }
  return best;
}

/// "layer.0.thickness 1 mm, drive.friction_coefficient 0.3": the values of all keys but one.
std::string line_name(const std::vector<Axis>& keys, const SweepCase& c, int without) {
  std::string out;
  for (std::size_t k = 0; k < keys.size(); ++k)
    if (static_cast<int>(k) != without)
      out += fmt::format("{}{} {}", out.empty() ? "" : ", ", keys[k].key, c.values[k]);
  return out.empty() ? "all cases" : out;
}

/// The cases of each line in the order of their values.
ReportChart chart_of(const ResultColumn& column, const std::vector<Axis>& keys, int axis,
                     const std::vector<SweepCase>& cases) {
  const auto key = static_cast<std::size_t>(axis);
  const std::string unit = axis_value(keys[key].values.front()).second;
  ReportChart chart{std::string(column.name),
                    column_title(std::string(column.name)),
                    "",
                    fmt::format("{}{}", keys[key].key, unit.empty() ? "" : fmt::format(" [{}]", unit)),
                    column_title(std::string(column.name)),
                    {}};
  bool more = false;
  for (const SweepCase& c : cases) {
    const double y = column_value(column, c.summary);
    if (!c.done || !std::isfinite(y)) continue;
    const std::string name = line_name(keys, c, axis);
    auto line = std::find_if(chart.series.begin(), chart.series.end(), [&](const auto& s) { return s.name == name; });
    if (line == chart.series.end() && chart.series.size() == kMostLines) {
      more = true;
      continue;
    }
    if (line == chart.series.end()) line = chart.series.insert(chart.series.end(), {.name = name, .x = {}, .y = {}});
    const double x = axis_value(c.values[key]).first;
    const auto at = std::lower_bound(line->x.begin(), line->x.end(), x) - line->x.begin();
    line->x.insert(line->x.begin() + at, x);
    line->y.insert(line->y.begin() + at, y);
  }
  if (more) chart.note = fmt::format("The first {} lines; the table has all.", kMostLines);
  return chart;
}

ReportTable table_of(const std::vector<Axis>& keys, const std::vector<SweepCase>& cases,
                     const std::vector<ResultColumn>& columns) {
  ReportTable out{.id = "cases",
                  .title = "Cases",
                  .note = "sweep.csv has more columns and every digit.",
                  .columns = {},
                  .rows = {}};
  for (const Axis& key : keys) out.columns.push_back(key.key);
  for (const ResultColumn& c : columns)
    if (shown(c)) out.columns.push_back(column_title(std::string(c.name)));
  out.columns.emplace_back("fault or failed check");
  for (const SweepCase& c : cases) {
    if (!c.done) continue;
    std::vector<Json> row(c.values.begin(), c.values.end());
    for (const ResultColumn& column : columns) {
      if (!shown(column)) continue;
      const double v = column_value(column, c.summary);
      row.push_back(std::isfinite(v) ? Json(v) : Json(nullptr));
    }
    row.emplace_back(c.fault);
    out.rows.push_back(std::move(row));
  }
  return out;
}

}  // namespace

void write_sweep_page(const std::filesystem::path& page, const std::string& title, const std::vector<Axis>& keys,
                      const std::vector<SweepCase>& cases, const std::vector<ResultColumn>& columns) {
  Report report;
  report.title = fmt::format("{}: sweep", title);
  const int axis = axis_key(keys);
  for (const ResultColumn& column : columns) {
    if (axis < 0 || !shown(column)) continue;
    ReportChart chart = chart_of(column, keys, axis, cases);
    if (!chart.series.empty()) report.charts.push_back(std::move(chart));
  }
  report.tables = {table_of(keys, cases, columns)};
  write_whole_file(page, report_page(report));
}

}  // namespace railstrata
