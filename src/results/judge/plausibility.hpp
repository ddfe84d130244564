#pragma once
// Warnings of results that are computed correctly but lie outside the range of the model.
#include <vector>

#include "model/surroundings.hpp"
#include "result/summary.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata {

/// Largest elastic displacement in the third-body layer, q h/G, of half the patch's shorter axis; 0 without one.
double film_shear(const CaseSpec& spec, const PatchMeasures& patch);

/// Warnings from a summary and the surroundings of its patch; element: edge of a cell or element, m. From both engines:
/// few_cells_over_patch, contact_on_flange_crest, flange_outside_gauge, patch_wider_than_layer,
/// process_stress_beyond_yield,
/// von_mises_above_common_rail_yield; of finite elements patch_near_border_of_fine_zone (nearer than an element on each
/// side) and second_contact; of half-spaces patches_near_each_other, patch_spans_angle, patch_large_against_radius,
/// patch_near_edge, soft_film, stress_maximum_at_rim. Limits and words: check_limits.hpp; reasons: docs/checks.md.
std::vector<Warning> implausible(const Summary& summary, const CaseSpec& spec, const PatchSurroundings& around,
                                 double element);

}  // namespace railstrata
