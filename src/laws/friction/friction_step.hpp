#pragma once
// Friction of a point over one step of time, with a third-body film in series, implicit in the step: what the point
// carries belongs to the slip and to the film's shear at the step's end, so that a stiff film asks for no shorter step.
//
//   w = s q/|q| + (h/G)(q - q_before)/dt,   w = w_0 - D q,   |q| <= g(s), s >= 0, one of the two with equality
// w [m/s] velocity of one face over the other, falling by D [(m/s)/Pa] per traction on them, w_0 without any; s slip
// velocity, without the film's elastic shear. With C = D + (h/G)/dt the traction that makes the point stick is
//   q_stick = q + (w - (h/G)(q - q_before)/dt)/C   for any q,   and   s = C (|q_stick| - |q|)
// along it, so that the law's return is one equation for s. g is f p, or the lower tau_c of a film that yields, whose
// path of plastic shear grows by s dt.
#include <cmath>

#include "friction/coulomb.hpp"
#include "friction/falling_friction.hpp"
#include "friction/third_body.hpp"

namespace railstrata {

struct FrictionLaws {
  double coefficient = 0;  ///< f at rest
  ThirdBody film;
  FallingFriction falling{};  ///< with a memory: what a step lost, the next one feels (FrictionStep::lost)
  double lateral_share = 1;   ///< f across rolling over f along it: an ellipse, not with a film that yields
};

/// A point and its step.
struct FrictionStep {
  double p = 0;               ///< Pa
  double compliance = 0;      ///< C, (m/s)/Pa
  double dt = 0;              ///< s
  double plastic_before = 0;  ///< m, u_pl of the film
  double lost = 0;            ///< share of the coefficient that earlier slip has taken (friction_memory.hpp)
};

struct FrictionReturn {
  bool slips = false;  ///< it slides, or the film yields
  double plastic = 0;  ///< m, u_pl afterwards
};

/// Brings q_stick (two components) back to what the laws let the point carry.
RAILSTRATA_POINTWISE FrictionReturn return_to_law(const FrictionLaws& laws, const FrictionStep& step, double& q1,
                                                  double& q2) {
  const double coefficient = laws.coefficient * (1 - step.lost);
  if (laws.lateral_share != 1) return {return_to_coulomb_ellipse(coefficient, laws.lateral_share, step.p, q1, q2), 0};
  if (!laws.film.yields()) return {return_to_coulomb_disc(coefficient, step.p, q1, q2), 0};
  const double friction = coefficient * (step.p > 0 ? step.p : 0), stick = std::sqrt(q1 * q1 + q2 * q2),
               at_rest = yield_or_slide(laws.film, friction, step.plastic_before, 0).bound;
  if (stick <= at_rest) return {false, step.plastic_before};
  const double hardening = at_rest < friction ? laws.film.hardening : 0,
               slid = (stick - at_rest) / (1 / (step.compliance * step.dt) + hardening);
  const FilmStep film = yield_or_slide(laws.film, friction, step.plastic_before, slid);
  q1 *= film.bound / stick;
  q2 *= film.bound / stick;
  return {true, film.plastic};
}

}  // namespace railstrata
