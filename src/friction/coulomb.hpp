#pragma once
// Coulomb friction as a pointwise law.
#include <cmath>

#include "core/pointwise.hpp"

namespace railstrata {

/// Tangential traction (two components) brought back to the disc of radius f p: the closest-point return of a trial
/// traction. Returns true where it slips. f >= 0 friction coefficient, p >= 0 pressure. [SimoHughes1998]
RAILSTRATA_POINTWISE bool return_to_coulomb_disc(double friction, double p, double& q1, double& q2) {
  const double limit = friction * (p > 0 ? p : 0), size = std::sqrt(q1 * q1 + q2 * q2);
  if (size <= limit) return false;
  const double scale = size > 0 ? limit / size : 0;
  q1 *= scale;
  q2 *= scale;
  return true;
}

}  // namespace railstrata
