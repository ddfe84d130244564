#include "passage/passage.hpp"

#include <algorithm>
#include <complex>
#include <limits>
#include <map>
#include <numbers>
#include <span>
#include <utility>

#include "fatigue/row_strength.hpp"
#include "model/rail_beam.hpp"
#include "model/rolling_start.hpp"
#include "spec/case_spec.hpp"
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
    out.endurance[r].limit *= mesh.strength_of(material);
    out.young[r] = young(system.model.rail_materials[static_cast<std::size_t>(material)]);
  }
  return out;
}

void take_larger(std::optional<FatigueValue>& most, std::optional<FatigueValue> value, double x) {
  if (!value || (most && !(value->value > most->value))) return;
  most = std::move(value);
  most->x = x;
}

constexpr double kTurn = 2 * std::numbers::pi;

/// The force of rows at equal intervals, less its mean, under Hann's weights.
class WindowedForce {
 public:
  explicit WindowedForce(std::span<const HistoryRow> rows) {
    const double begin = rows.front().time, length = rows.back().time - begin;
    std::vector<double> weights;
    double mean = 0;
    for (const HistoryRow& row : rows) {
      times_.push_back(row.time - begin);
      const double s = std::sin(0.5 * kTurn * times_.back() / length);
      weights.push_back(s * s);
      sum_ += weights.back();
      mean += weights.back() * wheel_force(row);
    }
    mean /= sum_;
    for (std::size_t k = 0; k < rows.size(); ++k) values_.push_back(weights[k] * (wheel_force(rows[k]) - mean));
  }

  double amplitude(double frequency) const {
    std::complex<double> sum = 0;
    for (std::size_t k = 0; k < times_.size(); ++k) sum += values_[k] * std::polar(1.0, -kTurn * frequency * times_[k]);
    return 2 * std::abs(sum) / sum_;
  }

 private:
  std::vector<double> times_, values_;
  double sum_ = 0;  // of the weights
};

std::span<const HistoryRow> between(const std::vector<HistoryRow>& history, double from, double to) {
  const auto before = [](const HistoryRow& row, double x) { return row.position < x; };
  const auto first = std::lower_bound(history.begin(), history.end(), from, before);
  const auto last = std::lower_bound(first, history.end(), to, before);
  return {first, last};
}

ForceLine line_at(const CaseSpec& spec, const WindowedForce& force, double frequency) {
  return {frequency, spec.drive.speed / frequency, force.amplitude(frequency)};
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
    if (row.position >= run_up_of(spec, 0)) rows.push_back(row);
  const auto larger = [](double value, double& most) {
    const bool is = !(value < most);  // than none too
    if (is) most = value;
    return is;
  };
  for (const HistoryRow& row : rows) {
    if (larger(wheel_force(row), out.F_z_max)) out.F_z_max_position = row.position;
    if (!(wheel_force(row) > out.F_z_min)) {
      out.F_z_min = wheel_force(row);
      out.F_z_min_position = row.position;
    }
    if (larger(row.p_max, out.p_max)) out.p_max_position = row.position;
    if (!system.varies_along()) continue;
    if (!system.rail().mesh.interfaces.empty()) {
      larger(row.interface.opening, out.interface_opening);
      larger(row.interface.slip, out.interface_slip);
    }
    larger(row.way.patches, out.parts);
    if (larger(row.stress.von_mises, out.von_mises)) {
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

std::vector<ForceLine> force_spectrum(const CaseSpec& spec, const std::vector<HistoryRow>& history) {
  constexpr std::size_t kFewest = 32;
  constexpr double kHighest = 5000;  // Hz
  if (!changes_on_way(spec)) return {};
  const std::span<const HistoryRow> rows =
      between(history, run_up_of(spec, 0), std::numeric_limits<double>::infinity());
  if (rows.size() < kFewest) return {};
  const double time = rows.back().time - rows.front().time,
               highest = std::min(kHighest, static_cast<double>(rows.size()) / time / 6);
  const WindowedForce force(rows);
  std::vector<ForceLine> out;
  for (int k = 1; 0.5 * k / time <= highest; ++k) out.push_back(line_at(spec, force, 0.5 * k / time));
  return out;
}

std::optional<ForceLine> passing_force(const CaseSpec& spec, const std::vector<HistoryRow>& history) {
  constexpr double kHeldWaves = 8, kFewestWaves = 4;
  for (const Irregularity& is : spec.irregularities) {
    const auto* corrugation = std::get_if<Corrugation>(&is.shape);
    const auto* oval = std::get_if<OutOfRound>(&is.shape);
    if (!corrugation && !oval) continue;
    const double wave = corrugation ? *corrugation->wavelength : kTurn * spec.geometry.wheel_radius / oval->order;
    double from = run_up_of(spec, 0), to = history.empty() ? 0 : history.back().position;
    if (corrugation && corrugation->from) from = std::max(from, *corrugation->from + wave);
    if (corrugation && corrugation->to) to = std::min(to, *corrugation->to - wave);
    const double wanted = spec.track.held() ? kHeldWaves * wave : spec.track.support.spacing,
                 waves = std::floor(std::min(wanted, to - from) / wave);
    if (waves < kFewestWaves) continue;
    return line_at(spec, WindowedForce(between(history, to - waves * wave, to)), spec.drive.speed / wave);
  }
  return std::nullopt;
}

}  // namespace railstrata
