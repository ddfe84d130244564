#include "many/case_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

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

/// Without a strength: where the largest pressure lies.
std::vector<ReportAnswer> numbers_answer(const std::vector<CaseRow>& rows) {
  const ResultColumn& column = column_of("p_max");
  const auto less = [&](const CaseRow& a, const CaseRow& b) { return a.number(column.name) < b.number(column.name); };
  std::vector<CaseRow> done;
  for (const CaseRow& row : rows)
    if (std::isfinite(row.number(column.name))) done.push_back(row);
  const std::string title = fmt::format("{} of {} cases have a result", done.size(), rows.size());
  if (done.empty()) return {{"bad", title, ""}};
  const auto [low, high] = std::minmax_element(done.begin(), done.end(), less);
  const auto where = [](const CaseRow& row) {
    std::string out;
    for (const auto& [key, value] : row.values)
      out += fmt::format("{}{} {}", out.empty() ? "" : ", ", key_name(key), shown_value(value));
    return out;
  };
  return {{"plain", title,
           fmt::format(
               "p_max from {:.0f} MPa ({}) to {:.0f} MPa ({}); without a strength it is not known whether they last",
               low->number(column.name), where(*low), high->number(column.name), where(*high))}};
}

}  // namespace

std::string key_name(const std::string& key) {
  static const std::map<std::string, std::string> names{{"layer.0.thickness", "thickness h"},
                                                        {"layer.0.young_ratio", "E₁/E₀"},
                                                        {"drive.traction_coefficient", "F_T/G"},
                                                        {"layer.0.elements", "elements through the layer"}};
  const auto known = names.find(key);
  if (known != names.end()) return known->second;
  std::string out = key.substr(key.rfind('.') + 1);
  std::replace(out.begin(), out.end(), '_', ' ');
  return out;
}

std::vector<ReportAnswer> cases_answers(const std::vector<CaseRow>& rows) {
  std::map<std::string, int> lasts, decides;
  int answered = 0;
  for (const CaseRow& row : rows) {
    if (row.remarks.lasts.empty()) continue;
    ++answered;
    ++lasts[row.remarks.lasts];
    if (row.remarks.lasts == "no") ++decides[row.remarks.decided_by];
  }
  if (answered == 0) return numbers_answer(rows);
  const int yes = lasts["yes"], no = lasts["no"];
  std::vector<std::string> by, rest;
  for (const auto& [zone, count] : decides) by.push_back(fmt::format("{} in {}", zone, count));
  if (no > 0)
    rest.push_back(fmt::format("{} {} not (decided by {})", no, no == 1 ? "does" : "do", fmt::join(by, ", ")));
  for (const auto& [word, count] : lasts)
    if (word != "yes" && word != "no") rest.push_back(fmt::format("{} {}", count, word));
  return {{yes == answered              ? "good"
           : yes == 0 && no == answered ? "bad"
                                        : "open",
           fmt::format("{} of {} cases last", yes, answered), fmt::format("{}", fmt::join(rest, ", "))}};
}

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
  for (const CaseColumn& answer : answer_columns(rows)) columns.push_back(answer);
  columns.push_back({"state", [](const CaseRow& row) {
                       return row.fault.empty() ? row.state : fmt::format("{}: {}", row.state, row.fault);
                     }});
  add_rows(t, rows, columns);
  return t;
}

}  // namespace railstrata
