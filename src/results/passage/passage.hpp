#pragma once
// What happened to a wheel on its way over what changes along the rail: extremes of its history.
#include "fem/rolling_run.hpp"
#include "result/summary.hpp"

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

}  // namespace railstrata
