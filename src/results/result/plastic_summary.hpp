#pragma once
// Plastic strain of a run: how much and where.
#include "fem/rolling_run.hpp"
#include "result/summary.hpp"

namespace railstrata {

/// For a case with run.plasticity. Place: the element with the largest accumulated plastic strain; depth below the
/// surface along its normal in the fine zone, deeper below the rigid contact point.
PlasticSummary plastic_summary(const RollingSystem& system, const RunResult& run);

}  // namespace railstrata
