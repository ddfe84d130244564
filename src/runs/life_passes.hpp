#pragma once
// Some passes over a new rail by the stationary method, for a life: what every point of the section gathers, and by
// which trend it fades.
#include "bem/solve_bem.hpp"
#include "case/case_fwd.hpp"
#include "core/control.hpp"
#include "judge/zone_life.hpp"

namespace railstrata {

/// spec.life.passes passes under the contact of a result. Throws CaseError as rail_passes; Interrupted.
PassedSection passed_section(const CaseSpec& spec, const BemResult& result, const Control* control = nullptr);

}  // namespace railstrata
