#include "crack/crack_growth.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace railstrata {

double equivalent_range(GrowthLaw law, const StressIntensity& range) {
  const double I = 1e-6 * range.I, II = 1e-6 * range.II;
  const double shear = law == GrowthLaw::shear ? std::pow(614.0 / 507.0 * std::pow(II, 3.21), 1 / 3.74) : II;
  return 1e6 * std::hypot(I, shear);
}

double growth_rate(GrowthLaw law, const StressIntensity& range, double threshold) {
  const double nm = 1e-9, equivalent = 1e-6 * equivalent_range(law, range);
  const double m = law == GrowthLaw::shear ? 3.74 : std::log(55.0 / 17.0) / std::log(1.35),
               A = law == GrowthLaw::shear ? 0.000507 * nm : 17 * nm * std::pow(10, -m);
  return std::max(0.0, A * (std::pow(equivalent, m) - std::pow(1e-6 * threshold, m)));
}

FrontFactors front_factors(double aspect, double poisson) {
  if (!std::isfinite(aspect)) return {};
  const double b = 1 / aspect, k2 = 1 - b * b, k = std::sqrt(std::max(0.0, k2));
  FrontFactors out;
  out.I = (1.13 - 0.09 * b) / (1.1215 * std::sqrt(1 + 1.464 * std::pow(b, 1.65)));
  // k²/[(k² + ν b²) E(k) - ν b² K(k)], of the circle its limit
  constexpr double kCircle = 1e-4;
  out.II = k2 < kCircle
               ? 4 / (std::numbers::pi * (2 - poisson))
               : k2 / ((k2 + poisson * b * b) * std::comp_ellint_2(k) - poisson * b * b * std::comp_ellint_1(k));
  return out;
}

}  // namespace railstrata
