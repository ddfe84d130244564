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

/// The same for the ellipse (q1/f)² + (q2/(share f))² <= p²: its closest point, so that slip is along its normal.
/// The multiplier m of q1 = trial/(1 + m), q2 = trial/(1 + m/share²) is the root of a convex function that falls;
/// Newton's steps from 0 come to it from below.
RAILSTRATA_POINTWISE bool return_to_coulomb_ellipse(double friction, double share, double p, double& q1, double& q2) {
  const double limit = friction * (p > 0 ? p : 0), inverse = 1 / (share * share), trial1 = q1, trial2 = q2 / share;
  const double size = trial1 * trial1 + trial2 * trial2, bound = limit * limit;
  if (size <= bound) return false;
  double m = 0, below1 = 1, below2 = 1;
  constexpr int kSteps = 50;  // 5 to 10 do, but for pressures that are nearly nothing
  for (int k = 0; k < kSteps && bound > 0; ++k) {
    const double a = trial1 * trial1 / (below1 * below1), b = trial2 * trial2 / (below2 * below2);
    const double step = (a + b) * (std::sqrt((a + b) / bound) - 1) / (a / below1 + b * inverse / below2);
    m += step;
    below1 = 1 + m;
    below2 = 1 + m * inverse;
    if (step <= 1e-15 * m) break;
  }
  q1 = trial1 / below1;
  q2 = share * trial2 / below2;
  const double left = std::sqrt(q1 * q1 + q2 * q2 * inverse), scale = left > 0 ? limit / left : 0;
  q1 *= scale;
  q2 *= scale;
  return true;
}

}  // namespace railstrata
