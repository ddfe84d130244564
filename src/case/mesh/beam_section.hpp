#pragma once
// A meshed section as that of a beam that is bent in its vertical plane.
#include "mesh/swept.hpp"

namespace railstrata {

/// Area [m²], second moment about the horizontal axis through the centroid [m⁴], and the share of the area that bears
/// shear: kappa = I²/(A ∫ Q²/b dz), b the width, Q the first moment of what lies above: the strain energy of shear
/// stresses that are even across the width; 5/6 of a rectangle.
struct BeamSection {
  double area = 0, inertia = 0, shear_share = 0;
};
BeamSection beam_section(const SweptBody& body);

}  // namespace railstrata
