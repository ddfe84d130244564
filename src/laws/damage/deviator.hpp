#pragma once
// The deviator of a stress as five numbers whose squares add up to the second invariant J2, so that "von Mises" is the
// length of a vector and a shakedown condition a ball.
#include <array>
#include <cmath>

#include "core/vec.hpp"

namespace railstrata {

/// u1 = (s_y - s_z)/2, u2 = (2 s_x - s_y - s_z)/(2 sqrt 3), u3 = t_xz, u4 = t_xy, u5 = t_yz (index 0 to 4), in the
/// unit of the stress; J2 = |u|^2, von Mises stress = sqrt 3 |u|, yield in shear at |u| = k.
using Vec5 = std::array<double, 5>;

inline Vec5 deviator(const Sym3& s) {
  return {0.5 * (s.yy - s.zz), (2 * s.xx - s.yy - s.zz) * 0.28867513459481288225, s.xz, s.xy, s.yz};
}
inline double norm_squared(const Vec5& u) {
  return u[0] * u[0] + u[1] * u[1] + u[2] * u[2] + u[3] * u[3] + u[4] * u[4];
}
inline double dot(const Vec5& a, const Vec5& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4];
}
inline Vec5 operator+(const Vec5& a, const Vec5& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3], a[4] + b[4]};
}
/// The von Mises stress without the factor sqrt 3, to compare with the shear strength k.
inline double equivalent_shear(const Sym3& s) { return std::sqrt(norm_squared(deviator(s))); }

}  // namespace railstrata
