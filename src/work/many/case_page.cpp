#include "many/case_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "many/axis.hpp"
#include "record/json.hpp"

namespace railstrata {
namespace {

constexpr const char* kShown[] = {"p_max",           "q_max",
                                  "patch_length",    "patch_width",
                                  "patch_area",      "slip_area_fraction",
                                  "creepage_x",      "rail_subsurface_von_mises",
                                  "rail_von_mises",  "rail_von_mises_depth",
                                  "section_sigma_1", "section_sigma_1_depth",
                                  "t_gamma"};

void add_point(ReportSeries& line, double x, double y) {
  const auto at = std::upper_bound(line.x.begin(), line.x.end(), x) - line.x.begin();
  line.x.insert(line.x.begin() + at, x);
  line.y.insert(line.y.begin() + at, y);
}

}  // namespace

std::vector<const ResultColumn*> shown_columns(const std::vector<CaseRow>& rows) {
  std::vector<const ResultColumn*> out;
  for (const char* symbol : kShown) {
    const ResultColumn& c = column_of(symbol);
    if (std::any_of(rows.begin(), rows.end(), [&](const CaseRow& row) { return std::isfinite(row.number(c.name)); }))
      out.push_back(&c);
  }
  return out;
}

void add_trend(ReportChart& chart, const std::string& key, const std::string& column,
               const std::vector<LinePoint>& points) {
  std::vector<double> all;
  for (const LinePoint& p : points)
    if (const double x = axis_value(p.row->value(key)).first; std::isfinite(x)) all.push_back(x);
  if (all.empty()) return;
  const auto [least, largest] = std::minmax_element(all.begin(), all.end());
  for (const LinePoint& p : points) {
    const double x = axis_value(p.row->value(key)).first, y = p.row->number(column);
    if (!std::isfinite(y)) continue;
    const auto same = [&](const ReportSeries& s) { return s.name == p.name; };
    auto line = std::find_if(chart.series.begin(), chart.series.end(), same);
    if (line == chart.series.end())
      line = chart.series.insert(line, {.name = p.name, .x = {}, .y = {}, .colour = p.colour, .dash = p.dash});
    if (std::isfinite(x)) {
      add_point(*line, x, y);
    } else {
      add_point(*line, *least, y);
      add_point(*line, *largest, y);
    }
  }
}

std::string axis_title(const std::string& name, const std::vector<std::string>& values) {
  const auto first = axis_value(values.empty() ? "" : values.front());
  return titled(name, std::isfinite(first.first) ? first.second : "");  // "R260" is no unit
}

CaseColumn number_column(const ResultColumn& column) {
  const ResultColumn* c = &column;
  return {titled(c->title, c->shown_unit.shown),
          [c](const CaseRow& row) { return json_number(row.number(c->name) * (c->shown_unit.factor / c->factor)); }};
}

ReportTable cases_table(const std::string& note, const std::vector<CaseColumn>& head,
                        const std::vector<CaseRow>& rows) {
  ReportTable t{.id = "cases", .title = "All cases", .note = note, .columns = {}, .rows = {}};
  std::vector<CaseColumn> columns = head;
  for (const ResultColumn* c : shown_columns(rows)) columns.push_back(number_column(*c));
  columns.push_back({"state", [](const CaseRow& row) {
                       return row.fault.empty() ? row.state : fmt::format("{}: {}", row.state, row.fault);
                     }});
  add_rows(t, rows, columns);
  return t;
}

}  // namespace railstrata
