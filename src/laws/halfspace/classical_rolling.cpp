#include "halfspace/classical_rolling.hpp"

#include <algorithm>
#include <cmath>

namespace railstrata {

CattaneoShift cattaneo_shift(const HertzContact& circle, double friction, double force, const HalfSpaceMaterial& wheel,
                             const HalfSpaceMaterial& rail) {
  const double left = std::clamp(1 - std::abs(force) / (friction * circle.load), 0.0, 1.0);
  const double compliance = (2 - wheel.poisson) / wheel.shear() + (2 - rail.poisson) / rail.shear();
  return {circle.a * std::cbrt(left),
          3 * friction * circle.load / (16 * circle.a) * compliance * (1 - std::cbrt(left * left))};
}

double cattaneo_traction(const HertzContact& circle, double friction, double stick_radius, double r) {
  const double full = friction * circle.pressure(r, 0);
  if (r >= stick_radius) return full;
  const double s = r / stick_radius;
  return full - friction * circle.p0 * stick_radius / circle.a * std::sqrt(1 - s * s);
}

CarterRolling carter_rolling(double half_width, double p0, double relative_curvature, double friction,
                             double force_ratio) {
  const double c = half_width * std::sqrt(std::clamp(1 - force_ratio, 0.0, 1.0));
  return {half_width, p0, friction, c, -friction * relative_curvature * (half_width - c)};
}

double CarterRolling::traction(double x) const {
  const auto semicircle = [](double s) { return s * s < 1 ? std::sqrt(1 - s * s) : 0.0; };
  const double full = friction * p0 * semicircle(x / half_width);
  const double centre = half_width - stick_half_width;
  const double relief =
      stick_half_width > 0 ? friction * p0 * stick_half_width / half_width * semicircle((x - centre) / stick_half_width)
                           : 0.0;
  return -(full - relief);
}

double vermeulen_johnson_force_ratio(double tau) {
  const double left = std::max(0.0, 1 - tau / 3);
  return 1 - left * left * left;
}

double vermeulen_johnson_tau(double force_ratio) { return 3 * (1 - std::cbrt(1 - force_ratio)); }

double vermeulen_johnson_slip_fraction(double force_ratio) {
  const double left = std::cbrt(1 - force_ratio);
  return 1 - left * left;
}

}  // namespace railstrata
