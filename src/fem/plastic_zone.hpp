#pragma once
// Where rail and wheel may yield, and a watch that nothing yields outside.
//
// With run.plasticity materials that say a strength yield (model/material_strength.hpp). Their elements may yield in a
// box under the path of the contact: run.plastic_depth deep, run.plastic_width to either side, by default 2.5 and 1.6
// times what Hertz gives as the larger half-axis and the half-width, and from a patch length behind the start to one
// ahead of the end. The box is memory, not time: within it groups of elements sleep until they come near yielding, so
// that those at work follow the wheel (body/plastic_pass.hpp). Elements of the box's materials outside of it stay
// elastic; the watch ends a run in which one of them reaches its yield stress.
#include "body/plastic_elements.hpp"
#include "core/body_id.hpp"
#include "model/model.hpp"

namespace railstrata {

class Stepper;

/// None if the case does not ask for plasticity. Throws CaseError, also where nothing of either body yields.
PlasticElements plastic_zone(const Model& model, BodyId id, const Body& body);

/// Steps between two looks of the watch; a restart point.
inline constexpr int kWatchInterval = 256;
/// Throws a NumericalError if an element that would yield outside of the box reached its yield stress.
void require_elastic_outside(const Stepper& stepper);

}  // namespace railstrata
