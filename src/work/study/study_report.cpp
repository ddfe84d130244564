#include "study/study_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/faults.hpp"
#include "judge/check_limits.hpp"
#include "judge/judgement.hpp"
#include "many/axis.hpp"
#include "many/case_page.hpp"
#include "record/json.hpp"
#include "report/checks.hpp"
#include "report/report.hpp"
#include "study/study_plan.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

std::string value_name(const std::string& key, const std::string& value) {
  if (key == "layer.0.young_ratio") return value == "1" ? "E₁ = E₀" : fmt::format("E₁ = {} E₀", value);
  return fmt::format("{} {}", key_name(key), shown_value(value));
}

template <class T>
bool one_of(const std::vector<T>& all, const T& word) {
  return std::find(all.begin(), all.end(), word) != all.end();
}

bool belongs(const StudyFigure& f, const CaseRow& e) {
  if (!one_of(f.groups, e.group) || !one_of(f.engines, e.engine)) return false;
  return std::all_of(f.where.begin(), f.where.end(),
                     [&](const auto& kv) { return e.value(kv.first).empty() || one_of(kv.second, e.value(kv.first)); });
}

/// The values of a key among entries, by their numbers, each once; {""} for no key.
std::vector<std::string> values_of(const std::string& key, const std::vector<const CaseRow*>& entries) {
  std::vector<std::string> out;
  for (const CaseRow* e : entries)
    if (const std::string v = key.empty() ? "" : e->value(key); !one_of(out, v) && (key.empty() || !v.empty()))
      out.push_back(v);
  std::stable_sort(out.begin(), out.end(), [](const std::string& a, const std::string& b) {
    return axis_value(a).first < axis_value(b).first;
  });
  return out;
}

/// A figure's cases of one chart in the order of its lines, with the place of the line's value among all.
struct Line {
  const CaseRow* entry;
  int place;
  std::string name;
};

std::vector<Line> lines_of(const StudyFigure& f, const std::vector<const CaseRow*>& members, const std::string& each) {
  const std::vector<std::string> series = values_of(f.series, members);
  std::vector<Line> out;
  for (const Engine engine : f.engines)
    for (std::size_t k = 0; k < series.size(); ++k)
      for (const CaseRow* e : members) {
        const std::string at = f.each.empty() ? "" : e->value(f.each);
        if (e->engine != engine || !e->done() || (!at.empty() && at != each) ||
            (!f.series.empty() && e->value(f.series) != series[k]))
          continue;
        out.push_back({e, static_cast<int>(k),
                       f.series.empty()
                           ? std::string(engine_title(engine))
                           : fmt::format("{}, {}", value_name(f.series, series[k]), engine_title(engine))});
      }
  return out;
}

/// How an engine's lines are drawn, and its place among the colours where they stand for engines.
struct EngineStyle {
  int place;
  const char* dash;
};
EngineStyle style_of(const CaseRow& row) {
  if (row.engine == Engine::fem) return {0, "solid"};
  return row.engine == Engine::bem ? EngineStyle{1, "dash"} : EngineStyle{2, "dot"};
}

std::vector<const CaseRow*> members_of(const StudyFigure& f, const std::vector<CaseRow>& entries) {
  std::vector<const CaseRow*> out;
  for (const CaseRow& e : entries)
    if (belongs(f, e)) out.push_back(&e);
  return out;
}

std::string chart_title(const StudyFigure& f, const std::string& each) {
  return each.empty() ? f.title : fmt::format("{}, {} {}", f.title, key_name(f.each), shown_value(each));
}

void add_centre_lines(const StudyFigure& f, const std::vector<CaseRow>& entries, Report& report) {
  const std::vector<const CaseRow*> members = members_of(f, entries);
  const std::vector<std::string> panels = values_of(f.each, members);
  for (std::size_t n = 0; n < panels.size(); ++n) {
    ReportChart chart{panels.size() > 1 ? fmt::format("{}-{}", f.id, n + 1) : f.id,
                      chart_title(f, panels[n]),
                      f.note,
                      "x, rolling direction [mm]",
                      f.value == "p" ? "p [MPa]" : "|q| [MPa]",
                      {}};
    for (const Line& line : lines_of(f, members, panels[n])) {
      const CsvTable table = read_csv(line.entry->folder / "centre_line.csv");
      ReportSeries s{line.name,
                     table.column("x_mm"),
                     table.column("p_MPa"),
                     line.entry->engine == Engine::fem,
                     f.series.empty() ? style_of(*line.entry).place : line.place,
                     style_of(*line.entry).dash};
      if (f.value == "q") {
        const std::vector<double> qx = table.column("q_x_MPa"), qy = table.column("q_y_MPa");
        for (std::size_t i = 0; i < s.y.size(); ++i) s.y[i] = std::hypot(qx[i], qy[i]);
      }
      chart.series.push_back(std::move(s));
    }
    if (!chart.series.empty()) report.charts.push_back(std::move(chart));
  }
}

void add_trends(const StudyFigure& f, const std::vector<CaseRow>& entries, Report& report) {
  const std::vector<const CaseRow*> members = members_of(f, entries);
  const std::vector<std::string> xs = values_of(f.x, members);
  for (const std::string& panel : values_of(f.each, members)) {
    ReportChart chart{panel.empty() ? f.id : fmt::format("{}-{}", f.id, panel),
                      chart_title(f, panel),
                      f.note,
                      axis_title(key_name(f.x), xs),
                      column_title(f.value),
                      {}};
    std::vector<LinePoint> points;
    for (const Line& line : lines_of(f, members, panel))
      points.push_back({line.entry, line.name, line.place, style_of(*line.entry).dash});
    add_trend(chart, f.x, f.value, points);
    if (!chart.series.empty()) report.charts.push_back(std::move(chart));
  }
}

/// The run of an entry in the report, read if it is not there yet.
int run_of(const CaseRow& e, Report& report) {
  for (std::size_t k = 0; k < report.runs.size(); ++k)
    if (report.runs[k].result.folder == e.folder) return static_cast<int>(k);
  report.runs.push_back(read_report_run(e.folder));
  report.runs.back().name = e.group + "/" + e.name;
  return static_cast<int>(report.runs.size()) - 1;
}

void add_maps(const StudyFigure& f, const std::vector<CaseRow>& entries, Report& report) {
  const std::vector<const CaseRow*> members = members_of(f, entries);
  for (const std::string& panel : values_of(f.each, members)) {
    ReportMaps maps{
        panel.empty() ? f.id : fmt::format("{}-{}", f.id, panel), chart_title(f, panel), f.note, f.value, {}, {}};
    for (const Line& line : lines_of(f, members, panel)) {
      maps.runs.push_back(run_of(*line.entry, report));
      maps.names.push_back(line.name);
    }
    if (!maps.runs.empty()) report.maps.push_back(std::move(maps));
  }
}

// ---- grids of verdicts
/// Empty where the case has no result or no strength.
ReportGridCell verdict_cell(const CaseRow& e) {
  ShakedownFactors f;
  f.first_yield = e.number("shakedown_first_yield");
  f.wandering = e.number("shakedown_wandering");
  f.single_track = e.number("shakedown_single_track");
  f.upper = e.number("shakedown_upper");
  f.kinematic = e.number("shakedown_kinematic");
  if (std::isnan(f.first_yield) && std::isnan(f.wandering)) return {};
  ReportGridCell cell{std::string(verdict_text(verdict_of(f))), f.wandering, {}};
  for (const Verdict v : fails_by(verdict_of(f), e.number("layers_share_of_tensile"), e.number("layers_delamination")))
    cell.fails_by.emplace_back(verdict_text(v));
  if (!cell.fails_by.empty()) cell.verdict = cell.fails_by.front();
  return cell;
}

ReportGridCell grid_cell(const StudyFigure& f, const CaseRow& e) {
  if (f.kind == "verdict") return verdict_cell(e);
  return {{}, e.number(f.value), {}};
}

/// Values of a key without the unit that its axis says.
std::vector<std::string> axis_marks(const std::vector<std::string>& values) {
  std::vector<std::string> out;
  for (const std::string& v : values)
    out.push_back(std::isnan(axis_value(v).first) ? shown_value(v) : fmt::format("{}", axis_value(v).first));
  return out;
}

/// Several cases of one cell, because more keys are varied: the one that fares worst stands for them, of verdicts the
/// one with the smallest factor, of values the largest.
void put_cell(const StudyFigure& f, ReportGridCell& cell, ReportGridCell found) {
  const bool verdicts = f.kind == "verdict";
  if (verdicts ? found.verdict.empty() : !std::isfinite(found.factor)) return;
  const bool empty = verdicts ? cell.verdict.empty() : !std::isfinite(cell.factor);
  const bool worse = verdicts ? found.factor < cell.factor : found.factor > cell.factor;
  if (empty || worse) cell = std::move(found);
}

void add_grids(const StudyFigure& f, const std::vector<CaseRow>& entries, Report& report) {
  const std::vector<const CaseRow*> members = members_of(f, entries);
  const std::vector<std::string> xs = values_of(f.x, members), ys = values_of(f.y, members);
  const auto index = [](const std::vector<std::string>& all, const std::string& value) {
    return static_cast<std::size_t>(std::find(all.begin(), all.end(), value) - all.begin());
  };
  const std::vector<std::string> panels = values_of(f.each, members);
  for (std::size_t n = 0; n < panels.size(); ++n) {
    ReportGrids row{panels.size() > 1 ? fmt::format("{}-{}", f.id, n + 1) : f.id,
                    chart_title(f, panels[n]),
                    n == 0 ? f.note : "",
                    axis_title(key_name(f.x), xs),
                    axis_title(key_name(f.y), ys),
                    f.kind == "verdict" ? "" : column_title(f.value),
                    {}};
    for (const Line& line : lines_of(f, members, panels[n])) {
      const std::size_t i = index(xs, line.entry->value(f.x)), j = index(ys, line.entry->value(f.y));
      if (i == xs.size() || j == ys.size()) continue;
      if (row.grids.empty() || row.grids.back().name != line.name)
        row.grids.push_back({line.name, axis_marks(xs), axis_marks(ys), {}});
      row.grids.back().cells.resize(xs.size() * ys.size());
      put_cell(f, row.grids.back().cells[i + xs.size() * j], grid_cell(f, *line.entry));
    }
    if (!row.grids.empty()) report.grids.push_back(std::move(row));
  }
}

// ---- verdict
struct Worst {
  ReportCheck check;
  int held = 0, of = 0;
  std::vector<std::string> failing;
};

/// A run without its fields: checks look at numbers and options alone.
ReportRun for_checks(const CaseRow& e) {
  ReportRun run = read_report_run(e.folder);
  run.result.field = {};
  run.tables.clear();
  return run;
}

/// One line for each kind of check: how many cases hold it, the worst of them, and who does not.
void add_verdict(const std::vector<CaseRow>& entries, Report& report, ReportTable& pairs) {
  std::map<std::string, Worst> worst;
  std::vector<std::string> order;
  const auto add = [&](ReportCheck c, const std::string& whose) {
    if (!c.judged) return;
    c.runs.clear();
    const std::string kind = c.name;
    if (!worst.contains(kind)) order.push_back(kind);
    Worst& w = worst[kind];
    ++w.of;
    w.held += c.ok;
    if (!c.ok) w.failing.push_back(fmt::format("{} ({:.3g})", whose, c.value));
    c.note = whose;
    if (w.of == 1 || !(c.value <= w.check.value)) w.check = c;
  };
  std::set<fs::path> seen;
  std::vector<std::pair<Engine, ReportRun>> others;
  for (const CaseRow& e : entries)
    if (e.engine != Engine::fem && e.done() && seen.insert(e.folder).second)
      others.emplace_back(e.engine, for_checks(e));
  seen.clear();
  for (const CaseRow& e : entries) {
    if (!e.done() || !seen.insert(e.folder).second) continue;
    std::vector<ReportRun> both{for_checks(e)};
    const std::string whose = e.group + "/" + e.name;
    for (const ReportCheck& c : report_checks(both)) add(c, fmt::format("{}, {}", whose, engine_title(e.engine)));
    if (e.engine != Engine::fem) continue;
    for (const auto& [engine, other] : others) {
      both.resize(1);
      both.push_back(other);
      std::vector<nlohmann::ordered_json> row{whose, std::string(engine_title(engine))};
      for (const ReportCheck& c : report_checks(both)) {
        if (c.runs.size() != 2 || c.name == "cases_differ") continue;
        // on a coarser mesh than it takes nothing is promised: the paper's mesh is shown, not judged
        if (!both[0].option("mesh", "element").starts_with("one_point")) add(c, whose);
        row.push_back(fmt::format("{:.1f} %{}", 100 * c.value, !c.judged ? ", not judged" : c.ok ? "" : " ✗"));
      }
      if (row.size() == pairs.columns.size()) pairs.rows.push_back(std::move(row));
    }
  }
  for (const std::string& kind : order) {
    Worst& w = worst[kind];
    w.check.ok = w.held == w.of;
    w.check.note = fmt::format("{} of {} cases; the worst: {}{}{}", w.held, w.of, w.check.note,
                               w.failing.empty() ? "" : "; outside: ", fmt::join(w.failing, ", "));
    report.checks.push_back(w.check);
  }
}

ReportTable engines_table() {
  ReportTable t{.id = "engines",
                .title = "Finite elements against the other engines",
                .note = "Limits:",
                .columns = {"case", "against"},
                .rows = {}};
  for (const CheckRow& c : kCheckRows)
    if (c.kind == CheckKind::engines) {
      t.columns.push_back(std::string(c.name));
      t.note += fmt::format(" {} {};", c.name, limit_text(c.unit, c.fem_limit));
    }
  t.note.back() = '.';
  t.note +=
      " The stress is judged where the other engine's lies deeper than an element. ✗: outside. The paper's mesh is "
      "shown "
      "and takes no part in the verdict.";
  return t;
}

/// Case and engine, then what the figures show and other tables do not.
std::vector<CaseColumn> head_columns(const StudySpec& study, const std::vector<CaseRow>& entries) {
  std::vector<CaseColumn> out{{"case", [](const CaseRow& row) { return row.group + "/" + row.name; }},
                              {"engine", [](const CaseRow& row) { return std::string(engine_title(row.engine)); }}};
  std::vector<const ResultColumn*> there = shown_columns(entries);
  for (const StudyFigure& f : study.figures)
    if (const ResultColumn* c = find_column(f.value); c && std::find(there.begin(), there.end(), c) == there.end()) {
      there.push_back(c);
      out.push_back(number_column(*c));
    }
  return out;
}

}  // namespace

Report study_report(const StudySpec& study, const std::vector<CaseRow>& entries) {
  Report report;
  report.title = study.title;
  report.answers = cases_answers(entries);
  for (const StudyFigure& f : study.figures) {
    if (f.kind == "centre_line")
      add_centre_lines(f, entries, report);
    else if (f.kind == "trend")
      add_trends(f, entries, report);
    else if (f.kind == "verdict" || f.kind == "grid")
      add_grids(f, entries, report);
    else
      add_maps(f, entries, report);
  }
  for (const CaseRow& e : entries)  // something to look at, whatever the figures ask for
    if (report.runs.empty() && e.done()) run_of(e, report);
  ReportTable pairs = engines_table();
  add_verdict(entries, report, pairs);
  if (!pairs.rows.empty()) report.tables.push_back(std::move(pairs));
  report.tables.push_back(cases_table("study.csv has every column.", head_columns(study, entries), entries));
  return report;
}

}  // namespace railstrata
