#include "passage/force_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <span>

#include "rules/irregularity_rules.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {
namespace {

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

std::vector<ForceLine> force_spectrum(const CaseSpec& spec, const std::vector<HistoryRow>& history) {
  constexpr std::size_t kFewest = 32;
  constexpr double kHighest = 5000;  // Hz
  if (!changes_on_way(spec)) return {};
  const std::span<const HistoryRow> rows = between(history, spec.run.run_up, std::numeric_limits<double>::infinity());
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
    double from = spec.run.run_up, to = history.empty() ? 0 : history.back().position;
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
