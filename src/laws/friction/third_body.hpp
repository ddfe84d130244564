#pragma once
// A third-body layer (wear debris, sand, leaves, lubricant) between the surfaces: an elastic-plastic film in shear, in
// series with friction. [HouKalousekMagel1997]
//
//   u = q h/G + u_pl,    |q| <= tau_c = max(tau_c0 + k u_pl, tau_r),    u_pl grows along q while |q| = tau_c
// u [m] the displacement of one face over the other, h the thickness, G the shear modulus, u_pl the length of the path
// sheared plastically. k < 0: the film softens down to tau_r; below k = -G/h it would snap back. Friction bounds the
// same traction, |q| <= f p, so that the lower bound moves: the film yields or slides. Elastic shear is a part of the
// bodies' flexibility (bem/influence_operator.hpp). Strength and modulus may rise with the pressure p and fall with the
// temperature by a factor c: c (tau_c0 + alpha p), c (G + beta p).
#include <algorithm>

#include "core/pointwise.hpp"

namespace railstrata {

struct ThirdBody {
  double thickness = 0;                                   ///< m; 0: none
  double shear_modulus = 1;                               ///< Pa
  double yield_shear = 0;                                 ///< tau_c0 [Pa]; 0: elastic
  double hardening = 0;                                   ///< k [Pa/m], > -1/flexibility()
  double residual = 0;                                    ///< tau_r [Pa], > 0 where k < 0
  double yield_by_pressure = 0, modulus_by_pressure = 0;  ///< rises of tau_c0 and G by the pressure

  RAILSTRATA_POINTWISE double flexibility() const { return thickness / shear_modulus; }  ///< m/Pa
  RAILSTRATA_POINTWISE bool yields() const { return thickness > 0 && yield_shear > 0; }
  /// The film of a place under pressure [Pa], its strength and modulus by `factor` of what they are cold.
  RAILSTRATA_POINTWISE ThirdBody under(double pressure, double factor) const {
    ThirdBody out = *this;
    if (yields()) out.yield_shear = factor * (yield_shear + yield_by_pressure * pressure);
    out.residual = factor * residual;
    out.shear_modulus = factor * (shear_modulus + modulus_by_pressure * pressure);
    return out;
  }
  /// tau_c [Pa] after the plastic shear u_pl [m].
  RAILSTRATA_POINTWISE double strength(double plastic) const {
    return std::max(residual, yield_shear + hardening * plastic);
  }
};

/// Traction of film and friction in series after a further slip of one face over the other.
struct FilmStep {
  double bound = 0;     ///< Pa
  double by_slip = 0;   ///< Pa/m, the bound's derivative by the further slip
  double plastic = 0;   ///< m, u_pl afterwards: the rest of the slip is friction's
  bool slides = false;  ///< friction is the lower bound
};

/// slid >= 0 [m]: the slip along the traction that is not elastic, of both together; plastic_before u_pl; friction f p
/// [Pa].
RAILSTRATA_POINTWISE FilmStep yield_or_slide(const ThirdBody& film, double friction, double plastic_before,
                                             double slid) {
  const double at_rest = film.strength(plastic_before);
  if (at_rest >= friction) return {friction, 0, plastic_before, true};
  const double plastic = plastic_before + slid, hardened = film.strength(plastic);
  if (hardened < friction) return {hardened, hardened > film.residual ? film.hardening : 0, plastic, false};
  return {friction, 0, plastic_before + (friction - at_rest) / film.hardening, true};
}

}  // namespace railstrata
