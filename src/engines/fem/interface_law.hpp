#pragma once
// Contact of two nodes on both sides of an interface that has come apart, pointwise. Slides are small: node on node.
//
//   g + dt w(n+1/2) >= 0,  P_n >= 0,  one of them zero;   |P_t| <= f P_n, against the slip w_t(n+1/2)
//   w(n+1/2) = w* + dt P/m,  1/m = 1/m_above + 1/m_below
// with w* the relative velocity after an update without P: contact and friction at the end of the step, which any step
// bears [CarpenterTaylorKatona1991].
#include "core/vec.hpp"

namespace railstrata {

/// Two nodes that stand at one place of the undeformed body. Relative motion: of the one above over the one below.
struct NodePair {
  Vec3 normal;          ///< unit, outward: from below to above
  double mass = 0;      ///< kg, reduced
  double friction = 0;  ///< Coulomb's coefficient
};

/// Forces on the node above, N.
struct PairForce {
  double pressure = 0;  ///< along the normal
  Vec3 shear;
  Vec3 whole(Vec3 normal) const { return pressure * normal + shear; }
};

/// gap: relative displacement [m]; free: relative velocity after the step without contact [m/s].
inline PairForce pair_force(const NodePair& pair, Vec3 gap, Vec3 free, double dt) {
  const double stiffness = pair.mass / dt, approach = dot(free, pair.normal);
  const double pressure = -stiffness * (dot(gap, pair.normal) / dt + approach);
  if (!(pressure > 0)) return {};
  const Vec3 stick = -stiffness * (free - approach * pair.normal);
  const double held = norm(stick), most = pair.friction * pressure;
  return {pressure, held > most ? (most / held) * stick : stick};
}

}  // namespace railstrata
