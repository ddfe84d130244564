#include "judge/force_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <span>

#include "case/case_spec.hpp"
#include "case/irregularity_rules.hpp"

namespace railstrata {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// Hann's weight of a row between two times.
double weight(const HistoryRow& row, double begin, double end) {
  const double s = std::sin(0.5 * kTurn * (row.time - begin) / (end - begin));
  return s * s;
}

/// At one frequency, of rows at equal intervals.
double amplitude_at(std::span<const HistoryRow> rows, double frequency) {
  const double begin = rows.front().time, end = rows.back().time;
  double weights = 0, mean = 0;
  for (const HistoryRow& row : rows) {
    const double w = weight(row, begin, end);
    weights += w;
    mean += w * wheel_force(row);
  }
  mean /= weights;
  std::complex<double> sum = 0;
  for (const HistoryRow& row : rows)
    sum +=
        weight(row, begin, end) * (wheel_force(row) - mean) * std::polar(1.0, -kTurn * frequency * (row.time - begin));
  return 2 * std::abs(sum) / weights;
}

std::span<const HistoryRow> between(const std::vector<HistoryRow>& history, double from, double to) {
  const auto before = [](const HistoryRow& row, double x) { return row.position < x; };
  const auto first = std::lower_bound(history.begin(), history.end(), from, before);
  const auto last = std::lower_bound(first, history.end(), to, before);
  return {first, last};
}

ForceLine line_at(const CaseSpec& spec, std::span<const HistoryRow> rows, double frequency) {
  return {frequency, spec.drive.speed / frequency, amplitude_at(rows, frequency)};
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
  std::vector<ForceLine> out;
  for (int k = 1; 0.5 * k / time <= highest; ++k) out.push_back(line_at(spec, rows, 0.5 * k / time));
  return out;
}

std::optional<ForceLine> passing_force(const CaseSpec& spec, const std::vector<HistoryRow>& history) {
  constexpr double kHeldWaves = 8, kFewestWaves = 4;
  for (const Irregularity& is : spec.irregularities) {
    const bool corrugation = is.kind == IrregularityKind::corrugation;
    if (!corrugation && is.kind != IrregularityKind::out_of_round) continue;
    const double wave = corrugation ? *is.wavelength : kTurn * spec.geometry.wheel_radius / is.order;
    double from = spec.run.run_up, to = history.empty() ? 0 : history.back().position;
    if (corrugation && is.from) from = std::max(from, *is.from + wave);
    if (corrugation && is.to) to = std::min(to, *is.to - wave);
    const double wanted = spec.track.held() ? kHeldWaves * wave : spec.track.support.spacing,
                 waves = std::floor(std::min(wanted, to - from) / wave);
    if (waves < kFewestWaves) continue;
    return line_at(spec, between(history, to - waves * wave, to), spec.drive.speed / wave);
  }
  return std::nullopt;
}

}  // namespace railstrata
