#pragma once
// Stress and displacement gradient of single elements.
#include <array>

#include "body/body.hpp"

namespace railstrata {

/// Cauchy stress at the centre of an element, model frame [Pa]; history: of the body's elements, as committed.
Sym3 element_stress(const Body& body, const Field& u, const PlasticHistory& history, int block, int quad, int station);

/// Displacement gradient du_i/dX_j at the centre, X in the element's own frame, u in the model frame: columns along the
/// sweep, lateral, up.
std::array<Vec3, 3> displacement_gradient(const Body& body, const Field& u, int block, int quad, int station);

}  // namespace railstrata
