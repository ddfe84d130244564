#pragma once
// Fatigue below the surface, brittle layers and interfaces of a body's section, as far as the case gives constants.
#include "damage/stress_history.hpp"
#include "fatigue/row_strength.hpp"
#include "result/summary.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata {

/// Whether a case gives anything that a body's fatigue is computed from: limits, toughness, bonds.
bool fatigue_given(const CaseSpec& spec, BodyId body);

/// `strength`: row_strength of the same rows. Parameters without constants are left out.
BodyFatigue section_fatigue(const CaseSpec& spec, BodyId body, const StressHistory& history,
                            const RowStrength& strength);

}  // namespace railstrata
