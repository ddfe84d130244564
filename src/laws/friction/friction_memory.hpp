#pragma once
// Memory of friction that falls with slip: the coefficient of a particle follows the law over a distance of sliding.
//
//   dm/dt = (m_s(v) - m) max(v, v_0)/d,    m = f/f_stat, m_s(v) the law's share     [VollebregtSchuttelaars2012]
// d [m] memory distance, v_0 [m/s] the least velocity by which it follows, so that friction comes back at rest. A
// particle enters the contact with m = 1. Over a step of constant v, exactly:
//   m = m_s + (m_before - m_s) exp(-max(v, v_0) dt/d)
// and by Euler's backward rule, on request, with 1/(1 + max(v, v_0) dt/d) in place of the exponential function.
// The stored value is the lost share 1 - m: 0 for a particle that has not slipped.
//
// Stability of sliding of two half-spaces, quasi-dynamic: inertia as the plane waves that both radiate, traction
// eta = G/(2 c_s) by slip velocity. Without a memory a law with P |m_s'| > eta, P = f_stat p, makes every disturbance
// grow. With a memory, one that goes as exp(st) with the wave number k along the surfaces has
//   eta (d/v) s² + (eta + K d/v - P |m_s'|) s + K = 0,   K = G k/2
// (K: traction over slip of the softest waves, sheared across their direction). All of them decay if
//   K d > (P |m_s'(v)| - eta) v,    so that the longest wave decides: d > (P |m_s'| - eta) v lambda/(pi G)
// P v |m_s'| is at most P (1 - m_kin)/e (exponential) or a quarter (rational) for all v, so that some micrometres are
// enough for a wheel on a rail.
#include <algorithm>
#include <cmath>

#include "friction/falling_friction.hpp"

namespace railstrata {

/// The share after a step and how it depends on the step's slip velocity and on what was lost before.
struct RememberedShare {
  FrictionShare share;
  double by_lost_before = 0;  ///< derivative of what is lost by what was lost, 0 to 1
  RAILSTRATA_POINTWISE double lost() const { return 1 - share.value; }
};

/// lost: 0 to 1, before the step of dt [s] at the slip velocity v. Without a memory the law's share.
RAILSTRATA_POINTWISE RememberedShare remembered_share(const FallingFriction& law, double lost, double v, double dt) {
  const FrictionShare steady = friction_share(law, v);
  if (!law.remembers()) return {steady, 0};
  const double rate = std::max(v, law.memory_velocity) / law.memory_distance,
               kept = law.implicit_memory ? 1 / (1 + rate * dt) : std::exp(-rate * dt),
               falls = law.implicit_memory ? kept * kept : kept, excess = lost - (1 - steady.value);
  const double by_way = v > law.memory_velocity ? excess * falls * dt / law.memory_distance : 0.0;
  return {{steady.value - excess * kept, (1 - kept) * steady.by_slip_velocity + by_way}, kept};
}

/// The lost share 1 - m after a step. 0 for laws that do not fall.
RAILSTRATA_POINTWISE double lost_after(const FallingFriction& law, double lost, double slip_velocity, double dt) {
  return law.falls() ? remembered_share(law, lost, slip_velocity, dt).lost() : 0.0;
}

/// Largest |dm/dv| [s/m] at the end of a step of dt [s] that begins with a particle that has not slipped, over all slip
/// velocities. Without a memory the law's own at rest.
double steepest_fall(const FallingFriction& law, double dt);

/// Shear modulus [Pa] and density [kg/m³] of two equal half-spaces, the longest wave [m] that fits the contact.
struct SlidingWaves {
  double shear_modulus = 0, density = 0, longest = 0;
};

/// The memory distance [m] from which on steady sliding under the bound f_stat p [Pa] is stable at every velocity; 0
/// where it is so without a memory.
double stable_memory_distance(const FallingFriction& law, double bound, const SlidingWaves& waves);

}  // namespace railstrata
