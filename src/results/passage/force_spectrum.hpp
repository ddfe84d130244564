#pragma once
// The wheel force of a way over what changes along the rail, by frequency.
#include <cmath>
#include <optional>
#include <vector>

#include "fem/rolling_run.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata {

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
