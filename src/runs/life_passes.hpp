#pragma once
// Some passes over a new rail by the stationary method, for a life: what every point of the section gathers, and by
// which trend it fades.
#include <vector>

#include "bem/solve_bem.hpp"
#include "case/case_fwd.hpp"
#include "core/control.hpp"
#include "judge/zone_life.hpp"

namespace railstrata {

/// spec.life.passes passes under every patch of a result, each followed alone: where a wheel touches tread and gauge
/// corner, the rail below one of them does not see what the other has left behind. Throws CaseError as rail_passes;
/// Interrupted.
std::vector<PassedSection> passed_sections(const CaseSpec& spec, const BemResult& result,
                                           const Control* control = nullptr);

}  // namespace railstrata
