#include "passage/passage.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "fatigue/row_strength.hpp"
#include "fatigue/section_fatigue.hpp"
#include "model/rail_beam.hpp"
#include "passage/force_spectrum.hpp"
#include "rules/irregularity_rules.hpp"
#include "track/joint_force.hpp"

namespace railstrata {
namespace {

using Rows = std::vector<HistoryRow>;
constexpr double kP1Within = 2e-3, kP2After = 2.2e-3, kP2Over = 2e-3;  // s

void add_dip(const RollingSystem& system, const Rows& rows, PassageSummary& out) {
  const CaseSpec& spec = system.model.spec;
  const auto dip = std::find_if(spec.irregularities.begin(), spec.irregularities.end(),
                                [](const Irregularity& is) { return std::holds_alternative<Dip>(is.shape); });
  if (dip == spec.irregularities.end() || spec.track.held()) return;
  const double tip = *dip->at;
  const auto after = std::find_if(rows.begin(), rows.end(), [&](const HistoryRow& r) { return r.position >= tip; });
  if (after == rows.end()) return;
  for (auto row = after; row != rows.end() && row->time <= after->time + kP1Within; ++row)
    if (!(wheel_force(*row) < out.P1)) out.P1 = wheel_force(*row);
  out.P2 = second_peak(rows, after->time + kP2After);
  const double load = system.model.load;
  const JointForces jenkins = joint_forces({load, *std::get<Dip>(dip->shape).angle, spec.drive.speed,
                                            spec.vehicle.wheel_mass, 1.5 * load / system.model.hertz.approach},
                                           rail_beam(system.model), spec.track.support);
  out.P1_jenkins_low = jenkins.P1_low;
  out.P1_jenkins_high = jenkins.P1_high;
  out.P2_jenkins_low = jenkins.P2_low;
  out.P2_jenkins_high = jenkins.P2_high;
}

/// The cycle of the points of one place along the rail, from the surface down.
StressHistory cycle_of(const std::vector<WatchedPoint>& points, const std::vector<std::size_t>& at,
                       const std::vector<HistoryRow>& rows) {
  StressHistory out;
  out.y = {0};
  for (const HistoryRow& row : rows) out.x.push_back(row.position);
  for (const std::size_t k : at) {
    out.depth.push_back(points[k].depth);
    out.zone.push_back(points[k].layer);
    for (const HistoryRow& row : rows) out.stress.push_back(row.points[k].stress);
  }
  return out;
}

/// Of the points of `at`, with the factors of the stretches that they lie in.
RowStrength strength_of(const RollingSystem& system, const std::vector<std::size_t>& at, const StressHistory& cycle) {
  const SweptBody& mesh = system.rail().mesh;
  RowStrength out = row_strength(system.model.spec, BodyId::rail, cycle);
  for (std::size_t r = 0; r < at.size(); ++r) {
    const WatchedPoint& point = system.watched_points[at[r]];
    const int material = mesh.blocks[static_cast<std::size_t>(mesh.contact.block)].material(point.quad, point.element);
    out.shear[r] *= mesh.strength_of(material);
    out.fatigue_limit[r] *= mesh.strength_of(material);
    out.young[r] = young(system.model.rail_materials[static_cast<std::size_t>(material)]);
  }
  return out;
}

void take_larger(std::optional<FatigueValue>& most, std::optional<FatigueValue> value, double x) {
  if (!value || (most && !(value->value > most->value))) return;
  most = std::move(value);
  most->x = x;
}

}  // namespace

double second_peak(const Rows& rows, double begin) {
  std::vector<double> means;
  for (auto first = rows.begin(); first != rows.end() && first->time + kP2Over <= rows.back().time; ++first) {
    if (first->time < begin) continue;
    double sum = 0, count = 0;
    for (auto row = first; row != rows.end() && row->time <= first->time + kP2Over; ++row) {
      sum += wheel_force(*row);
      ++count;
    }
    means.push_back(sum / count);
  }
  const auto most = std::max_element(means.begin(), means.end());
  return means.empty() || most == means.begin() || most + 1 == means.end() ? kNotApplicable : *most;
}

std::vector<BodyFatigue> passage_fatigue(const RollingSystem& system, const RunResult& run) {
  const CaseSpec& spec = system.model.spec;
  const std::vector<WatchedPoint>& points = system.watched_points;
  if (points.empty() || spec.run.plasticity || run.history.empty() || !fatigue_given(spec, BodyId::rail)) return {};
  std::map<double, std::vector<std::size_t>> places;
  for (std::size_t k = 0; k < points.size(); ++k) places[points[k].x].push_back(k);
  BodyFatigue out;
  out.body = body_word(BodyId::rail);
  for (auto& [x, at] : places) {
    std::sort(at.begin(), at.end(), [&](std::size_t a, std::size_t b) { return points[a].depth < points[b].depth; });
    const StressHistory cycle = cycle_of(points, at, run.history);
    const BodyFatigue here = section_fatigue(spec, BodyId::rail, cycle, strength_of(system, at, cycle));
    take_larger(out.dang_van, here.dang_van, x);
    take_larger(out.smith_watson_topper, here.smith_watson_topper, x);
    take_larger(out.fatemi_socie, here.fatemi_socie, x);
    take_larger(out.jiang_sehitoglu, here.jiang_sehitoglu, x);
  }
  return {out};
}

PassageSummary passage_summary(const RollingSystem& system, const RunResult& run) {
  const CaseSpec& spec = system.model.spec;
  PassageSummary out;
  if (!changes_on_way(spec)) return out;
  Rows rows;
  for (const HistoryRow& row : run.history)
    if (row.position >= spec.run.run_up) rows.push_back(row);
  for (const HistoryRow& row : rows) {
    if (!(wheel_force(row) < out.F_z_max)) {
      out.F_z_max = wheel_force(row);
      out.F_z_max_position = row.position;
    }
    if (!(wheel_force(row) > out.F_z_min)) {
      out.F_z_min = wheel_force(row);
      out.F_z_min_position = row.position;
    }
    if (!(row.p_max < out.p_max)) {
      out.p_max = row.p_max;
      out.p_max_position = row.position;
    }
    if (!system.varies_along()) continue;
    if (!system.rail().mesh.interfaces.empty()) {
      if (!(row.interface.opening < out.interface_opening)) out.interface_opening = row.interface.opening;
      if (!(row.interface.slip < out.interface_slip)) out.interface_slip = row.interface.slip;
    }
    if (!(row.way.patches < out.parts)) out.parts = row.way.patches;
    if (!(row.stress.von_mises < out.von_mises)) {
      out.von_mises = row.stress.von_mises;
      out.von_mises_x = row.stress.x;
      out.von_mises_depth = row.stress.depth;
    }
  }
  add_dip(system, rows, out);
  if (const std::optional<ForceLine> waves = passing_force(spec, run.history)) {
    out.passing_frequency = waves->frequency;
    out.F_z_passing = waves->amplitude;
  }
  return out;
}

}  // namespace railstrata
