#pragma once
// Warnings of a finite element run before it starts, and of its results for the same reasons.
#include <optional>
#include <vector>

#include "fem/step_plan.hpp"
#include "judge/check_limits.hpp"
#include "result/summary.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata {

/// Largest share of a block's mass that mass scaling may add without a warning.
inline constexpr double kMuchAddedMass = check_row("mass_scaling_adds_much").fem_limit;
/// Memory distance that steady sliding needs over the given one: limit of the warning.
inline constexpr double kShortFrictionMemory = check_row("short_friction_memory").fem_limit;

/// Warnings of a case that is measured at a wheel position [m]:
///   measured_within_torque_ramp   the window begins before the torque has its full value (the ramp's time times the
///                                 speed; value and limit are lengths): the wanted traction cannot be reached there
///   mass_scaling_adds_much        to a block (value and limit are shares of the block's mass; the text has kilograms)
std::vector<Warning> run_advice(const CaseSpec& spec, double position, const StepLimits& limits);

/// short_friction_memory: friction.memory_distance is below what steady sliding needs under the pressure p_max [Pa] in
/// a patch whose longer axis is `longer_axis` [m] (model/sliding_waves.hpp); value: the latter over the former.
std::optional<Warning> memory_advice(const CaseSpec& spec, double p_max, double longer_axis);

/// Adds the warnings to a summary. Where traction_coefficient_reached fails within the torque's ramp, the warning gives
/// this reason.
void add_run_advice(Summary& summary, const CaseSpec& spec, const StepLimits& limits);

}  // namespace railstrata
