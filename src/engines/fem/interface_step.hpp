#pragma once
// A step of the interfaces below layers that have come off their base (mesh/swept.hpp, SplitInterface). Outside their
// stretches both nodes of a pair have one acceleration, that of both their forces on both their masses; within them
// they meet node on node, for slides are small:
//
//   g + dt w(n+1/2) >= 0,  P_n >= 0,  one of them zero;   |P_t| <= f P_n, against the slip w_t(n+1/2)
//   w(n+1/2) = w* + dt P/m,  1/m = 1/m_above + 1/m_below
// with w* the relative velocity after an update without P: contact and friction at the end of the step, which any step
// bears [CarpenterTaylorKatona1991].
#include <vector>

#include "body/body.hpp"

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

/// J, dissipated.
struct InterfaceLosses {
  double friction = 0;
  double normal = 0;  ///< by nodes that meet
};

/// Largest of all pairs of nodes, m.
struct InterfaceGap {
  double opening = 0;
  double slip = 0;  ///< relative shift along the interface, of open pairs too
};

class InterfaceStep {
 public:
  explicit InterfaceStep(const Body& rail);

  /// Outside the stretches: shares the forces of each pair by its masses. f: like internal forces, positive against the
  /// motion.
  void join(Field& f) const;
  /// Adds the forces of contact to f. u: of the beginning of the step, v: of the half step before; damping_rate [1/s]:
  /// of the rail's run-up damping, which the update is to add.
  InterfaceLosses press(const Field& u, const Field& v, double dt, double damping_rate, Field& f);
  InterfaceGap gap(const Field& u) const;

 private:
  struct Line {
    std::ptrdiff_t above, below;  // of component x at the first station
    int stride;
    Vec3 normal;
    double friction;
    std::vector<StationRange> open, joined;
  };
  InterfaceLosses press_line(const Line& line, const Field& u, const Field& v, double dt, double damping_rate,
                             Field& f) const;

  const Field& mass_;
  std::vector<Line> lines_;
  std::vector<InterfaceLosses> losses_;  // by line
};

}  // namespace railstrata
