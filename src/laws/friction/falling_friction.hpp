#pragma once
// Friction that falls with the velocity of slip, as a pointwise law.
//
//   f(v) = f_kin + (f_stat - f_kin) 2^(-v/v_half)       exponential [Polach2005]
//   f(v) = f_kin + (f_stat - f_kin)/(1 + v/v_half)      rational
// v [m/s] slip velocity at the point, v_half where half of the fall is done, f_kin the limit of fast slip. Here over
// the coefficient at rest, f(v)/f_stat: one law for coefficients that differ from point to point.
#include <cmath>
#include <numbers>

#include "core/pointwise.hpp"

namespace railstrata {

enum class FrictionForm { coulomb, falling_exponential, falling_rational };

struct FallingFriction {
  FrictionForm form = FrictionForm::coulomb;
  double kinetic_share = 1;      ///< f_kin/f_stat, 0 to 1
  double half_velocity = 1;      ///< m/s, > 0
  double memory_distance = 0;    ///< m; 0: the coefficient follows the slip at once, else friction_memory.hpp
  double memory_velocity = 0;    ///< m/s, >= 0: by which the coefficient comes back at rest
  bool implicit_memory = false;  ///< a step of the memory by Euler's backward rule, as other programs have it

  RAILSTRATA_POINTWISE bool remembers() const { return falls() && memory_distance > 0; }
  RAILSTRATA_POINTWISE bool falls() const { return form != FrictionForm::coulomb && kinetic_share < 1; }
};

/// f(v)/f_stat and its derivative.
struct FrictionShare {
  double value = 1;
  double by_slip_velocity = 0;  ///< s/m, <= 0
};

/// slip_velocity: m/s, >= 0.
RAILSTRATA_POINTWISE FrictionShare friction_share(const FallingFriction& law, double slip_velocity) {
  if (!law.falls()) return {};
  const double fall = 1 - law.kinetic_share, v = slip_velocity / law.half_velocity;
  switch (law.form) {
    case FrictionForm::falling_exponential: {
      const double left = fall * std::exp2(-v);
      return {law.kinetic_share + left, -std::numbers::ln2 * left / law.half_velocity};
    }
    case FrictionForm::falling_rational: {
      const double left = fall / (1 + v);
      return {law.kinetic_share + left, -left / (1 + v) / law.half_velocity};
    }
    case FrictionForm::coulomb:
      break;
  }
  return {};
}

}  // namespace railstrata
