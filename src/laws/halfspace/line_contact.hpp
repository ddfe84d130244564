#pragma once
// Line contact: half-spaces in plane strain, loaded evenly along y without end.
//
// Counterpart of boussinesq_cerruti.hpp and interior.hpp for strips of the width dx along x.
// Displacements under a load per length grow with the logarithm of the distance, so that they are known up to a
// constant alone: here they vanish (each image of a layered body by itself) at the distance `far` along the surface.
// No approach of distant points follows from them. [Johnson1985 sec. 2.3–2.6, 4.3]
#include <vector>

#include "halfspace/boussinesq_cerruti.hpp"
#include "halfspace/interior.hpp"

namespace railstrata {

/// Hertz's line contact of the gap A x² under a load per length P [N/m]: half-width a = sqrt(2 P/(pi E* A)) and p0 = 2
/// P/(pi a), p = p0 sqrt(1 - x²/a²). [Johnson1985 eq. 4.43–4.45]
struct LineHertz {
  double a = 0;   ///< m
  double p0 = 0;  ///< Pa
};
LineHertz hertz_line(double A, double contact_modulus, double load_per_length);

/// Displacements at x from the middle of a strip under unit traction [m/Pa], signs as in RectangleInfluence; xy and ny
/// are zero. yy: of traction along the strip.
RectangleInfluence strip_influence(const SurfaceCompliance& compliance, double x, double dx, double far);

/// Influences at x = i dx, i = 0 … nx-1. far: the largest distance, or the depth of the farthest image where that is
/// more.
std::vector<RectangleInfluence> strip_influence_table(const SurfaceCompliance& compliance, int nx, double dx);

/// The state at x from the middle of a strip and at the depth z >= 0, under unit p, q_x, q_y (index 0, 1, 2): Flamant's
/// solutions integrated. Strains along y are zero. On the surface not on the strip's edges.
InteriorInfluence strip_interior(const HalfSpaceMaterial& material, double x, double z, double dx);

/// Interior influences at x = i dx, i = 0 … nx-1.
std::vector<InteriorInfluence> strip_interior_table(const HalfSpaceMaterial& material, double z, int nx, double dx);

}  // namespace railstrata
