#pragma once
// A half-space solution as a kind of wheels that damage a rail: its patches, and how long the rail lasts under them.
#include <vector>

#include "ask/solve_half_space.hpp"
#include "core/control.hpp"
#include "fatigue/rail_damage.hpp"
#include "lives/zone_life.hpp"
#include "model/model.hpp"

namespace railstrata {

/// Of all its patches.
std::vector<PatchDamage> patch_damages(const CaseSpec& spec, const HalfSpaceSolution& solution);

/// Lives of the rail if every wheel were this one: passes, wear and strengths of the solution (with shakedown), by
/// lives/zone_life.hpp; a unit of traffic is one wheel. Throws CaseError as passed_sections; Interrupted.
Lives life_of_load(const CaseSpec& spec, const Placement& placement, const HalfSpaceSolution& solution,
                   const BemOptions& bem, const Control* control = nullptr);

/// The same for a summary; what passes cannot follow is said in its text.
LifeSummary life_summary(const CaseSpec& spec, const Placement& placement, const HalfSpaceSolution& solution,
                         const BemOptions& bem, const Control* control = nullptr);

}  // namespace railstrata
