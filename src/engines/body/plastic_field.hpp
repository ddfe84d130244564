#pragma once
// Plastic strains of the elements that may yield: element by element for pictures, the place of the largest plastic
// strain, and what of the plastic work hardening has stored.
#include "body/body.hpp"
#include "body/element_plasticity.hpp"

namespace railstrata {

/// psi: rotation of a wheel, as in the traversal. Zeros of an element that stays elastic.
ElementPlasticity element_plasticity(const Body& body, double psi, const PlasticHistory& history, int block, int quad,
                                     int station);

/// The element with the largest accumulated plastic strain of any of its points.
struct PlasticPeak {
  double accumulated = 0;                ///< of that point
  int block = 0, quad = 0, station = 0;  ///< of the element; nothing where nothing has yielded
};
PlasticPeak plastic_peak(const Body& body, const PlasticHistory& history);

/// Largest accumulated plastic strain and largest norm sqrt(2/3 Ep:Ep) of any point.
struct PlasticExtent {
  double accumulated = 0, strain = 0;
  long yielded = 0;  ///< elements with plastic strain
};
PlasticExtent plastic_extent(const Body& body, const PlasticHistory& history);

/// Energy that the backstresses hold, the integral of sum_i 3/(4 C_i) alpha_i:alpha_i [J]: part of plastic_work
/// (body/plastic_pass.hpp), the rest of which has become heat. [Chaboche1989]
double backstress_energy(const Body& body, const PlasticHistory& history);

}  // namespace railstrata
