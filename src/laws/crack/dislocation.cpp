#include "crack/dislocation.hpp"

#include <cmath>
#include <numbers>

namespace railstrata {

LineTraction traction_on(const PlaneStress& s, double angle) {
  const double c = std::cos(2 * angle), d = std::sin(2 * angle), mean = 0.5 * (s.xx + s.zz),
               half = 0.5 * (s.zz - s.xx);
  return {mean + half * c - s.xz * d, half * d + s.xz * c};
}

PlaneStress dislocation_stress(const HalfSpaceMaterial& material, std::complex<double> at, std::complex<double> from,
                               std::complex<double> jump) {
  using Complex = std::complex<double>;
  const double kappa = 3 - 4 * material.poisson;
  const Complex a = Complex(0, -1) * material.shear() / (std::numbers::pi * (kappa + 1)) * jump, ca = std::conj(a),
                mirror = std::conj(from);
  const Complex r = 1.0 / (at - from), m = 1.0 / (at - mirror), m2 = m * m, m3 = m2 * m;
  // Φ0, Φ0', Ψ0; then the same of the image: Φ1 = -[ca m - ζ ca m² + a m + ca ζ0 m²]
  const Complex phi0 = a * r, dphi0 = -a * r * r, psi0 = ca * r + a * mirror * r * r;
  const Complex phi1 = -((ca + a) * m + ca * (from - at) * m2);
  const Complex dphi1 = (ca + a) * m2 + ca * m2 + 2.0 * ca * (from - at) * m3;
  const Complex psi1 = -ca * m - phi1 - at * dphi1;
  const double sum = 4 * (phi0 + phi1).real();
  const Complex difference = 2.0 * (std::conj(at) * (dphi0 + dphi1) + psi0 + psi1);
  return {0.5 * (sum - difference.real()), 0.5 * (sum + difference.real()), 0.5 * difference.imag()};
}

}  // namespace railstrata
