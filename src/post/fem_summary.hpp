#pragma once
// A finite element result as a Summary, with its checks.
#include "fem/rolling_run.hpp"
#include "post/rolling_mean.hpp"
#include "post/summary.hpp"

namespace railstrata {

/// engine, wall times, steps and checks are filled in; commit, threads and peak memory are the program's to add.
/// Checks (limits): mean F_z against G (0.5 %), F_x/F_z against the wanted traction coefficient (1 %), energy closure
/// (1 %), hourglass energy (2 %, one_point elements), penetration (1 % of the Hertzian approach), scatter of p_max in
/// the window (1.5 %), the patch inside the fine zone, preload residual.
Summary fem_summary(const RollingSystem& system, const RunResult& run, const MeanContact& mean);

}  // namespace railstrata
