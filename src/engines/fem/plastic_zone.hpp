#pragma once
// The parts of rail and wheel that may yield, and the initial stress of their manufacture.
//
// With run.plasticity materials with a strength yield (model/material_strength.hpp). Their elements become hot where
// the elastic stress comes near the strength: in the equilibrium before the rolling, and ahead of the wheel on its way
// (extend_plastic_elements, body/plastic_pass.hpp). Which are hot does not show in the results; tests and benches make
// those of a box hot from the start.
//
// Initial stress lies along the surface: in the block of the running surface along the facet above and by the depth of
// the row, elsewhere along the contact plane and by the depth below the contact point. Longitudinal: along the sweep.
#include "body/initial_stress.hpp"
#include "body/plastic_elements.hpp"
#include "core/body_id.hpp"
#include "model/model.hpp"

namespace railstrata {

/// Elements within this depth and half-width of the contact point, all along, m.
struct HotBox {
  double depth = 0, half_width = 0;
};

/// None if the case does not ask for plasticity. Throws CaseError, also where nothing of either body yields.
PlasticElements plastic_zone(const Model& model, BodyId id, const Body& body, const HotBox& hot = {});

/// None if the case does not ask for plasticity: fields of elastic runs are those of the contact alone, and what is
/// judged by them adds the initial stress.
InitialStress initial_stress(const Model& model, BodyId id, const SweptBody& mesh);

}  // namespace railstrata
