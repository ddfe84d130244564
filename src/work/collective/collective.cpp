#include "collective/collective.hpp"

#include <algorithm>
#include <cmath>
#include <exception>

#include "core/root.hpp"
#include "fatigue/wheel_damage.hpp"
#include "io/summary_json.hpp"
#include "many/each_case.hpp"
#include "many/result_columns.hpp"
#include "rules/support.hpp"
#include "tables/load_rows.hpp"

namespace railstrata {
namespace {

/// Moves the shift until the wheel has the row's guiding force, within a twentieth of it or a hundredth of the load.
void match_guiding_force(CollectiveRow& row, const std::filesystem::path& folder, const CollectiveOptions& options) {
  constexpr double kFirst = 10e-6, kNarrow = 1e-8, kClose = 0.05, kOfLoad = 0.01;
  constexpr int kMost = 30;
  const double shift = row.spec.geometry.lateral_shift, wanted = *row.given.guiding_force;
  double close = kClose * std::abs(wanted);
  const auto excess_at = [&](double moved) {
    row.moved = moved;
    row.spec.geometry.lateral_shift = shift + moved;
    const AskOptions how{.bem = options.bem, .control = options.control};
    const ContactSummary c = solve_contact(row.spec, place(row.spec, folder, options.rail), how).summary.contact;
    close = std::max(close, kOfLoad * c.F_z);
    return -c.F_y - wanted;
  };
  double a = 0, at_a = excess_at(a), b = a, at_b = at_a;
  if (std::abs(at_a) <= close) return;
  const double side = at_a > 0 ? -1 : 1;  // the flange pushes the rail to its field side
  for (double away = kFirst; at_a * at_b > 0 && std::abs(b) < kFarthestMatch; away *= 3) {
    a = b;
    at_a = at_b;
    b = side * std::min(away, kFarthestMatch);
    at_b = excess_at(b);
  }
  if (at_a * at_b < 0 && narrow_root(a, at_a, b, at_b, close, kNarrow, kMost, excess_at)) return;
  row.spec.geometry.lateral_shift = shift;
  row.moved = kNotApplicable;
}

void solve(CollectiveRow& row, const std::filesystem::path& folder, const CollectiveOptions& options) {
  if (row.spec.collective.match_guiding_force && row.given.guiding_force) match_guiding_force(row, folder, options);
  const Placement placement = place(row.spec, folder, options.rail);
  row.track = placement.track;
  Answer answer = ask(row.spec, placement, options.wanted, {.bem = options.bem, .control = options.control});
  row.sections = std::move(answer.shakedown);
  row.patches = std::move(answer.wear);
  if (!row.given.wheel_profile.empty())
    for (const PatchDamage& patch : row.patches)
      row.wheel_y.push_back(placement.wheel.at(patch.contact.wheel_s).position.y);
  row.summary = std::move(answer.summary);
  if (options.keep_results) row.result = std::move(answer.result);
  row.summary_json = summary_json(row.summary);
  row.fault = failed_check(row.summary_json);
}

/// Rows whose checks failed are shown, but not summed.
std::vector<WheelKind> kinds_of(const std::vector<CollectiveRow>& rows) {
  std::vector<WheelKind> out;
  for (const CollectiveRow& row : rows)
    if (row.sound()) out.push_back({row.passages, row.patches});
  return out;
}

/// A row's patches; on a wheel of another profile at the same distance from the tape circle of this one.
std::vector<PatchDamage> on_wheel(const CollectiveRow& row, const Profile& wheel) {
  std::vector<PatchDamage> out = row.patches;
  for (std::size_t k = 0; k < row.wheel_y.size(); ++k)
    out[k].contact.wheel_s = wheel.s_at_y(std::clamp(row.wheel_y[k], wheel.y_min(), wheel.y_max()));
  return out;
}

}  // namespace

std::vector<CollectiveRow> plan_collective(const CaseSpec& spec) {
  require_support(uses::kCollective, spec);
  std::vector<CollectiveRow> rows;
  for (std::size_t i = 0; i < spec.loads.size(); ++i) {
    CollectiveRow& row = rows.emplace_back();
    row.name = load_name(spec, i);
    row.passages = spec.loads[i].passages;
    row.given = spec.loads[i];
    row.spec = with_load(spec, spec.loads[i]);
  }
  return rows;
}

void solve_collective(std::vector<CollectiveRow>& rows, const std::filesystem::path& folder,
                      const CollectiveOptions& options) {
  std::size_t done = 0;
  for_each_completed(rows.size(), options.control, [&](std::size_t i) {
    try {
      solve(rows[i], folder, options);
    } catch (const std::exception& e) {
      rows[i].fault = fault_line(e);
    }
    return [&, i] {
      rows[i].done = true;
      if (options.control)
        options.control->progress("loads", static_cast<double>(++done) / static_cast<double>(rows.size()));
    };
  });
}

RailDamage rail_damage(const std::vector<CollectiveRow>& rows, const Placement& placement, double cell) {
  return rail_damage(rows.front().spec, kinds_of(rows), placement, cell);
}

WheelDamage wheel_damage(const std::vector<CollectiveRow>& rows, const Placement& placement, double cell) {
  std::vector<std::vector<PatchDamage>> patches;
  std::vector<WheelKind> kinds;
  patches.reserve(rows.size());
  for (const CollectiveRow& row : rows)
    if (row.sound()) kinds.push_back({row.passages, patches.emplace_back(on_wheel(row, placement.wheel))});
  return wheel_damage(rows.front().spec, kinds, placement, cell);
}

Lives collective_lives(const CaseSpec& spec, const std::vector<CollectiveRow>& rows, const RailDamage& rail,
                       const WheelDamage& wheel) {
  std::vector<LifeLoad> loads;
  for (const CollectiveRow& row : rows)
    if (row.sound())
      loads.push_back({row.passages, 0.5 * row.given.axle_weight.value_or(2 * row.summary.contact.F_z), &row.patches,
                       &row.sections});
  return zone_lives(spec, loads, rail, wheel);
}

double passages_of(const std::vector<CollectiveRow>& rows) {
  double out = 0;
  for (const CollectiveRow& row : rows) out += row.sound() ? row.passages : 0;
  return out;
}

double streamline_area(const std::vector<CollectiveRow>& rows, WearLaw law) {
  double area = 0;
  for (const WheelKind& kind : kinds_of(rows))
    for (const PatchDamage& patch : kind.patches)
      for (const StreamlineRow& line : patch.rows) area += kind.passages * line.width * line.depth(law);
  return rows.front().spec.collective.wear_factor * area;
}

const CollectiveRow* worst_row(const std::vector<CollectiveRow>& rows) {
  const CollectiveRow* worst = nullptr;
  const auto factor = [](const CollectiveRow& r) { return r.summary.shakedown.least(&ShakedownFactors::wandering); };
  for (const CollectiveRow& row : rows)
    if (row.sound() && std::isfinite(factor(row)) && (!worst || factor(row) < factor(*worst))) worst = &row;
  return worst;
}

const CollectiveRow* most_pressed_row(const std::vector<CollectiveRow>& rows) {
  const CollectiveRow* most = nullptr;
  const auto pressure = [](const CollectiveRow& r) { return r.summary.contact.patch.p_max; };
  for (const CollectiveRow& row : rows)
    if (row.sound() && (!most || pressure(row) > pressure(*most))) most = &row;
  return most;
}

long faults(const std::vector<CollectiveRow>& rows) {
  return std::count_if(rows.begin(), rows.end(), [](const CollectiveRow& r) { return !r.fault.empty(); });
}

}  // namespace railstrata
