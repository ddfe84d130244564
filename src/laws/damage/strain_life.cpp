#include "damage/strain_life.hpp"

#include <algorithm>

#include "damage/positive.hpp"

namespace railstrata {

std::optional<StrainLife> uniform_material_law(double tensile, double young) {
  const double psi = std::min(1.0, 1.375 - 125 * positive(tensile, "tensile strength") / positive(young, "modulus"));
  if (!(psi > 0)) return std::nullopt;
  return StrainLife{1.5 * tensile, -0.087, 0.59 * psi, -0.58};
}

StrainLife median_strain_life(double tensile) {
  return {1.5 * positive(tensile, "tensile strength"), -0.09, 0.45, -0.59};
}

/// The strain falls with the life and is convex in logarithms: Newton's method from the longer of the two lives that
/// each part alone would give comes from one side.
double cycles_of_strain(const StrainLife& life, double young, double amplitude) {
  const double wanted = std::log(positive(amplitude, "strain amplitude"));
  double log_life =
      std::log(2 * std::max(cycles_of_stress(life, young * amplitude), cycles_of_plastic_strain(life, amplitude)));
  for (double step = 1; std::abs(step) > 1e-12;) {
    const double elastic = life.strength / young * std::exp(life.strength_exponent * log_life);
    const double plastic = life.ductility * std::exp(life.ductility_exponent * log_life);
    const double slope = (life.strength_exponent * elastic + life.ductility_exponent * plastic) / (elastic + plastic);
    step = (wanted - std::log(elastic + plastic)) / slope;
    log_life += step;
  }
  return 0.5 * std::exp(log_life);
}

}  // namespace railstrata
