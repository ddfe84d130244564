#pragma once
// Fields inside a body on planes parallel to its surface, and the tractions on the surface that cause them.
#include <array>
#include <vector>

#include "bem/plane_algebra.hpp"
#include "core/vec.hpp"
#include "halfspace/interior.hpp"

namespace railstrata {

/// Pa, in every cell, in the body's own axes.
struct PlaneLoads {
  Plane p, q_x, q_y;
};

/// The state (halfspace/interior.hpp) in every cell of the grid at one depth. Axes: x rolling, y lateral, z into the
/// body.
struct StatePlane {
  double depth = 0;
  Plane e_xx, e_yy, e_xy, s_xz, s_yz, s_zz;
  InteriorState at(std::size_t k) const { return {e_xx[k], e_yy[k], e_xy[k], s_xz[k], s_yz[k], s_zz[k]}; }
};

/// Displacement [m] in every cell of the grid at one depth, u_z into the body. The half-space is at rest far away;
/// below a line contact it is nowhere, and the displacement NaN.
struct DisplacementPlane {
  double depth = 0;
  Plane u_x, u_y, u_z;
};

inline std::array<Plane*, 6> planes_of(StatePlane& s) { return {&s.e_xx, &s.e_yy, &s.e_xy, &s.s_xz, &s.s_yz, &s.s_zz}; }
inline std::array<Plane*, 3> planes_of(DisplacementPlane& u) { return {&u.u_x, &u.u_y, &u.u_z}; }

/// Makes all planes of a field n zeros; pointers to their values.
template <class Planes>
std::vector<double*> cleared(Planes& s, std::size_t n) {
  std::vector<double*> out;
  for (Plane* p : planes_of(s)) {
    p->assign(n, 0.0);
    out.push_back(p->data());
  }
  return out;
}

}  // namespace railstrata
