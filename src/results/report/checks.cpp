#include "report/checks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "core/engine.hpp"
#include "judge/check_limits.hpp"
#include "result/result_table.hpp"
#include "text/units.hpp"

namespace railstrata {
namespace {

/// Whether an option sets how a case is computed, not what it is.
bool is_numerical(const CaseOption& o) {
  static const std::set<std::string> tables{"case", "mesh", "contact", "bem", "output"},
      keys{"layer.elements", "drive.torque_ramp", "drive.creepage_start"};
  if (tables.contains(o.table)) return true;
  if (o.table == "run") return o.key != "rolling";
  return keys.contains(o.table.substr(0, o.table.find('.')) + "." + o.key);
}

/// The text by which an option is compared: of a profile file its content, for two files may have one name, and one
/// file two.
std::string meaning(const ReportRun& run, const CaseOption& o) {
  const auto file = o.table == "geometry" ? run.profile_sha256.find(o.key) : run.profile_sha256.end();
  return file == run.profile_sha256.end() ? run.option(o.table, o.key) : file->second;
}

/// "layer.0.thickness: 1 mm, 2 mm" for every physical option that differs.
std::vector<std::string> differences(const ReportRun& a, const ReportRun& b) {
  std::vector<std::string> out;
  for (const CaseOption& o : a.options) {
    if (is_numerical(o) || meaning(a, o) == meaning(b, o)) continue;
    const std::string theirs = b.option(o.table, o.key);
    out.push_back(fmt::format("{}.{}: {}, {}", o.table, o.key, o.value,
                              theirs.empty()      ? "none"
                              : theirs == o.value ? "a different file of this name"
                                                  : theirs));
  }
  for (const CaseOption& o : b.options)
    if (!is_numerical(o) && a.option(o.table, o.key).empty() && !o.value.empty())
      out.push_back(fmt::format("{}.{}: none, {}", o.table, o.key, o.value));
  return out;
}

struct Place {
  double value = kNotApplicable, depth = 0;
};

Place von_mises_below_surface(const ReportRun& run) {
  const std::string at = "/stress/rail/subsurface/von_mises_max/";
  return {run.result.number(at + "value_Pa"), run.result.number(at + "depth_m")};
}

double element_size(const ReportRun& run) {
  try {
    return parse_quantity(run.option("mesh", "element_size"), dimension::kLength);
  } catch (const UnitError&) {
    return 0;
  }
}

/// The check `name` of two engines' values.
ReportCheck within(std::string_view name, std::vector<int> runs, double a, double b) {
  const double value = std::abs(a / b - 1);
  ReportCheck c{.name = std::string(name),
                .runs = std::move(runs),
                .judged = std::isfinite(value),
                .value = value,
                .limit = check_row(name).fem_limit};
  c.ok = !c.judged || value <= c.limit;
  if (!c.judged) c.note = "one of the two has no such number";
  return c;
}

/// Largest shears of a point are compared with those of cells of the same size: both miss the cusp at the front of
/// slip by as much (docs/bem-verification.md).
ReportCheck shear_check(const ReportRun& fem, const ReportRun& bem, const std::vector<int>& both) {
  const double ours = fem.result.number("/contact/q_max_Pa"), theirs = bem.result.number("/contact/q_max_Pa");
  if (!std::isfinite(fem.shear_on_elements)) return within("q_max", both, ours, theirs);
  ReportCheck check = within("q_max", both, fem.result.number("/contact/q_max_point_Pa"), fem.shear_on_elements);
  check.note = fmt::format(
      "largest value at a point, compared with cells as large as the elements ({:.3g} mm): {:.0f} MPa; half-spaces "
      "give {:.0f} MPa at the front of slip, from which the elements differ by {:.1f} %",
      1e3 * element_size(fem), 1e-6 * fem.shear_on_elements, 1e-6 * theirs, 100 * std::abs(ours / theirs - 1));
  return check;
}

void add_doubts(const ReportRun& run, int index, std::vector<ReportCheck>& out) {
  for (const ResultDoubt& d : run.doubts)
    out.push_back({.name = d.name,
                   .runs = {index},
                   .judged = d.grave,
                   .ok = !d.grave,
                   .value = kNotApplicable,
                   .limit = kNotApplicable,
                   .note = d.text});
}

/// The text of a warning that the table knows is the table's, in the units of the page, unless it names this case's
/// numbers.
void add_warnings(const ReportRun& run, int index, std::vector<ReportCheck>& out) {
  for (const auto& w : objects_of(run.result.summary, "warnings")) {
    const std::string name = w.value("name", "warning");
    const CheckRow* row = find_check(name);
    out.push_back({.name = name,
                   .runs = {index},
                   .judged = false,
                   .value = number_at(w, "/value"),
                   .limit = number_at(w, "/limit"),
                   .note = row && !row->own_text ? "" : w.value("text", "")});
  }
}

void add_own(const ReportRun& run, int index, std::vector<ReportCheck>& out) {
  for (const Check& c : checks_of(run.result.summary))
    out.push_back({.name = c.name, .runs = {index}, .ok = c.ok, .value = c.value, .limit = c.limit});
}

void add_pair(const std::vector<ReportRun>& runs, int fem, int bem, std::vector<ReportCheck>& out) {
  const ResultFolder &a = runs[fem].result, &b = runs[bem].result;
  const std::vector<int> both{fem, bem};
  out.push_back(within("p_max", both, a.number("/contact/p_max_Pa"), b.number("/contact/p_max_Pa")));
  out.push_back(within("patch_length", both, a.number("/contact/patch_length_m"), b.number("/contact/patch_length_m")));
  if (b.number("/contact/q_max_Pa") > 0) out.push_back(shear_check(runs[fem], runs[bem], both));
  const Place ours = von_mises_below_surface(runs[fem]), theirs = von_mises_below_surface(runs[bem]);
  ReportCheck stress = within("von_mises_below_surface", both, ours.value, theirs.value);
  if (const double h = element_size(runs[fem]); stress.judged && theirs.depth <= h) {
    stress.judged = false;
    stress.note =
        fmt::format("not compared: the other engine's maximum is {:.2f} mm deep, within an element of {:.2f} mm",
                    1e3 * theirs.depth, 1e3 * h);
  }
  out.push_back(std::move(stress));
}

}  // namespace

std::vector<ReportCheck> report_checks(const std::vector<ReportRun>& runs) {
  std::vector<ReportCheck> out;
  const int n = static_cast<int>(runs.size());
  for (int i = 0; i < n; ++i) add_own(runs[i], i, out);
  for (int i = 0; i < n; ++i) add_doubts(runs[i], i, out);
  for (int i = 0; i < n; ++i) add_warnings(runs[i], i, out);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      if (is_engine(runs[i].result.engine, Engine::fem) && !is_engine(runs[j].result.engine, Engine::fem) &&
          differences(runs[i], runs[j]).empty())
        add_pair(runs, i, j, out);
  if (n == 2)
    if (std::vector<std::string> d = differences(runs[0], runs[1]); !d.empty()) {
      const std::size_t shown = std::min<std::size_t>(d.size(), 12), left = d.size() - shown;
      d.resize(shown);
      out.push_back({.name = "cases_differ",
                     .runs = {0, 1},
                     .judged = false,
                     .value = kNotApplicable,
                     .limit = kNotApplicable,
                     .note = fmt::format("{}{}", fmt::join(d, "; "), left ? fmt::format("; and {} more", left) : "")});
    }
  return out;
}

namespace {

/// What the heights of its way did to a wheel; nothing of a run without them.
std::optional<ReportAnswer> way_answer(const ReportRun& run) {
  constexpr double kBefore = 50;  // mm, from where on a run is looked at, before the first height
  const CsvTable* const history = run.table("history");
  if (!history || !run.geometry.is_object() || !run.geometry.contains("heights")) return std::nullopt;
  const auto values = [&](const char* key) { return run.geometry["heights"][key].get<std::vector<double>>(); };
  const std::vector<double> x = values("x_mm"), rail = values("rail_um"), wheel = values("wheel_um");
  std::size_t first = 0;
  while (first + 1 < x.size() && rail[first] == 0 && wheel[first] == 0) ++first;
  const bool rolls = is_engine(run.result.engine, Engine::fem);
  const std::vector<double> way = history->column(rolls ? "position_mm" : "distance_mm"),
                            force = history->column("F_z_N"), pressure = history->column("p_max_MPa");
  const auto begin = std::lower_bound(way.begin(), way.end(), x[first] - kBefore) - way.begin();
  if (begin >= static_cast<std::ptrdiff_t>(way.size())) return std::nullopt;
  const auto most = std::max_element(pressure.begin() + begin, pressure.end()) - pressure.begin();
  const auto [least, largest] = std::minmax_element(force.begin() + begin, force.end());
  const auto place = [&](auto at) {
    return fmt::format("{:.4g} mm", way[static_cast<std::size_t>(at - force.begin())]);
  };
  std::string forces = fmt::format("F_z from {:.3g} kN at {} to {:.3g} kN at {}", 1e-3 * *least, place(least),
                                   1e-3 * *largest, place(largest));
  if (*largest - *least < 1e-3 * *largest) forces = fmt::format("F_z {:.3g} kN all along", 1e-3 * *largest);
  return ReportAnswer{"plain", "On its way",
                      fmt::format("largest pressure {:.4g} MPa with the wheel at {:.4g} mm, {:.4g} MPa before the "
                                  "heights; {}",
                                  pressure[most], way[most], pressure[begin], forces)};
}

}  // namespace

std::vector<ReportAnswer> run_answers(const std::vector<ReportRun>& runs) {
  const nlohmann::json::json_pointer at("/shakedown/answer");
  const auto& numbers = result_numbers();
  const auto life = std::find_if(numbers.begin(), numbers.end(), [](const auto& n) { return n.group == kLifeGroup; });
  const nlohmann::json::json_pointer best(life->path());
  std::vector<ReportAnswer> out;
  for (const ReportRun& run : runs) {
    const std::string whose =
        runs.size() > 1
            ? fmt::format("{} ({}), ", run.name, engine_title(engine_of(run.result.engine).value_or(Engine::bem)))
            : "";
    if (std::optional<ReportAnswer> way = way_answer(run)) {
      way->text = whose + way->text;
      out.push_back(std::move(*way));
    }
    const nlohmann::json& summary = run.result.summary;
    if (summary.contains(at) && summary[at].is_object()) {
      const nlohmann::json& answer = summary[at];
      out.push_back({answer.value("tone", ""), answer.value("title", ""), whose + answer.value("reason", "")});
    }
    if (summary.contains(kLifeGroup))
      out.push_back({summary[best].is_number() ? "open" : "plain", "Life with such wheels",
                     whose + summary[kLifeGroup].value("text", "")});
  }
  return out;
}

ReportVerdict verdict_of(const Report& report) {
  int judged = 0, failed = 0;
  std::string names;
  for (const ReportCheck& c : report.checks) {
    judged += c.judged;
    if (!c.judged || c.ok) continue;
    ++failed;
    const auto [name, unit] = check_words(c.name);
    names += fmt::format("{}{}", names.empty() ? "" : "; ", name);
    if (std::isfinite(c.value))
      names += fmt::format(" {}, limit {}", with_unit(unit, c.value, 3), limit_text(unit, c.limit));
  }
  if (judged == 0) return {false, "nothing was checked"};
  if (failed == 0) return {true, fmt::format("all {} checks hold", judged)};
  return {false, fmt::format("{} of {} checks {}: {}", failed, judged, failed == 1 ? "fails" : "fail", names)};
}

}  // namespace railstrata
