#pragma once
// What happened to a wheel on its way over what changes along the rail: extremes of its history, and its force by
// frequency.
#include <cmath>
#include <optional>
#include <vector>

#include "fem/rolling_run.hpp"
#include "result/summary.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata {

/// Extremes of the history from the end of the run-up on. Over a dip P1, the largest force within 2 ms of its tip, and
/// P2, the largest mean of 2 ms from 2.2 ms after it on, beside Jenkins' ranges (track/joint_force.hpp). Empty of rails
/// that are the same all along and held.
PassageSummary passage_summary(const RollingSystem& system, const RunResult& run);

/// P2 [N]: the largest mean of the wheel force over 2 ms that begins at a time [s] or later. NaN where it is the first
/// or the last of them: the history ends before the force has passed its peak.
double second_peak(const std::vector<HistoryRow>& rows, double begin);

/// Fatigue of the rail at the points whose stress is followed, by their own cycle of this passage. Empty without such
/// points, without a limit or a constant in the case, and of bodies that yield: their cycle is not closed. Within a
/// stretch ([[stretch]]) yield stress and limit have its factor of strength, strains its factor of Young's modulus.
std::vector<BodyFatigue> passage_fatigue(const RollingSystem& system, const RunResult& run);

/// N, normal force on the rail.
inline double wheel_force(const HistoryRow& row) { return std::abs(row.forces.z); }

struct ForceLine {
  double frequency = 0, wavelength = 0;  ///< Hz; m at the case's speed
  double amplitude = 0;                  ///< N
};

/// Amplitudes of F_z from the end of the run-up on, at multiples of half of one over its time up to a sixth of the rate
/// of rows and 5 kHz: |∑ w (F - F_mean) exp(-i ω t)| 2/∑ w, Hann's weights w. A line's neighbours share its peak. Empty
/// where nothing changes along the way, and below 32 rows.
std::vector<ForceLine> force_spectrum(const CaseSpec& spec, const std::vector<HistoryRow>& history);

/// The amplitude at the passing frequency speed/wavelength of the first corrugation or out-of-round wheel, over the
/// last whole waves of one sleeper spacing, or of eight waves where the foot is held; none: there is no such height, or
/// fewer than four waves.
std::optional<ForceLine> passing_force(const CaseSpec& spec, const std::vector<HistoryRow>& history);

}  // namespace railstrata
