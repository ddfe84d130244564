#pragma once
// Stresses of a dislocation in a homogeneous half-plane. Plane strain; x along the surface, z into the body.
#include <complex>

#include "crack/plane_of_rolling.hpp"
#include "halfspace/boussinesq_cerruti.hpp"

namespace railstrata {

/// At `at` = x + iz, of a dislocation at `from` with the Burgers vector `jump` = b_x + i b_z [m]: the displacement of
/// the side to the left of a line that ends there, less that of its right. In the whole plane, and what the free
/// surface of the half-plane adds:
///   Φ0 = A/(ζ - ζ0),  Ψ0 = Ā/(ζ - ζ0) + A ζ̄0/(ζ - ζ0)²,  A = -i µ (b_x + i b_z)/(π (κ + 1));
/// the image has Φ1 = -[Φ̄0 + ζ Φ̄0' + Ψ̄0], Ψ1 = -Φ̄0 - Φ1 - ζ Φ1'. [Muskhelishvili1953; HillsKellyDaiKorsunsky1996]
PlaneStress whole_plane_stress(const HalfSpaceMaterial& material, std::complex<double> at, std::complex<double> from,
                               std::complex<double> jump);
PlaneStress image_stress(const HalfSpaceMaterial& material, std::complex<double> at, std::complex<double> from,
                         std::complex<double> jump);

}  // namespace railstrata
