#pragma once
// Rotation in a plane, by its cosine and sine. Number type: float, double or a pack of either (core/simd.hpp); no heap,
// no branches, so that it can stand inside the laws and loops that are compiled for scalars and packs alike.
//
//   forward   x' = c x + s z,   z' = c z - s x      turns z towards x
//   back      x' = c x - s z,   z' = s x + c z      turns x towards z: the inverse and transpose
//
// In the model frame (x rolling direction, z up) `forward` by psi is what a wheel does that rolls forward by psi about
// its axle. In a section plane (y lateral, z up) `back` by an angle turns y towards z: the roll of a profile.
//
// The expressions keep the order written above. A compiler that contracts products and sums (-ffp-contract=fast) then
// gives the same bits wherever a rotation stands.
#include <cmath>
#include <numbers>

#include "core/pointwise.hpp"
#include "core/vec.hpp"

namespace railstrata {

/// Two components in the plane of a rotation; T: number or pack.
template <class T>
struct PlaneVector {
  T x{}, z{};
};

template <class Real>
struct Rotation {
  Real c = Real{} + 1, s{};  ///< cosine and sine of the angle

  template <class T>
  constexpr auto forward(T x, T z) const -> PlaneVector<decltype(c * x)> {
    return {c * x + s * z, c * z - s * x};
  }
  template <class T>
  constexpr auto back(T x, T z) const -> PlaneVector<decltype(c * x)> {
    return {c * x - s * z, s * x + c * z};
  }

  constexpr Rotation inverse() const { return {c, -s}; }
  /// By this angle less the other.
  constexpr Rotation minus(Rotation b) const { return {c * b.c + s * b.s, s * b.c - c * b.s}; }
};

/// By `angle` [rad], positive as in `forward`; Real: float or double.
template <class Real>
Rotation<Real> rotation_by(Real angle) {
  return {std::cos(angle), std::sin(angle)};
}

/// A small rotation in the half-angle form: 1 - cos a = 2 sin^2(a/2) keeps all digits where 1 - cos a would lose them
/// (a step of the time integration turns the wheel by some 1e-5 rad).
template <class Real>
struct SmallRotation {
  Real half{};  ///< sin(a/2)
  Real s{};     ///< sin a

  constexpr Real cosine() const { return 1 - 2 * half * half; }
  constexpr Real cosine_less_one() const { return -2 * half * half; }
  /// |R - 1|^2 = 2 (1 - cos a): squared length of the step of a point at unit distance.
  constexpr Real chord_squared() const { return 4 * half * half; }
  constexpr Rotation<Real> rotation() const { return {cosine(), s}; }
};

/// By `angle` [rad]; Real: float or double.
template <class Real>
SmallRotation<Real> small_rotation_by(Real angle) {
  return {std::sin(Real(0.5) * angle), std::sin(angle)};
}

/// About the lateral axis y of the model frame: z turns towards x.
constexpr Vec3 rotate(const Rotation<double>& r, Vec3 v) { return {r.c * v.x + r.s * v.z, v.y, r.c * v.z - r.s * v.x}; }
/// The inverse: x turns towards z.
constexpr Vec3 rotate_back(const Rotation<double>& r, Vec3 v) {
  return {r.c * v.x - r.s * v.z, v.y, r.s * v.x + r.c * v.z};
}
/// About the vertical axis z of the model frame: x turns towards y (yaw).
constexpr Vec3 yaw(const Rotation<double>& r, Vec3 v) { return {r.c * v.x - r.s * v.y, r.s * v.x + r.c * v.y, v.z}; }
/// The inverse: y turns towards x.
constexpr Vec3 yaw_back(const Rotation<double>& r, Vec3 v) {
  return {r.c * v.x + r.s * v.y, r.c * v.y - r.s * v.x, v.z};
}
/// (R - 1) arm of the same yaw.
constexpr Vec3 yaw_displacement(const Rotation<double>& r, Vec3 arm) {
  return {(r.c - 1) * arm.x - r.s * arm.y, r.s * arm.x + (r.c - 1) * arm.y, 0};
}
/// In a section plane: y turns towards z.
constexpr Vec2 roll(const Rotation<double>& r, Vec2 v) { return {r.c * v.y - r.s * v.z, r.s * v.y + r.c * v.z}; }
/// R s R^T of the same rotation about x.
constexpr Sym3 roll(const Rotation<double>& r, const Sym3& s) {
  return {s.xx,
          r.c * r.c * s.yy - 2 * r.c * r.s * s.yz + r.s * r.s * s.zz,
          r.s * r.s * s.yy + 2 * r.c * r.s * s.yz + r.c * r.c * s.zz,
          r.c * s.xy - r.s * s.xz,
          r.c * r.s * (s.yy - s.zz) + (r.c * r.c - r.s * r.s) * s.yz,
          r.s * s.xy + r.c * s.xz};
}

/// Displacement in the plane of the point at `arm` from the axle, of a rigid body whose axle moved by `shift`:
/// shift + (R - 1) arm.
constexpr PlaneVector<double> rigid_displacement(PlaneVector<double> shift, const Rotation<double>& r,
                                                 PlaneVector<double> arm) {
  return {shift.x + (r.c - 1) * arm.x + r.s * arm.z, shift.z + (r.c - 1) * arm.z - r.s * arm.x};
}

/// By `angle` [rad], positive as in Rotation::forward. On a card by way of half turns, which need no stack for the
/// reduction of large angles; the angle is rounded once more there.
RAILSTRATA_POINTWISE Rotation<double> turn_of(double angle) {
#ifdef __CUDA_ARCH__
  Rotation<double> r;
  sincospi(angle * std::numbers::inv_pi, &r.s, &r.c);
  return r;
#else
  return {std::cos(angle), std::sin(angle)};
#endif
}

}  // namespace railstrata
