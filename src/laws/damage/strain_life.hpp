#pragma once
// Strain-life curve of a material under alternating uniaxial strain (R = -1), N cycles of two reversals each:
//   De/2 = (s_f/E) (2N)^b + e_f (2N)^c     [Manson1965]
// Its first part alone is the stress-life line s_a = s_f (2N)^b, its second the law of Coffin and Manson. Measured
// curves of rail steels were not found in a source that can be read: where a case gives none, two estimates from the
// tensile strength stand for unalloyed and low-alloy steel, and how far they lie apart is the least of their doubt:
//   uniform material law [BaeumelSeeger1990]   s_f = 1.5 Rm, b = -0.087, e_f = 0.59 psi, c = -0.58,
//                                              psi = 1 up to Rm/E = 0.003, beyond 1.375 - 125 Rm/E
//   medians of many steels [MeggiolaroCastro2004]   s_f = 1.5 Rm, b = -0.09, e_f = 0.45, c = -0.59
// Both as public programs have them; lives of single tests scatter by more.
#include <algorithm>
#include <cmath>
#include <optional>

#include "damage/positive.hpp"

namespace railstrata {

struct StrainLife {
  double strength = 0, strength_exponent = 0;    ///< s_f [Pa], b < 0
  double ductility = 0, ductility_exponent = 0;  ///< e_f, c < 0
};

/// Pa. Nothing where psi is not above zero: Rm/E of 0.011 and more.
inline std::optional<StrainLife> uniform_material_law(double tensile, double young) {
  const double psi = std::min(1.0, 1.375 - 125 * positive(tensile, "tensile strength") / positive(young, "modulus"));
  if (!(psi > 0)) return std::nullopt;
  return StrainLife{1.5 * tensile, -0.087, 0.59 * psi, -0.58};
}
inline StrainLife median_strain_life(double tensile) {
  return {1.5 * positive(tensile, "tensile strength"), -0.09, 0.45, -0.59};
}

/// Cycles to a crack, of an amplitude of plastic strain.
inline double cycles_of_plastic_strain(const StrainLife& life, double amplitude) {
  return 0.5 * std::pow(amplitude / life.ductility, 1 / life.ductility_exponent);
}

}  // namespace railstrata
