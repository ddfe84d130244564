#pragma once
// A finite element result as a Summary, with its checks.
#include "fem/rolling_run.hpp"
#include "result/rolling_mean.hpp"
#include "result/summary.hpp"

namespace railstrata {

/// engine, wall times, steps and checks are filled in; commit, threads and peak memory are the program's to add.
Summary fem_summary(const RollingSystem& system, const RunResult& run, const MeanContact& mean);

/// Limits: check_limits.hpp. Preload residual, mean F_z against G, F_x/F_z against the wanted traction coefficient of a
/// wheel that drives or brakes, penetration against the Hertzian approach, energy closure, scatter of p_max in the
/// window, hourglass energy (one_point elements), the patch inside the fine zone.
std::vector<Check> finite_element_checks(const Model& model, const RunResult& run, const MeanContact& mean);

}  // namespace railstrata
