#pragma once
// Yielding elements of kind `full` (element/swept_hex.hpp): plastic strains Ep at the 2 x 2 Gauss points of their
// section enter as eigenstress, in numbers that are added to those of the elastic element. Pointwise, for scalars and
// packs.
//
// The strain at one of the 2 x 2 x 2 Gauss points g is the Green strain of the mean gradient and what hourglass
// amplitudes q and incompatible modes alpha (Taylor–Wilson) add to it, as small strains in the element's frame:
//   E_g = E + B_g q + G_g alpha,   S_g = lambda tr(E_g) I + 2 mu (E_g - Ep_g),   tr Ep_g = 0
// sum_g w_g B_g = sum_g w_g G_g = 0, so that the stored energy falls apart into that of the mean strain and that of (q,
// alpha), and alpha, which no force acts on, follows (w_g: shares of the volume V)
//   alpha = -A q + alpha_p,   A = K_aa^-1 K_aq,   alpha_p = K_aa^-1 P_a,   P_a = V sum_g w_g G_g^T 2 mu Ep_g
//   S -= 2 mu sum_g w_g Ep_g,   K q -= P_q - A^T P_a,   P_q = V sum_g w_g B_g^T 2 mu Ep_g
// where K is the condensed hourglass stiffness. These 6 + 12 numbers are exact: the element is the incompatible-mode
// hexahedron with plastic strains at its Gauss points [TaylorBeresfordWilson1976, SimoHughes1998 ch. 1], and with Ep =
// 0 it is the elastic one to the last bit.
//
// **Along the sweep Ep is constant in an element**: the two points + and - of a pair have one Ep, which the mean of
// their stresses drives. The element stays variational, and the section keeps its 2 x 2 points, for bending and
// torsion. What an element has of strain that varies along the sweep is no gradient to rely on: its shear is constant,
// and no normal stress varies along its own direction. Where a load travels along the sweep, + and - pass under it one
// like the other; with an Ep of its own each flowed in its own way, by what was wrong with its strain.
//
// All elements of a quadrilateral are affine images of one shape: the gradients at the Gauss points are shared, two
// numbers scale them. By the mirror symmetry along the sweep a gradient at a pair is a part common to both points,
// which alone matters to their mean, and one of opposite sign; A and K_aa^-1 fall apart into an even (6 modes) and an
// odd block (3).
#include "element/swept_hex.hpp"

namespace railstrata {

inline constexpr int kGaussPairs = 4;           ///< points of the section, each a pair + and - along the sweep
inline constexpr int kEigenstressEntries = 18;  ///< 6 of the mean stress, 12 of the hourglass forces

/// Gradients at a pair of Gauss points, reference shape: the part common to both. Rows by amplitude: eta, zeta, eta
/// zeta of the differences.
template <class Real>
struct GaussPair {
  Real weight;                    ///< of both, share of the volume
  Real along[3];                  ///< d/dX_1 of the odd amplitudes
  Real even_y, even_z;            ///< of the even amplitude
  Real bubble_y[2], bubble_z[2];  ///< of the bubbles in eta and zeta
};
template <class Real>
struct GaussShape {
  GaussPair<Real> pair[kGaussPairs];
};

/// Incompatible modes of the elements of one quadrilateral and one spacing. Order of the even ones: components 2, 3 of
/// the bubbles xi, eta, zeta; of the odd ones: component 1.
template <class Real>
struct IncompatibleModes {
  Real follow_even[6][5], follow_odd[3][7];     ///< A; columns as in hourglass_forces
  Real compliance_even[21], compliance_odd[6];  ///< K_aa^-1, upper triangles
};

/// Amplitudes of the bubbles in xi, eta, zeta, by component.
template <class T>
struct BubbleAmplitudes {
  T a[3][3];
};

/// -A q, of the elastic element.
template <class T, class Real>
RAILSTRATA_POINTWISE BubbleAmplitudes<T> following_bubbles(const IncompatibleModes<Real>& m,
                                                           const ElementKinematics<T>& k) {
  const auto q = detail::sorted(k.even, k.odd);
  BubbleAmplitudes<T> out{};
  RAILSTRATA_UNROLL
  for (int n = 0; n < 3; ++n) {
    RAILSTRATA_UNROLL
    for (int j = 0; j < 5; ++j) {
      out.a[n][1] -= m.follow_even[2 * n][j] * q.even[j];
      out.a[n][2] -= m.follow_even[2 * n + 1][j] * q.even[j];
    }
    RAILSTRATA_UNROLL
    for (int j = 0; j < 7; ++j) out.a[n][0] -= m.follow_odd[n][j] * q.odd[j];
  }
  return out;
}

/// Mean strain of a pair of Gauss points; components 11, 22, 33, 12, 23, 13. inv_sigma, inv_c: of the station.
template <class T, class Real, class Scale>
RAILSTRATA_POINTWISE void pair_strain(const GaussPair<Real>& g, const Scale& inv_sigma, const Scale& inv_c,
                                      const T (&mean)[6], const ElementKinematics<T>& k,
                                      const BubbleAmplitudes<T>& bubbles, T (&strain)[6]) {
  T at[3][3];  // [direction][component]
  RAILSTRATA_UNROLL
  for (int i = 0; i < 3; ++i) {
    const T(&a)[3][3] = bubbles.a;
    at[0][i] = (g.along[0] * k.odd[0][i] + g.along[1] * k.odd[1][i] + g.along[2] * k.odd[2][i]) * inv_sigma;
    at[1][i] = g.even_y * k.even[i] + g.bubble_y[0] * a[1][i] + g.bubble_y[1] * a[2][i];
    at[2][i] = (g.even_z * k.even[i] + g.bubble_z[0] * a[1][i] + g.bubble_z[1] * a[2][i]) * inv_c;
  }
  const ScalarOf<T> half = ScalarOf<T>(0.5);
  RAILSTRATA_UNROLL
  for (int n = 0; n < 3; ++n) strain[n] = mean[n] + at[n][n];
  strain[3] = mean[3] + half * (at[0][1] + at[1][0]);
  strain[4] = mean[4] + half * (at[1][2] + at[2][1]);
  strain[5] = mean[5] + half * (at[0][2] + at[2][0]);
}

/// Sums of the Gauss points' plastic strains, before the incompatible modes are eliminated.
template <class T>
struct PlasticSums {
  T mean[6];               ///< sum_g w_g 2 mu Ep_g
  T even[3], odd[3][3];    ///< P_q / V
  BubbleAmplitudes<T> pa;  ///< P_a / V
};

/// Adds a pair of Gauss points. s = 2 mu Ep, components as in pair_strain.
template <class T, class Real, class Scale>
RAILSTRATA_POINTWISE void add_pair(const GaussPair<Real>& g, const Scale& inv_sigma, const Scale& inv_c,
                                   const T (&s)[6], PlasticSums<T>& out) {
  constexpr int kAt[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
  T sum[6];
  RAILSTRATA_UNROLL
  for (int n = 0; n < 6; ++n) {
    sum[n] = g.weight * s[n];
    out.mean[n] += sum[n];
  }
  RAILSTRATA_UNROLL
  for (int i = 0; i < 3; ++i) {
    const T x = sum[kAt[0][i]] * inv_sigma, y = sum[kAt[1][i]], z = sum[kAt[2][i]] * inv_c;
    out.even[i] += g.even_y * y + g.even_z * z;
    RAILSTRATA_UNROLL
    for (int m = 0; m < 3; ++m) out.odd[m][i] += g.along[m] * x;
    RAILSTRATA_UNROLL
    for (int n = 0; n < 2; ++n) out.pa.a[1 + n][i] += g.bubble_y[n] * y + g.bubble_z[n] * z;
  }
}

/// The numbers of the elastic element's correction and alpha_p.
template <class T>
struct Eigenstress {
  T mean[6];                    ///< taken off the mean stress [Pa]
  T even[3], odd[3][3];         ///< taken off the hourglass forces [N]
  BubbleAmplitudes<T> bubbles;  ///< alpha_p [m]
};
template <class T, class Real, class Scale>
RAILSTRATA_POINTWISE Eigenstress<T> condensed(const IncompatibleModes<Real>& m, const Scale& volume,
                                              const PlasticSums<T>& s) {
  Eigenstress<T> out;
  T pe[6], po[3], ae[6], ao[3];
  RAILSTRATA_UNROLL
  for (int n = 0; n < 3; ++n) {
    pe[2 * n] = s.pa.a[n][1] * volume;
    pe[2 * n + 1] = s.pa.a[n][2] * volume;
    po[n] = s.pa.a[n][0] * volume;
  }
  detail::symmetric_product<6>([&](int e) { return m.compliance_even[e]; }, 0, pe, ae);
  detail::symmetric_product<3>([&](int e) { return m.compliance_odd[e]; }, 0, po, ao);
  RAILSTRATA_UNROLL
  for (int n = 0; n < 3; ++n) {
    out.bubbles.a[n][0] = ao[n];
    out.bubbles.a[n][1] = ae[2 * n];
    out.bubbles.a[n][2] = ae[2 * n + 1];
  }
  auto q = detail::sorted(s.even, s.odd);
  RAILSTRATA_UNROLL
  for (int j = 0; j < 5; ++j) {
    q.even[j] *= volume;
    RAILSTRATA_UNROLL
    for (int n = 0; n < 6; ++n) q.even[j] -= m.follow_even[n][j] * pe[n];
  }
  RAILSTRATA_UNROLL
  for (int j = 0; j < 7; ++j) {
    q.odd[j] *= volume;
    RAILSTRATA_UNROLL
    for (int n = 0; n < 3; ++n) q.odd[j] -= m.follow_odd[n][j] * po[n];
  }
  RAILSTRATA_UNROLL
  for (int n = 0; n < 6; ++n) out.mean[n] = s.mean[n];
  detail::put_back(q, out.even, out.odd);
  return out;
}

/// The 18 numbers in the order in which bodies keep them: 6 of the mean stress, even, odd by pattern. visit(n, number).
template <class T, class Visit>
RAILSTRATA_POINTWISE void each_entry(Eigenstress<T>& e, Visit&& visit) {
  RAILSTRATA_UNROLL
  for (int n = 0; n < 6; ++n) visit(n, e.mean[n]);
  RAILSTRATA_UNROLL
  for (int i = 0; i < 3; ++i) {
    visit(6 + i, e.even[i]);
    RAILSTRATA_UNROLL
    for (int m = 0; m < 3; ++m) visit(9 + 3 * m + i, e.odd[m][i]);
  }
}

}  // namespace railstrata
