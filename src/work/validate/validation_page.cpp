#include "validate/validation_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "record/json.hpp"
#include "record/output_file.hpp"
#include "report/page.hpp"
#include "report/svg_page.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

std::string with_unit(double value, const std::string& unit) {
  return std::isfinite(value) ? fmt::format("{:.3g}{}{}", value, unit.empty() ? "" : " ", unit) : "";
}

/// "0.8 %", "1.2 K".
std::string measured_text(const ComparedColumn& c, double value) {
  if (c.by == DifferenceBy::factor) return with_unit(value, "times");
  return c.relative ? with_unit(100 * value, "%") : with_unit(value, c.unit);
}

/// Of a set of one row a number of it; of more: a chart shows them.
std::string single_text(const Comparison& c, double ComparedPoint::*value) {
  return c.points.size() == 1 ? with_unit(c.points.front().*value, c.column->unit) : "";
}

std::string title_of(const ComparedColumn& c) {
  return c.unit.empty() ? c.title : fmt::format("{} [{}]", c.title, c.unit);
}

/// More than one row, over a column that varies.
bool has_chart(const ValidationSet& set) { return set.data.rows() > 1 && !set.varied.empty(); }

/// The first varied column goes one way. Else the rows are no curve over it, and are drawn over the data themselves.
bool is_curve(const ValidationSet& set) {
  const std::vector<double> x = set.data.column(set.varied.front().column);
  return std::is_sorted(x.begin(), x.end()) || std::is_sorted(x.rbegin(), x.rend());
}

std::string axis_of(const ValidationSet& set, const ComparedColumn& column) {
  return is_curve(set) ? set.varied.front().column : fmt::format("{} of the data", title_of(column));
}

/// All comparisons of one column, their points in the order in which they are drawn.
std::vector<Comparison> of_column(const Validation& v, const ComparedColumn& column) {
  std::vector<Comparison> out;
  const bool curve = is_curve(*v.set);
  for (const Comparison& c : v.comparisons) {
    if (c.column != &column) continue;
    std::vector<ComparedPoint>& points = out.emplace_back(c).points;
    if (curve) continue;
    for (ComparedPoint& p : points) p.x = p.data;
    std::stable_sort(points.begin(), points.end(),
                     [](const ComparedPoint& a, const ComparedPoint& b) { return a.x < b.x; });
  }
  return out;
}

ReportSeries line(const std::string& name, const std::vector<ComparedPoint>& points, double ComparedPoint::*value) {
  ReportSeries out{.name = name, .x = {}, .y = {}};
  for (const ComparedPoint& p : points) {
    out.x.push_back(p.x);
    out.y.push_back(p.*value);
  }
  return out;
}

/// The data less or more their deviation.
ReportSeries edge(const std::string& name, std::vector<ComparedPoint> points, double sign) {
  for (ComparedPoint& p : points) p.data += sign * p.deviation;
  ReportSeries out = line(name, points, &ComparedPoint::data);
  out.markers = false;
  out.dash = "dot";
  out.colour = 0;
  return out;
}

ReportChart chart_of(const Validation& v, const ComparedColumn& column) {
  ReportChart chart{.id = v.set->name + "-" + column.column,
                    .title = fmt::format("{}: {}", v.set->title, column.title),
                    .note = v.set->source,
                    .x = axis_of(*v.set, column),
                    .y = title_of(column),
                    .series = {}};
  const std::vector<Comparison> all = of_column(v, column);
  const std::vector<ComparedPoint>& points = all.front().points;
  chart.series.push_back(line(v.set->reference, points, &ComparedPoint::data));
  chart.series.back().colour = 0;
  if (!column.deviation.empty()) {
    chart.series.push_back(edge("+ standard deviation", points, 1));
    chart.series.push_back(edge("- standard deviation", points, -1));
  }
  int colour = 0;  // that of the data
  for (const Comparison& c : all) {
    chart.series.push_back(
        line(c.series->name.empty() ? "RailStrata" : c.series->name, c.points, &ComparedPoint::ours));
    chart.series.back().colour = ++colour;
  }
  return chart;
}

struct VerdictLine {
  const Validation* validation;
  const Comparison* comparison;
};

ReportTable verdicts_of(std::span<const Validation> all) {
  std::vector<VerdictLine> lines;
  for (const Validation& v : all)
    for (const Comparison& c : v.comparisons) lines.push_back({&v, &c});
  const std::vector<TextColumn<VerdictLine>> columns{
      {"set", [](const VerdictLine& l) { return l.validation->set->title; }},
      {"quantity", [](const VerdictLine& l) { return l.comparison->column->title; }},
      {"series", [](const VerdictLine& l) { return l.comparison->series->name; }},
      {"reference", [](const VerdictLine& l) { return l.validation->set->reference; }},
      {"rows", [](const VerdictLine& l) { return fmt::format("{}", l.comparison->points.size()); }},
      {"reference value", [](const VerdictLine& l) { return single_text(*l.comparison, &ComparedPoint::data); }},
      {"here", [](const VerdictLine& l) { return single_text(*l.comparison, &ComparedPoint::ours); }},
      {"difference",
       [](const VerdictLine& l) { return measured_text(*l.comparison->column, l.comparison->difference); }},
      {"of", [](const VerdictLine& l) { return difference_text(l.comparison->column->by); }},
      {"scatter", [](const VerdictLine& l) { return measured_text(*l.comparison->column, l.comparison->scatter); }},
      {"bar", [](const VerdictLine& l) { return measured_text(*l.comparison->column, l.comparison->column->bar); }},
      {"verdict", [](const VerdictLine& l) { return agreement_text(l.comparison->agreement); }}};
  ReportTable table{.id = "verdicts",
                    .title = "Comparison with published results",
                    .note =
                        "A bar was chosen before the comparison unless the set notes otherwise. Within the scatter: "
                        "no further from the data than their standard deviations.",
                    .columns = {},
                    .rows = {}};
  add_rows(table, lines, columns);
  return table;
}

/// Where the numbers of the sets come from, and what is known about a difference.
ReportTable sources_of(std::span<const Validation> all) {
  const std::vector<TextColumn<Validation>> columns{
      {"set", [](const Validation& v) { return v.set->title; }},
      {"source", [](const Validation& v) { return v.set->source; }},
      {"uncertainty", [](const Validation& v) { return v.set->uncertainty; }},
      {"fitted to the data", [](const Validation& v) { return v.set->fitted; }},
      {"note", [](const Validation& v) { return v.set->note; }}};
  ReportTable table{.id = "sources", .title = "Where the numbers come from", .note = "", .columns = {}, .rows = {}};
  add_rows(table, std::vector<Validation>(all.begin(), all.end()), columns);
  return table;
}

/// How many sets agree, and the comparison that is farthest beyond its bar.
ReportAnswer answer_of(std::span<const Validation> all) {
  std::size_t judged = 0, held = 0;
  const Comparison* worst = nullptr;
  const Validation* of = nullptr;
  const auto share = [](const Comparison& c) { return c.difference / c.column->bar; };
  for (const Validation& v : all)
    for (const Comparison& c : v.comparisons) {
      if (c.agreement == Agreement::not_judged) continue;
      ++judged;
      held += c.agreement == Agreement::within_scatter || c.agreement == Agreement::within_bar;
      if (!worst || !(share(c) <= share(*worst))) {
        worst = &c;
        of = &v;
      }
    }
  if (!worst) return {"plain", "Nothing was judged", "the sets have no bar: the table shows the differences"};
  return {held == judged ? "good" : "bad", fmt::format("{} of {} comparisons hold", held, judged),
          fmt::format("the worst is {} of {}: {} of a bar of {}, {}", worst->column->title, of->set->title,
                      measured_text(*worst->column, worst->difference),
                      measured_text(*worst->column, worst->column->bar), agreement_text(worst->agreement))};
}

Report report_of(std::span<const Validation> all, const std::string& title) {
  Report report;
  report.title = title;
  report.answers = {answer_of(all)};
  report.tables = {verdicts_of(all), sources_of(all)};
  for (const Validation& v : all)
    for (const ComparedColumn& column : v.set->compared)
      if (has_chart(*v.set)) report.charts.push_back(chart_of(v, column));
  return report;
}

/// Limits of an axis: what `values` need and a twentieth of it on either side.
std::pair<double, double> limits(const std::vector<double>& values) {
  const auto [least, largest] = std::minmax_element(values.begin(), values.end());
  const double margin = std::max(0.05 * (*largest - *least), 1e-12 * std::abs(*largest));
  return {*least - margin, *largest + margin};
}

SvgFrame frame_of(const std::vector<Comparison>& all) {
  std::vector<double> x, y;
  for (const Comparison& c : all)
    for (const ComparedPoint& p : c.points) {
      const double up = std::isfinite(p.deviation) ? p.deviation : 0;
      x.push_back(p.x);
      for (const double v : {p.data - up, p.data + up, p.ours})
        if (std::isfinite(v)) y.push_back(v);
    }
  const auto [x0, x1] = limits(x);
  const auto [y0, y1] = limits(y);
  return {60, 30, 560, 300, x0, x1, y0, y1};
}

void draw_data(SvgPage& page, const SvgFrame& f, const std::vector<ComparedPoint>& points) {
  for (const ComparedPoint& p : points) {
    const double x = f.px(p.x);
    if (std::isfinite(p.deviation))
      page.add("<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\" stroke=\"#222\"/>\n", x,
               f.py(p.data - p.deviation), f.py(p.data + p.deviation));
    page.add("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"white\" stroke=\"#222\" stroke-width=\"1.4\"/>\n", x,
             f.py(p.data));
  }
}

std::string picture_name(const Validation& v, std::size_t k) {
  return fmt::format("validation-{}-{}.svg", v.set->name, k);
}

/// Documentation of one set.
std::string section_of(const Validation& v) {
  const ValidationSet& s = *v.set;
  std::string out = fmt::format("## {}\n\n**{}**. {}\n\n", s.title, agreement_text(v.agreement), s.source);
  if (!s.note.empty()) out += s.note + "\n\n";
  out += fmt::format("Uncertainty: {}. Fitted to the data: {}. Run it: `railstrata validate {}`.\n\n", s.uncertainty,
                     s.fitted, s.name);
  const bool single = s.data.rows() == 1;
  out +=
      fmt::format("| quantity | series | {} | difference | scatter | bar | verdict |\n|---|---|---|---|---|---|---|\n",
                  single ? "here / reference" : "rows");
  for (const Comparison& c : v.comparisons)
    out += fmt::format(
        "| {} | {} | {} | {} ({}) | {} | {} | {} |\n", c.column->title, c.series->name,
        single ? fmt::format("{} / {}", single_text(c, &ComparedPoint::ours), single_text(c, &ComparedPoint::data))
               : fmt::format("{}", c.points.size()),
        measured_text(*c.column, c.difference), difference_text(c.column->by), measured_text(*c.column, c.scatter),
        measured_text(*c.column, c.column->bar), agreement_text(c.agreement));
  return out + "\n";
}

}  // namespace

void write_validation(const fs::path& folder, const std::vector<std::string>& origin, const Validation& validation) {
  std::vector<CsvColumn> columns = validation.set->data.columns;
  for (const Comparison& c : validation.comparisons) {
    const std::string name = c.column->column + (c.series->name.empty() ? "" : " " + c.series->name);
    CsvColumn ours{"ours of " + name, {}};
    for (const ComparedPoint& p : c.points) ours.values.push_back(p.ours);
    columns.push_back(std::move(ours));
  }
  for (CsvColumn& c : columns)  // a name may have what separates columns
    for (char& letter : c.name)
      if (std::string_view(",\"#\r\n").find(letter) != std::string_view::npos) letter = ';';
  write_csv(folder / "comparison.csv", origin, columns);
  write_whole_file(folder / "report.html",
                   report_page(report_of({&validation, 1}, "Validation: " + validation.set->title)));
}

std::string validations_page(const std::vector<Validation>& all) { return report_page(report_of(all, "Validation")); }

std::string comparison_svg(const Validation& validation, const ComparedColumn& column) {
  constexpr const char* kColours[] = {"#0b5fa5", "#c2410c", "#15803d", "#7e22ce", "#a16207", "#0e7490"};
  const std::vector<Comparison> all = of_column(validation, column);
  SvgPage page(640, 380 + 18.0 * static_cast<double>(all.size() + 1));
  const SvgFrame f = frame_of(all);
  page.axes(f, axis_of(*validation.set, column), title_of(column));
  double legend = 390;
  std::size_t k = 0;
  for (const Comparison& c : all) {
    std::vector<double> x, y;
    for (const ComparedPoint& p : c.points)
      if (std::isfinite(p.ours)) {
        x.push_back(p.x);
        y.push_back(p.ours);
      }
    const char* colour = kColours[k++ % std::size(kColours)];
    page.line(f, x, y, colour, !c.series->judged);
    page.text(80, legend += 18, c.series->name.empty() ? "RailStrata" : "RailStrata, " + c.series->name, "start",
              colour);
  }
  draw_data(page, f, all.front().points);
  page.text(80, 390,
            fmt::format("circles: {}{}", validation.set->reference,
                        column.deviation.empty() ? "" : ", with their standard deviation"));
  return page.finish();
}

void write_validation_docs(const fs::path& docs, const std::vector<Validation>& all) {
  std::string text =
      "# Comparison with published results\n\n`railstrata validate --all --docs docs` writes this page "
      "([how](validate.md)). A bar was chosen before the comparison unless the set notes otherwise.\n\n"
      "| set | reference | verdict |\n|---|---|---|\n";
  for (const Validation& v : all)
    text += fmt::format("| {} | {} | {} |\n", v.set->title, v.set->reference, agreement_text(v.agreement));
  text += "\n";
  fs::create_directories(docs / "images");
  for (const Validation& v : all) {
    text += section_of(v);
    if (!has_chart(*v.set)) continue;
    for (std::size_t k = 0; k < v.set->compared.size(); ++k) {
      write_whole_file(docs / "images" / picture_name(v, k), comparison_svg(v, v.set->compared[k]));
      text += fmt::format("![{}](images/{})\n\n", v.set->compared[k].title, picture_name(v, k));
    }
  }
  while (text.ends_with("\n\n")) text.pop_back();
  write_whole_file(docs / "validation.md", text);
}

}  // namespace railstrata
