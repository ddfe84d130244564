#include "wear/wear_loop_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "collective/collective_files.hpp"
#include "record/json.hpp"
#include "record/number_text.hpp"
#include "record/output_file.hpp"
#include "report/page.hpp"

namespace railstrata {
namespace {

constexpr const char* kPassages = "passages of the whole collective";
constexpr double kWorn = 1e-8;            // m, less is the round-off of the files
constexpr std::size_t kRoom = 12;         // cells beside what has worn
constexpr std::size_t kMostProfiles = 6;  // profiles in one chart

/// The last profile and some before it, evenly.
std::vector<const WornRail*> some_of(const std::vector<WornRail>& profiles) {
  std::vector<const WornRail*> out;
  const std::size_t n = std::min(profiles.size(), kMostProfiles);
  for (std::size_t k = 1; k <= n; ++k) out.push_back(&profiles[(k * profiles.size()) / n - 1]);
  return out;
}

std::string after(const WornRail& p) {
  return p.passages < 1e7 ? fmt::format("after {:.0f} passages", p.passages)
                          : fmt::format("after {:.4g} passages", p.passages);
}

ReportSeries curve(const std::string& name, const std::vector<Vec2>& points, ShownCells reach) {
  ReportSeries s{.name = name, .x = {}, .y = {}, .markers = false};
  for (std::size_t i = reach.from; i < std::min(reach.to, points.size()); ++i) {
    s.x.push_back(kToMilli * points[i].y);
    s.y.push_back(kToMilli * points[i].z);
  }
  return s;
}

ReportChart profile_chart(const WearLoopHistory& history, ShownCells reach) {
  ReportChart out{"profile", "The rail before and after", "", kAcross, "z [mm]", {}};
  out.series = {curve("unworn", history.unworn, reach),
                curve(after(history.profiles.back()), history.profiles.back().points, reach)};
  return out;
}

ReportChart depth_chart(const WearLoopHistory& history, ShownCells reach) {
  ReportChart out{"depth",
                  "Worn off so far, over the rail",
                  "Measured along the normal of the unworn profile.",
                  kAcross,
                  "wear depth [µm]",
                  {}};
  for (const WornRail* p : some_of(history.profiles)) {
    const std::vector<double> depth = worn_depth(history.unworn, p->points);
    ReportSeries s{.name = after(*p), .x = {}, .y = {}, .markers = false};
    for (std::size_t i = reach.from; i < reach.to; ++i) {
      s.x.push_back(kToMilli * history.unworn[i].y);
      s.y.push_back(kToMicro * depth[i]);
    }
    out.series.push_back(std::move(s));
  }
  return out;
}

/// A number of wear_loads.csv, a line for each load over the passages.
ReportChart load_chart(const WearLoopHistory& history, const std::string& id, const std::string& title,
                       const std::string& note, const std::string& label, std::string_view symbol) {
  const auto& all = wear_load_columns();
  const auto column = std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.symbol == symbol; });
  ReportChart out{id, title, note, kPassages, titled(label, column->unit.shown), {}};
  for (std::size_t k = 0; k < history.loads.size(); ++k) {
    ReportSeries s{.name = history.loads[k], .x = {}, .y = {}};
    for (const WearLoad& load : history.contacts)
      if (load.load == static_cast<double>(k + 1)) {
        s.x.push_back(load.passages);
        s.y.push_back(load.*column->value);
      }
    if (!s.x.empty()) out.series.push_back(std::move(s));
  }
  return out;
}

ReportChart area_chart(const WearLoopHistory& history) {
  ReportChart out{"area", "Area worn off", "", kPassages, titled("area", unit::kSquareMillimetres.shown), {}};
  ReportSeries s{.name = "area", .x = {0}, .y = {0}};
  for (const WornRail& p : history.profiles) {
    s.x.push_back(p.passages);
    s.y.push_back(unit::kSquareMillimetres.factor * p.area);
  }
  out.series.push_back(std::move(s));
  return out;
}

/// Largest value over the loads of a step; NaN where it has none.
double largest(const WearLoopHistory& history, int step, double WearLoad::*value) {
  double out = std::numeric_limits<double>::quiet_NaN();
  for (const WearLoad& load : history.contacts)
    if (load.step == step && (std::isnan(out) || load.*value > out)) out = load.*value;
  return out;
}

ReportTable steps_table(const WearLoopHistory& history) {
  ReportTable t{.id = "steps",
                .title = "Steps",
                .note = "Pressure and T-gamma: largest of all loads, on the rail before the step.",
                .columns = {},
                .rows = {}};
  struct Step {
    const WornRail& profile;
    double deepest, y;         // m
    double pressure, t_gamma;  // as wear_loads.csv has them
  };
  std::vector<Step> steps;
  for (const WornRail& p : history.profiles) {
    const std::vector<double> depth = worn_depth(history.unworn, p.points);
    const auto most = std::max_element(depth.begin(), depth.end());
    steps.push_back({p, *most, history.unworn[static_cast<std::size_t>(most - depth.begin())].y,
                     largest(history, p.step, &WearLoad::pressure), largest(history, p.step, &WearLoad::t_gamma)});
  }
  const auto number = [](const char* label, const Unit& unit, auto&& si) {
    return TextColumn<Step>{titled(label, unit.shown), [=](const Step& s) { return json_number(unit.factor * si(s)); }};
  };
  add_rows(t, steps,
           {{"step", [](const Step& s) { return std::to_string(s.profile.step); }},
            number("passages so far", unit::kNone, [](const Step& s) { return s.profile.passages; }),
            number("deepest so far", unit::kMicrometres, [](const Step& s) { return s.deepest; }),
            number("at y", unit::kMillimetres, [](const Step& s) { return s.y; }),
            number("worn off", unit::kSquareMillimetres, [](const Step& s) { return s.profile.area; }),
            {titled("p_max", unit::kMPa.shown), [](const Step& s) { return json_number(s.pressure); }},
            {titled("T-gamma", unit::kNewtons.shown), [](const Step& s) { return json_number(s.t_gamma); }}});
  return t;
}

ReportAnswer wear_answer(const WearLoopHistory& history) {
  const WornRail& last = history.profiles.back();
  const std::vector<double> depth = worn_depth(history.unworn, last.points);
  const auto most = std::max_element(depth.begin(), depth.end());
  const double traffic = unit::kMGT.factor * history.traffic;
  const std::string each =
      traffic > 0 ? fmt::format(" ({:.3g} MGT, {:.3g} mm per 100 MGT)", traffic, 100 / traffic * kToMilli * *most) : "";
  return {"plain", "Wear",
          fmt::format("{:.3g} µm after {:.4g} passages{}, at y = {:.1f} mm of the rail; {:.3g} mm² in all",
                      kToMicro * *most, last.passages, each,
                      kToMilli * history.unworn[static_cast<std::size_t>(most - depth.begin())].y,
                      unit::kSquareMillimetres.factor * last.area)};
}

}  // namespace

std::vector<WearLoad> wear_loads(const WearStep& step, double passages_before) {
  std::vector<WearLoad> out;
  for (std::size_t k = 0; k < step.rows.size(); ++k) {
    const CollectiveRow& row = step.rows[k];
    if (!row.solved()) continue;
    out.push_back(
        in_table(wear_load_columns(), {static_cast<double>(step.rail.step), passages_before, static_cast<double>(k + 1),
                                       model_to_rail(row.track, row.patches.front().contact.point).y,
                                       row.summary.contact.patch.p_max, row.summary.damage.t_gamma}));
  }
  return out;
}

const StateColumns<WearLoad>& wear_load_columns() {
  using W = WearLoad;
  static const StateColumns<W> columns{{"step", &W::step},
                                       {"passages", &W::passages},
                                       {"load", &W::load},
                                       {"rail_y", &W::y, unit::kMillimetres},
                                       {"p_max", &W::pressure, unit::kMPa},
                                       {"t_gamma", &W::t_gamma, unit::kNewtons}};
  return columns;
}

std::vector<double> worn_depth(const std::vector<Vec2>& unworn, const std::vector<Vec2>& worn) {
  constexpr std::size_t kNear = 60;  // pieces: profiles of a loop have nearly the same points
  std::vector<double> out;
  for (std::size_t k = 0; k < unworn.size(); ++k)
    out.push_back(depth_below(worn, unworn[k], k > kNear ? k - kNear : 1, k + kNear));
  return out;
}

void write_wear_loop_page(const std::filesystem::path& page, const WearLoopHistory& history) {
  if (history.profiles.empty()) return;
  const ShownCells reach = cells_above(worn_depth(history.unworn, history.profiles.back().points), kWorn, kRoom);
  Report report;
  report.title = fmt::format("{}: wear loop", history.title);
  report.answers = {wear_answer(history)};
  report.tables = {steps_table(history)};
  report.charts = {depth_chart(history, reach),
                   profile_chart(history, reach),
                   load_chart(history, "contact", "Where each load touches", "First contact, y from the rail's axis.",
                              "contact y", "rail_y"),
                   load_chart(history, "pressure", "Largest pressure of each load", "", "p_max", "p_max"),
                   load_chart(history, "t-gamma", "T-gamma of each load", "", "T-gamma", "t_gamma"),
                   area_chart(history)};
  write_whole_file(page, report_page(report));
}

}  // namespace railstrata
