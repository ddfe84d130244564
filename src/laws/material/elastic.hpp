#pragma once
// Isotropic linear elasticity as pointwise functions: no arrays, no memory, any number type.
#include <cmath>

#include "core/simd.hpp"
#include "core/vec.hpp"

namespace railstrata {

/// Lamé constants [Pa] and density [kg/m³] of one material.
struct Elastic {
  double lambda = 0, mu = 0, density = 0;
  double p_wave_modulus() const { return lambda + 2 * mu; }
};

/// From Young's modulus E [Pa] and Poisson's ratio nu in (-1, 0.5).
inline Elastic elastic(double young, double poisson, double density) {
  return {young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson)), density};
}
inline double young(const Elastic& m) { return m.mu * (3 * m.lambda + 2 * m.mu) / (m.lambda + m.mu); }
inline double poisson(const Elastic& m) { return m.lambda / (2 * (m.lambda + m.mu)); }

/// Stress from strain, S = lambda tr(E) I + 2 mu E; components xx, yy, zz, xy, yz, xz. With E the Green strain and S
/// the second Piola–Kirchhoff stress this is the St. Venant–Kirchhoff law. [SimoHughes1998]
template <class T, class Real>
RAILSTRATA_POINTWISE void elastic_stress(Real lambda, Real mu, const T (&strain)[6], T (&stress)[6]) {
  const T pressure = lambda * (strain[0] + strain[1] + strain[2]);
  RAILSTRATA_UNROLL
  for (int i = 0; i < 3; ++i) stress[i] = pressure + 2 * mu * strain[i];
  RAILSTRATA_UNROLL
  for (int i = 3; i < 6; ++i) stress[i] = 2 * mu * strain[i];
}

/// Material parameters that an element reads; Real float or double. A further number stands here, in
/// material_parameters and in rounded_to.
template <class Real>
struct MaterialParameters {
  Real lambda, mu;  ///< Pa

  template <class Other>
  MaterialParameters<Other> rounded_to() const {
    return {static_cast<Other>(lambda), static_cast<Other>(mu)};
  }
};
inline MaterialParameters<double> material_parameters(const Elastic& m) { return {m.lambda, m.mu}; }

/// von Mises stress, sqrt(3/2 s:s).
inline double von_mises(const Sym3& s) {
  const double a = s.xx - s.yy, b = s.yy - s.zz, c = s.zz - s.xx;
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * (s.xy * s.xy + s.yz * s.yz + s.xz * s.xz));
}

/// Principal stresses, largest first, to rounding, repeated ones too.
Vec3 principal_stresses(const Sym3& s);

}  // namespace railstrata
