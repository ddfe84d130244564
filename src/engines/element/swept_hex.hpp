#pragma once
// The 8-node hexahedron of a swept mesh: the element class, pointwise. Compiled for scalars and for float and double
// packs alike. Its data are made in element/reference.hpp; body/traversal.cpp calls it.
//
// An element is a quadrilateral (corners k = 0..3, section coordinates y_k, z_k) carried over one station spacing. In
// its own frame (1 along the sweep, 2 lateral, 3 up) the corners stand at (-+ a_k, y_k, b_k) with, for a spacing D,
//   extrude: a_k = sigma,        b_k = z_k,    sigma = D/2,      c = 1
//   revolve: a_k = -z_k sigma,   b_k = z_k c,  sigma = sin(D/2), c = cos(D/2).
// So all elements of a quadrilateral are affine images of one reference shape (sigma = c = 1): gradients are shared,
// two numbers a station scale them.
//
// Total Lagrangian, one-point mean gradients [FlanaganBelytschko1981], with a stiffness for the 12 hourglass modes:
//   F = Q + H,  H_i = sum_a u_a b_ai,   E = (F^T F - I)/2,   S = lambda tr E + 2 mu E,   f_a = V F S b_a + sum_l
//   gamma_la R K_lm R^T q_m,   q_l = sum_a gamma_la u_a.
// Q turns the element's frame into the model frame (F's left index is the model frame's, its right index the element's
// own), R is Q turned by the body's rigid rotation. b is the exact volume mean of the shape gradients and gamma_l = h_l
// - sum_i (h_l . X_i) b_i, so that rigid motion of any size gives no force. The law works in the carried frame, R's:
// displacements come as R^T u, forces are given as R^T f, and F becomes T + R^T H with T = R^T Q, the same for all
// elements.
//
// K (12 x 12) makes the element: with K = Phi^T K_full Phi (Phi: the displacement modes that have no mean gradient) the
// linear element is *identical* to the fully integrated one that K_full comes from, at the cost of one stress point.
// Two kinds:
//   full       Taylor–Wilson incompatible modes, 2x2x2 Gauss points: neither shear nor volumetric locking
//              [TaylorBeresfordWilson1976]
//   one_point  K = kappa (lambda + 2 mu) V (b:b)/8 I, the stiffness hourglass control of explicit codes
//              [FlanaganBelytschko1981]
// By the mirror symmetry of the element K falls apart into a 5x5 (even) and a 7x7 (odd) block: 43 numbers.
#include "core/rotation.hpp"
#include "core/simd.hpp"
#include "core/sweep_kind.hpp"
#include "material/elastic.hpp"

namespace railstrata {

inline constexpr int kHourglassEntries = 15 + 28;  ///< upper triangles of the 5x5 and the 7x7 block, row by row

/// Shared by all elements of one quadrilateral: the reference shape sigma = c = 1.
template <class Real>
struct QuadShape {
  Real gx[4], gy[4], gz[4];  ///< mean gradients of the corners at +a (at -a: gx changes sign)
  Real volume;
  Real even_y, even_z;  ///< h_even . Y, h_even . Z
  Real odd[3];          ///< h_m . A for the patterns eta, zeta, eta zeta
};

/// Signs of the section patterns eta, zeta, eta zeta at the corners.
inline constexpr double kEta[4] = {-1, 1, 1, -1}, kZeta[4] = {-1, -1, 1, 1}, kEtaZeta[4] = {1, -1, 1, -1};

/// Per station (one lane each). A padding lane has all zero.
template <class T>
struct StationScale {
  T inv_sigma, inv_c;  ///< of the gradients
  /// Volume factors, V b = reference volume x factor x reference gradient: c along the sweep, sigma c lateral, sigma
  /// up.
  T sigma_c, sigma, c;
};

namespace detail {

/// y = K x for a symmetric matrix given by its upper triangle.
template <int N, class T, class Entry>
RAILSTRATA_POINTWISE void symmetric_product(const Entry& k, int first, const T (&x)[N], T (&y)[N]) {
  RAILSTRATA_UNROLL
  for (int i = 0; i < N; ++i) y[i] = T{};
  int e = first;
  RAILSTRATA_UNROLL
  for (int i = 0; i < N; ++i) {
    y[i] += k(e++) * x[i];
    RAILSTRATA_UNROLL
    for (int j = i + 1; j < N; ++j, ++e) {
      y[i] += k(e) * x[j];
      y[j] += k(e) * x[i];
    }
  }
}

/// Hourglass amplitudes or their forces in the two blocks of K.
template <class T>
struct EvenOddAmplitudes {
  T even[5], odd[7];
};
template <class T>
RAILSTRATA_POINTWISE EvenOddAmplitudes<T> sorted(const T (&even)[3], const T (&odd)[3][3]) {
  return {{even[1], even[2], odd[0][0], odd[1][0], odd[2][0]},
          {even[0], odd[0][1], odd[0][2], odd[1][1], odd[1][2], odd[2][1], odd[2][2]}};
}
/// The inverse.
template <class T>
RAILSTRATA_POINTWISE void put_back(const EvenOddAmplitudes<T>& q, T (&even)[3], T (&odd)[3][3]) {
  even[0] = q.odd[0];
  even[1] = q.even[0];
  even[2] = q.even[1];
  RAILSTRATA_UNROLL
  for (int m = 0; m < 3; ++m) {
    odd[m][0] = q.even[2 + m];
    odd[m][1] = q.odd[1 + 2 * m];
    odd[m][2] = q.odd[2 + 2 * m];
  }
}

}  // namespace detail

/// Displacement gradient columns and hourglass amplitudes.
template <class T>
struct ElementKinematics {
  T h1[3], h2[3], h3[3];  ///< H columns: derivative along the sweep, lateral, up; components in the carried frame
  T even[3], odd[3][3];   ///< q: pattern eta zeta of the sums; patterns eta, zeta, eta zeta of the differences
};

/// corner(k, i, sum, difference) gives component i of the displacements at +a_k plus and minus that at -a_k. One
/// component at a time, so that few registers are alive.
template <SweepKind kind = SweepKind::revolve, class T, class Real, class Corner>
RAILSTRATA_POINTWISE ElementKinematics<T> element_kinematics(const QuadShape<Real>& r, const StationScale<T>& st,
                                                             Corner&& corner) {
  ElementKinematics<T> k;
  RAILSTRATA_UNROLL
  for (int i = 0; i < 3; ++i) {
    T s[4], d[4];
    RAILSTRATA_UNROLL
    for (int c = 0; c < 4; ++c) corner(c, i, s[c], d[c]);
    k.h1[i] = (r.gx[0] * d[0] + r.gx[1] * d[1] + r.gx[2] * d[2] + r.gx[3] * d[3]) * st.inv_sigma;
    k.h2[i] = r.gy[0] * s[0] + r.gy[1] * s[1] + r.gy[2] * s[2] + r.gy[3] * s[3];
    k.h3[i] = r.gz[0] * s[0] + r.gz[1] * s[1] + r.gz[2] * s[2] + r.gz[3] * s[3];
    T arm_z = T{} + r.even_z;
    if constexpr (kind == SweepKind::revolve) {
      k.h3[i] *= st.inv_c;
      arm_z *= st.c;
    }
    const T d10 = d[1] - d[0], d23 = d[2] - d[3], d10s = d[1] + d[0], d23s = d[2] + d[3];
    const T arm = k.h1[i] * st.sigma;
    k.even[i] = (s[0] - s[1]) + (s[2] - s[3]) - r.even_y * k.h2[i] - arm_z * k.h3[i];
    k.odd[0][i] = (d10 + d23) - r.odd[0] * arm;
    k.odd[1][i] = (d23s - d10s) - r.odd[1] * arm;
    k.odd[2][i] = (d23 - d10) - r.odd[2] * arm;
  }
  return k;
}

/// Second Piola–Kirchhoff stress in the element's frame and the first one's columns in the carried frame (P = F S).
template <class T>
struct ElementStress {
  T s[6];  ///< 11, 22, 33, 12, 23, 13
  T p1[3], p2[3], p3[3];
  T strain[6];
};

/// Exact (geometrically non-linear) response. law(strain, s) gives S; turn: the carried frame -> the element's own, of
/// the body's rigid rotation psi, positive when rolling forward.
template <SweepKind kind = SweepKind::revolve, class T, class Real, class LawOfStrain>
RAILSTRATA_POINTWISE ElementStress<T> finite_stress(const Rotation<Real>& turn, const ElementKinematics<T>& k,
                                                    LawOfStrain&& law) {
  ElementStress<T> out;
  const Real one = 1, half = Real(0.5);
  T f1[3] = {k.h1[0], k.h1[1], k.h1[2]};
  T f2[3] = {k.h2[0], one + k.h2[1], k.h2[2]};
  T f3[3] = {k.h3[0], k.h3[1], k.h3[2]};
  if constexpr (kind == SweepKind::revolve) {
    f1[0] += turn.c;
    f1[2] += turn.s;
    f3[0] -= turn.s;
    f3[2] += turn.c;
  } else {
    f1[0] += one;
    f3[2] += one;
  }
  auto dot3 = [](const T(&a)[3], const T(&b)[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  out.strain[0] = half * (dot3(f1, f1) - one);
  out.strain[1] = half * (dot3(f2, f2) - one);
  out.strain[2] = half * (dot3(f3, f3) - one);
  out.strain[3] = half * dot3(f1, f2);
  out.strain[4] = half * dot3(f2, f3);
  out.strain[5] = half * dot3(f1, f3);
  law(out.strain, out.s);
  const T(&s)[6] = out.s;
  RAILSTRATA_UNROLL
  for (int i = 0; i < 3; ++i) {
    out.p1[i] = f1[i] * s[0] + f2[i] * s[3] + f3[i] * s[5];
    out.p2[i] = f1[i] * s[3] + f2[i] * s[1] + f3[i] * s[4];
    out.p3[i] = f1[i] * s[5] + f2[i] * s[4] + f3[i] * s[2];
  }
  return out;
}

/// Small strains about the undeformed body (T = 1): the tangent of finite_stress at u = 0, used by the static solver.
template <class T, class LawOfStrain>
RAILSTRATA_POINTWISE ElementStress<T> small_stress(const ElementKinematics<T>& k, LawOfStrain&& law) {
  ElementStress<T> out;
  const ScalarOf<T> half = ScalarOf<T>(0.5);
  out.strain[0] = k.h1[0];
  out.strain[1] = k.h2[1];
  out.strain[2] = k.h3[2];
  out.strain[3] = half * (k.h1[1] + k.h2[0]);
  out.strain[4] = half * (k.h2[2] + k.h3[1]);
  out.strain[5] = half * (k.h1[2] + k.h3[0]);
  law(out.strain, out.s);
  const T(&s)[6] = out.s;
  out.p1[0] = s[0];
  out.p1[1] = s[3];
  out.p1[2] = s[5];
  out.p2[0] = s[3];
  out.p2[1] = s[1];
  out.p2[2] = s[4];
  out.p3[0] = s[5];
  out.p3[1] = s[4];
  out.p3[2] = s[2];
  return out;
}

/// Generalised hourglass forces K q in place of q; returns the hourglass energy q.Kq / 2. `entry(e)` gives the e-th
/// number of HourglassStiffness.
template <class T, class Entry>
RAILSTRATA_POINTWISE T hourglass_forces(const Entry& entry, ElementKinematics<T>& k) {
  const detail::EvenOddAmplitudes<T> q = detail::sorted(k.even, k.odd);
  detail::EvenOddAmplitudes<T> kq;
  detail::symmetric_product<5>(entry, 0, q.even, kq.even);
  detail::symmetric_product<7>(entry, 15, q.odd, kq.odd);
  T twice_energy{};
  RAILSTRATA_UNROLL
  for (int i = 0; i < 5; ++i) twice_energy += q.even[i] * kq.even[i];
  RAILSTRATA_UNROLL
  for (int i = 0; i < 7; ++i) twice_energy += q.odd[i] * kq.odd[i];
  detail::put_back(kq, k.even, k.odd);
  return twice_energy * ScalarOf<T>(0.5);
}

/// Nodal internal forces s - d at -a_k and s + d at +a_k: change(k, i, add) calls add(s, d), which adds to their
/// component i. `k` holds generalised hourglass forces.
template <class T, class Real, class Change>
RAILSTRATA_POINTWISE void element_forces(const QuadShape<Real>& r, const StationScale<T>& st,
                                         const ElementStress<T>& stress, const ElementKinematics<T>& k,
                                         Change&& change) {
  const T v1 = r.volume * st.c, v2 = r.volume * st.sigma_c, v3 = r.volume * st.sigma;
  RAILSTRATA_UNROLL
  for (int i = 0; i < 3; ++i) {
    const T t1 = v1 * stress.p1[i] - (r.odd[0] * k.odd[0][i] + r.odd[1] * k.odd[1][i] + r.odd[2] * k.odd[2][i]);
    const T t2 = v2 * stress.p2[i] - r.even_y * k.even[i];
    const T t3 = v3 * stress.p3[i] - r.even_z * k.even[i];
    const T plus = k.odd[0][i] + k.odd[1][i], minus = k.odd[0][i] - k.odd[1][i];
    const T odd[4] = {k.odd[2][i] - plus, minus - k.odd[2][i], plus + k.odd[2][i], -(minus + k.odd[2][i])};
    RAILSTRATA_UNROLL
    for (int c = 0; c < 4; ++c)
      change(c, i, [&](T& s, T& d) {
        s += r.gy[c] * t2;
        s += r.gz[c] * t3;
        s += c % 2 == 0 ? k.even[i] : -k.even[i];
        d += r.gx[c] * t1;
        d += odd[c];
      });
  }
}

/// How an element is evaluated: the stiffness of the undeformed body; at finite rotation and strain.
enum class Evaluation { linear, finite };

/// For elements without eigenstress; those that may yield have one (body/plastic_pass.hpp).
struct NoEigenstress {
  template <class T>
  RAILSTRATA_POINTWISE void operator()(T (&)[6]) const {}
};

/// Shape and material of the elements of one quadrilateral.
template <class Real>
struct HexReference {
  QuadShape<Real> shape;
  MaterialParameters<Real> material;
};

/// The same where the elements of a pack have materials of their own.
template <class Real, class T>
struct PackReference {
  const QuadShape<Real>& shape;
  MaterialParameters<T> material;
};

/// Stress and strain of an element at a displacement.
template <SweepKind kind, class T, class Reference, class Real, class Relieve = NoEigenstress>
RAILSTRATA_POINTWISE ElementStress<T> hex_stress(const Reference& r, const Rotation<Real>& turn,
                                                 const ElementKinematics<T>& kin, Relieve&& relieve = {}) {
  return finite_stress<kind>(turn, kin, [&](const T(&strain)[6], T(&s)[6]) {
    elastic_stress(r.material.lambda, r.material.mu, strain, s);
    relieve(s);
  });
}

/// Internal forces of one element (or of a pack of them); Reference: HexReference or PackReference.
///   corner     as in element_kinematics
///   hourglass  replaces the hourglass amplitudes of the kinematics by generalised forces
///   change     as in element_forces
///   relieve    takes an eigenstress off the mean stress; never of a linear evaluation
template <SweepKind kind, Evaluation how, class T, class Reference, class Real, class Corner, class Hourglass,
          class Change, class Relieve = NoEigenstress>
RAILSTRATA_POINTWISE void hex_forces(const Reference& r, const StationScale<T>& st, const Rotation<Real>& turn,
                                     Corner&& corner, Hourglass&& hourglass, Change&& change, Relieve&& relieve = {}) {
  auto kin = element_kinematics<kind, T>(r.shape, st, corner);
  ElementStress<T> stress;
  if constexpr (how == Evaluation::linear)
    stress = small_stress(
        kin, [&](const T(&strain)[6], T(&s)[6]) { elastic_stress(r.material.lambda, r.material.mu, strain, s); });
  else
    stress = hex_stress<kind, T>(r, turn, kin, relieve);
  hourglass(kin);
  element_forces(r.shape, st, stress, kin, change);
}

}  // namespace railstrata
