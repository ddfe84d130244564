#pragma once
// Some passes over a new rail by the stationary method, for a life: what every point of the section gathers, and by
// which trend it fades.
#include "bem/solve_bem.hpp"
#include "core/control.hpp"
#include "lives/zone_life.hpp"
#include "model/model.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata {

/// spec.life.passes passes under every patch of a result, each followed alone: where a wheel touches tread and gauge
/// corner, the rail below one of them does not see what the other has left behind. Pressure as passes.pressure says.
/// Throws CaseError as rail_passes, and where pressure is to follow the surface below several patches; Interrupted.
PassedSections passed_sections(const CaseSpec& spec, const Placement& placement, const BemResult& result,
                               const BemOptions& bem, const Control* control = nullptr);

}  // namespace railstrata
