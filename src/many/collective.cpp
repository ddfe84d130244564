#include "many/collective.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <span>

#include "case/load_rows.hpp"
#include "core/faults.hpp"
#include "io/summary_json.hpp"
#include "judge/bem_summary.hpp"
#include "many/each_case.hpp"
#include "many/result_columns.hpp"
#include "runs/life_passes.hpp"
#include "runs/load_life.hpp"
#include "runs/solve_half_space.hpp"

namespace railstrata {
namespace {

/// A rail that passes cannot be followed on keeps its wear, rolling contact fatigue and shakedown.
void follow_passes(CollectiveRow& row, const Placement& placement, const BemResult& result,
                   const CollectiveOptions& options) {
  try {
    row.passed = passed_sections(row.spec, placement, result, options.bem, options.control);
  } catch (const CaseError& e) {
    row.not_followed = fault_line(e);
  } catch (const NumericalError& e) {
    row.not_followed = fault_line(e);
  }
}

void solve(CollectiveRow& row, const std::filesystem::path& folder, const CollectiveOptions& options) {
  const Placement placement = place(row.spec, folder);
  row.track = placement.track;
  HalfSpaceSolution solution = solve_half_space_contact(row.spec, placement, options.bem);
  Summary& s = solution.summary;
  if (options.shakedown) {
    const std::vector<SectionShakedown> sections = half_space_shakedown(row.spec, solution.result);
    s.shakedown = shakedown_summary(row.spec, sections);
    for (const SectionShakedown& section : sections) s.fatigue.push_back(section.fatigue);
    row.sections = sections;
  }
  if (row.spec.life.passes > 0) follow_passes(row, placement, solution.result, options);
  s.warnings = bem_warnings(s, row.spec, solution.result);
  row.patches = patch_damages(row.spec, solution);
  row.summary = std::move(s);
  row.summary_json = summary_json(row.summary);
  row.fault = failed_check(row.summary_json);
}

void solve_or_tell(CollectiveRow& row, const std::filesystem::path& folder, const CollectiveOptions& options) {
  try {
    solve(row, folder, options);
  } catch (const std::exception& e) {
    row.fault = fault_line(e);
  }
}

/// None of a row whose checks failed: its numbers are shown, but not summed.
std::span<const PatchDamage> patches_of(const CollectiveRow& row) {
  return row.sound() ? std::span<const PatchDamage>(row.patches) : std::span<const PatchDamage>();
}

}  // namespace

std::vector<CollectiveRow> plan_collective(const CaseSpec& spec) {
  if (spec.loads.empty())
    throw CaseError("the case has no load collective",
                    "write rows of [[load]], each with passages and what differs from the case, or name a table with "
                    "collective.file = \"loads.csv\"");
  if (!spec.run.rolling)
    throw CaseError("nothing rolls in this case (run.rolling = false): it has no wear and no fatigue of passages",
                    "take out run.rolling");
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
    solve_or_tell(rows[i], folder, options);
    return [&, i] {
      rows[i].done = true;
      if (options.control)
        options.control->progress("loads", static_cast<double>(++done) / static_cast<double>(rows.size()));
    };
  });
}

RailDamage rail_damage(const std::vector<CollectiveRow>& rows, const Placement& placement, double cell) {
  RailDamage out = undamaged(placement.rail, cell);
  for (const CollectiveRow& row : rows)
    for (const PatchDamage& patch : patches_of(row))
      add_passages(out, placement.rail, placement.track, patch, row.passages);
  if (!rows.empty()) spread_aside(out, rows.front().spec.collective.lateral_deviation);
  return out;
}

WheelDamage wheel_damage(const std::vector<CollectiveRow>& rows, const Placement& placement, double cell) {
  WheelDamage out = unworn_wheel(placement.wheel, cell);
  double all = 0;
  for (const CollectiveRow& row : rows) all += row.sound() ? row.passages : 0;
  for (const CollectiveRow& row : rows)
    for (const PatchDamage& patch : patches_of(row)) add_distance(out, patch, row.passages / all);
  if (!rows.empty()) spread_aside(out, rows.front().spec.collective.lateral_deviation);
  return out;
}

Lives collective_lives(const CaseSpec& spec, const std::vector<CollectiveRow>& rows, const RailDamage& rail,
                       const WheelDamage& wheel) {
  std::vector<LifeLoad> loads;
  for (const CollectiveRow& row : rows)
    if (row.sound()) loads.push_back({row.passages, row.summary.contact.F_z, &row.patches, &row.sections, &row.passed});
  return zone_lives(spec, loads, rail, wheel);
}

double streamline_area(const std::vector<CollectiveRow>& rows, WearLaw law) {
  double area = 0;
  for (const CollectiveRow& row : rows)
    for (const PatchDamage& patch : patches_of(row))
      for (const StreamlineRow& line : patch.rows) area += row.passages * line.width * line.depth(law);
  return area;
}

const CollectiveRow* worst_row(const std::vector<CollectiveRow>& rows) {
  const CollectiveRow* worst = nullptr;
  const auto factor = [](const CollectiveRow& r) { return r.summary.shakedown.least(&ShakedownFactors::wandering); };
  for (const CollectiveRow& row : rows)
    if (row.sound() && std::isfinite(factor(row)) && (!worst || factor(row) < factor(*worst))) worst = &row;
  return worst;
}

long faults(const std::vector<CollectiveRow>& rows) {
  return std::count_if(rows.begin(), rows.end(), [](const CollectiveRow& r) { return !r.fault.empty(); });
}

}  // namespace railstrata
