#include "many/case_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "many/axis.hpp"

namespace railstrata {
namespace {

constexpr const char* kShown[] = {"p_max_MPa",
                                  "q_max_MPa",
                                  "patch_length_mm",
                                  "patch_width_mm",
                                  "patch_area_mm2",
                                  "slip_area_fraction",
                                  "creepage_x",
                                  "rail_subsurface_von_mises_MPa",
                                  "rail_von_mises_MPa",
                                  "rail_von_mises_depth_mm",
                                  "section_sigma_1_MPa",
                                  "section_sigma_1_depth_mm",
                                  "t_gamma_N"};

void add_point(ReportSeries& line, double x, double y) {
  const auto at = std::upper_bound(line.x.begin(), line.x.end(), x) - line.x.begin();
  line.x.insert(line.x.begin() + at, x);
  line.y.insert(line.y.begin() + at, y);
}

}  // namespace

std::vector<std::string> shown_columns(const std::vector<CaseRow>& rows) {
  std::vector<std::string> out;
  for (const char* name : kShown)
    if (std::any_of(rows.begin(), rows.end(), [&](const CaseRow& row) { return std::isfinite(row.number(name)); }))
      out.emplace_back(name);
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
  const std::string unit = values.empty() ? "" : axis_value(values.front()).second;
  return unit.empty() ? name : fmt::format("{} [{}]", name, unit);
}

ReportTable cases_table(const std::string& note, const std::vector<CaseColumn>& head,
                        const std::vector<CaseRow>& rows) {
  ReportTable t{.id = "cases", .title = "All cases", .note = note, .columns = {}, .rows = {}};
  for (const CaseColumn& c : head) t.columns.push_back(c.name);
  std::vector<const ResultColumn*> shown;
  for (const std::string& name : shown_columns(rows)) {
    shown.push_back(find_column(name));
    const auto& unit = shown.back()->shown_unit.shown;
    t.columns.push_back(unit.empty() ? shown.back()->title : fmt::format("{} [{}]", shown.back()->title, unit));
  }
  t.columns.emplace_back("state");
  for (const CaseRow& r : rows) {
    std::vector<nlohmann::ordered_json>& row = t.rows.emplace_back();
    for (const CaseColumn& c : head) row.push_back(c.cell(r));
    for (const ResultColumn* c : shown)
      row.push_back(number_cell(r.number(c->name) * (c->shown_unit.factor / c->factor)));
    row.emplace_back(r.fault.empty() ? r.state : fmt::format("{}: {}", r.state, r.fault));
  }
  return t;
}

}  // namespace railstrata
