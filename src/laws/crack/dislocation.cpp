#include "crack/dislocation.hpp"

#include <cmath>
#include <numbers>

namespace railstrata {

namespace {

using Complex = std::complex<double>;

struct Potentials {
  Complex phi, slope, psi;  ///< Φ, Φ', Ψ
};

/// σ_xx + σ_zz = 4 Re Φ, σ_zz - σ_xx + 2i σ_xz = 2 [ζ̄ Φ' + Ψ]
PlaneStress stress(Complex at, const Potentials& f) {
  const double sum = 4 * f.phi.real();
  const Complex difference = 2.0 * (std::conj(at) * f.slope + f.psi);
  return {0.5 * (sum - difference.real()), 0.5 * (sum + difference.real()), 0.5 * difference.imag()};
}

/// A, with κ = 3 - 4ν.
Complex strength(const HalfSpaceMaterial& material, Complex jump) {
  return Complex(0, -1) * material.shear() / (std::numbers::pi * 4 * (1 - material.poisson)) * jump;
}

}  // namespace

PlaneStress whole_plane_stress(const HalfSpaceMaterial& material, std::complex<double> at, std::complex<double> from,
                               std::complex<double> jump) {
  const Complex a = strength(material, jump), r = 1.0 / (at - from);
  return stress(at, {a * r, -a * r * r, std::conj(a) * r + a * std::conj(from) * r * r});
}

PlaneStress image_stress(const HalfSpaceMaterial& material, std::complex<double> at, std::complex<double> from,
                         std::complex<double> jump) {
  const Complex a = strength(material, jump), ca = std::conj(a), m = 1.0 / (at - std::conj(from)), away = from - at;
  const Complex phi = -((ca + a) * m + ca * away * m * m);
  const Complex slope = (2.0 * ca + a) * m * m + 2.0 * ca * away * m * m * m;
  return stress(at, {phi, slope, -ca * m - phi - at * slope});
}

}  // namespace railstrata
