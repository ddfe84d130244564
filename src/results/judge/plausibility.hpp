#pragma once
// Warnings of results that are computed correctly but lie outside the range of the model, and of runs before they
// start.
#include <optional>
#include <string>
#include <vector>

#include "fem/step_plan.hpp"
#include "model/surroundings.hpp"
#include "result/summary.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata {

/// What of the wear by Jendel's map comes from outside it.
std::string outside_words(const MapShares& kth);

/// Largest elastic displacement in the third-body layer, q h/G, of half the patch's shorter axis; 0 without one.
double film_shear(const CaseSpec& spec, const PatchMeasures& patch);

/// Warnings from a summary and the surroundings of its patch; element: edge of a cell or element, m. From both engines:
/// few_cells_over_patch, contact_on_flange_crest, flange_outside_gauge, patch_wider_than_layer,
/// process_stress_beyond_yield,
/// von_mises_above_common_rail_yield; of finite elements patch_near_border_of_fine_zone (nearer than an element on each
/// side) and second_contact; of half-spaces patches_near_each_other, patch_spans_angle, patch_large_against_radius,
/// patch_near_edge, soft_film, stress_maximum_at_rim, kth_outside_map. Limits and words: check_limits.hpp; reasons:
/// docs/checks.md.
std::vector<Warning> implausible(const Summary& summary, const CaseSpec& spec, const PatchSurroundings& around,
                                 double element);

/// Of half-spaces, contact_on_flange_crest and flange_outside_gauge alone: a wheel that has climbed the rail.
std::vector<Warning> flange_warnings(const PatchSurroundings& around);

// ---- of a finite element run before it starts, and of its results for the same reasons
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
