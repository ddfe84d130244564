#pragma once
// J2 plasticity with Voce isotropic hardening and backstresses of Armstrong and Frederick or of Ohno and Wang, as
// pointwise functions. [Chaboche1989; OhnoWang1993; SimoHughes1998]
//
//   S = lambda tr(E) I + 2 mu (E − E^p),   s = dev S
//   f = √(3/2) |s − Σ α_i| − (σ_y0 + R(p)) <= 0,   R = Q (1 − e^{−b p})
//   dE^p = (3/2) (s − Σ α_i)/(σ_y0 + R) dp,        dα_i = (2/3) C_i dE^p − γ_i φ_i α_i dp
// Armstrong and Frederick: φ_i = 1. Ohno and Wang: φ_i = (|α_i| γ_i/C_i)^m <dE^p/dp : α_i/|α_i|>, |α|² = (3/2) α:α: a
// backstress recalls only near its saturation C_i/γ_i, and only what flow along it adds. Under a load that repeats, the
// first adds the same strain with every cycle for ever, the second a strain that falls with m.
// E: Green–Lagrange strain, S: second Piola–Kirchhoff stress, both in the frame of the undeformed body: nothing
// rotates, the law is objective. γ_i = 0: linear (Prager) kinematic hardening; no term: isotropic; Q = 0 besides:
// perfect plasticity. The additive split holds for small strains: the error against logarithmic strain is of the order
// of |E|, below 0.5 % at 0.005 and some 3 % at 0.05. The law is rate-independent; its uniaxial stress saturates at
// σ_y0 + Q + Σ C_i/γ_i.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/simd.hpp"

namespace railstrata {

inline constexpr int kMostBackstresses = 4;
inline constexpr int kFewSteps = 2;  ///< of advance_plastic, at most, that are taken whatever is left

/// Parameters of one material; Real: float or double, whatever pack runs over the points.
template <class Real>
struct PlasticParameters {
  Real mu;                          ///< Pa
  Real yield;                       ///< σ_y0 [Pa], > 0; infinite: elastic
  Real saturation, rate;            ///< Q [Pa], σ_y0 + Q > 0, 3 mu + Q b > 0; b >= 0
  Real modulus[kMostBackstresses];  ///< C_i [Pa], >= 0; 0: no term
  Real recall[kMostBackstresses];   ///< γ_i, >= 0
  int power = 0;                    ///< m of Ohno and Wang's recall; 0: that of Armstrong and Frederick

  template <class Other>
  PlasticParameters<Other> rounded_to() const {
    PlasticParameters<Other> other{static_cast<Other>(mu),
                                   static_cast<Other>(yield),
                                   static_cast<Other>(saturation),
                                   static_cast<Other>(rate),
                                   {},
                                   {}};
    for (int k = 0; k < kMostBackstresses; ++k) {
      other.modulus[k] = static_cast<Other>(modulus[k]);
      other.recall[k] = static_cast<Other>(recall[k]);
    }
    other.power = power;
    return other;
  }
};

/// The same material, harder or softer: σ_y0, Q and all C_i grow with the factor, γ_i and b stay, so that the curve of
/// stress against plastic strain is the curve of p times the factor. A head graded with depth takes the factor
/// HV(z)/HV_ref. [AthukoralaDePellegrinKourousis2017]
template <class Real>
PlasticParameters<Real> scaled(PlasticParameters<Real> p, Real factor) {
  p.yield *= factor;
  p.saturation *= factor;
  for (Real& modulus : p.modulus) modulus *= factor;
  return p;
}

/// Numbers of history at a point: plastic strain E^p xx, yy, zz, xy, yz, xz (tensor shears), accumulated plastic strain
/// p, then α_1 [Pa] .. each six. All zero: virgin.
template <int terms>
inline constexpr int kPlasticHistory = 7 + 6 * terms;

/// a:b of symmetric tensors, components xx, yy, zz, xy, yz, xz.
template <class T>
RAILSTRATA_POINTWISE T double_contraction(const T* a, const T* b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

/// 1 − e^{−x}, x >= 0, to some 10 roundings of the result however small x is: the series at y = x/1024, then ten times
/// 1 − e^{−2y} = u (2 − u), u = 1 − e^{−y}, which enlarges no relative error. Above 40 the result is 1 to double.
template <class T>
RAILSTRATA_POINTWISE T saturated_share(const T& x) {
  using Real = ScalarOf<T>;
  const T most = T{} + Real(40);
  const T y = (x < most ? x : most) * (Real(1) / 1024);
  T series = T{} + Real(1);
  RAILSTRATA_UNROLL
  for (int n = 9; n > 1; --n) series = 1 - y * (Real(1) / static_cast<Real>(n)) * series;
  T u = y * series;
  RAILSTRATA_UNROLL
  for (int doubling = 0; doubling < 10; ++doubling) u = u * (2 - u);
  return u;
}

/// Is a number, or one lane of a pack, above zero?
template <class T>
RAILSTRATA_POINTWISE bool any_positive(const T& x) {
  if constexpr (std::is_floating_point_v<T>) {
    return x > 0;
  } else {
    bool any = false;
    RAILSTRATA_UNROLL
    for (int l = 0; l < static_cast<int>(sizeof(T) / sizeof(ScalarOf<T>)); ++l) any |= x[l] > 0;
    return any;
  }
}

/// x^n, n >= 0.
template <class T>
RAILSTRATA_POINTWISE T whole_power(T x, int n) {
  T out = T{} + ScalarOf<T>(1);
  for (; n > 0; n /= 2) {
    if (n % 2 == 1) out = out * x;
    x = x * x;
  }
  return out;
}

/// What is left of a backstress at the end of a step: α = θ (α_before + (2/3) C ΔE^p), with its derivatives.
template <class T>
struct RecalledShare {
  T theta;    ///< θ = 1/(1 + γ φ Δp)
  T fall;     ///< −dθ/dΔp
  T tangent;  ///< d(θ Δp)/dΔp
};

/// Armstrong and Frederick.
template <class T, class Real>
RAILSTRATA_POINTWISE RecalledShare<T> recalled_share(const Real& recall, const T& increment) {
  const T theta = 1 / (1 + recall * increment);
  const T square = theta * theta;
  return {theta, recall * square, square};
}

/// Ohno and Wang: y = |α| γ/C at the end of the step satisfies y (1 + γ Δp c y^m) = s, where s is that of
/// α_before + (2/3) C ΔE^p and c the cosine between it and the flow. Newton's method from min(s, 1), which lies above
/// the root of a convex function. `flow`: dE^p/dp.
template <class T, class Real>
RAILSTRATA_POINTWISE RecalledShare<T> recalled_share(const PlasticParameters<Real>& p, int k, const T* alpha,
                                                     const T (&flow)[6], const T& increment) {
  constexpr int kSteps = 6;
  if (!(p.modulus[k] > 0)) return {T{} + Real(1), T{}, T{} + Real(1)};
  const Real modulus = Real(2) / 3 * p.modulus[k], power = static_cast<Real>(p.power);
  T grown[6];
  RAILSTRATA_UNROLL
  for (int j = 0; j < 6; ++j) grown[j] = alpha[j] + modulus * increment * flow[j];
  const T size = square_root(Real(1.5) * double_contraction(grown, grown)) + std::numeric_limits<Real>::min();
  const T along = double_contraction(flow, grown) / size;
  const T cosine = along > T{} ? along : T{};
  const T full = size * (p.recall[k] / p.modulus[k]);
  const T gain = p.recall[k] * increment * cosine;
  const T one = T{} + Real(1);
  T y = full < one ? full : one;
  for (int step = 0; step < kSteps; ++step) {
    const T part = gain * whole_power(y, p.power);
    y = (full + power * part * y) / (1 + (power + 1) * part);
  }
  const T recall = p.recall[k] * cosine * whole_power(y, p.power);
  const T theta = 1 / (1 + recall * increment);
  const T share = recall / (1 + (power + 1) * recall * increment);
  return {theta, theta * share, theta * (1 - share * increment)};
}

/// Share of an excess of a backstress that flow by Δp takes away, at most: γ Δp of Armstrong and Frederick; Ohno and
/// Wang's recall grows with (m + 1) y^m, y the share of the saturation with half of the flow added, and takes no more
/// than the excess.
inline double most_recalled(const PlasticParameters<double>& p, int k, const double* alpha, double increment) {
  const double all = p.recall[k] * increment;
  if (p.power == 0 || !(p.modulus[k] > 0)) return all;
  const double y = std::sqrt(1.5 * double_contraction(alpha, alpha)) * p.recall[k] / p.modulus[k];
  return -std::expm1(-all * (p.power + 1) * std::pow(std::min(1.0, y + 0.5 * all), p.power));
}

/// Whether a trial of Newton's method is farther from the yield condition than rounding of its next steps would show,
/// in any lane: 1e-13 of the yield strength. A lane that stays elastic is not.
template <class T, class Real>
RAILSTRATA_POINTWISE bool unsettled(const T& increment, const T& excess, const Real& yield) {
  const T size = excess > T{} ? excess : -excess;
  return any_positive((increment > T{} ? size : excess) - Real(1e-13) * yield);
}

/// The yield condition at the end of a step, for a plastic increment Δp that is tried:
///   g(Δp) = √(3/2) |z| − σ_y(p + Δp) − (3 mu + Σ θ_i C_i) Δp,   z = s* − Σ θ_i α_i,   θ_i = 1/(1 + γ_i φ_i Δp)
/// s*: the deviatoric stress if nothing flowed. With Q >= 0 g falls with a slope below −3 mu.
template <class T>
struct PlasticTrial {
  T direction[6];  ///< z
  T norm;          ///< √(3/2) |z|, > 0
  T excess;        ///< g
  T slope;         ///< dg/dΔp = −(3/2) z : Σ θ_i' α_i / norm − R' − 3 mu − Σ C_i d(θ_i Δp)/dΔp
};

template <int terms, class T, class Real>
RAILSTRATA_POINTWISE PlasticTrial<T> plastic_trial(const PlasticParameters<Real>& p, const T (&elastic)[6],
                                                   const T* history, const T& increment,
                                                   const RecalledShare<T>* shares) {
  PlasticTrial<T> at;
  T recalled[6];
  RAILSTRATA_UNROLL
  for (int j = 0; j < 6; ++j) {
    at.direction[j] = elastic[j];
    recalled[j] = T{};
  }
  T hardening = T{} + 3 * p.mu, tangent = T{} + 3 * p.mu;
  RAILSTRATA_UNROLL
  for (int k = 0; k < terms; ++k) {
    const T* alpha = history + 7 + 6 * k;
    RAILSTRATA_UNROLL
    for (int j = 0; j < 6; ++j) {
      at.direction[j] -= shares[k].theta * alpha[j];
      recalled[j] += shares[k].fall * alpha[j];
    }
    hardening += shares[k].theta * p.modulus[k];
    tangent += shares[k].tangent * p.modulus[k];
  }
  T yield = T{} + p.yield;
  if (p.saturation != 0) {  // of the material: all lanes go the same way
    const T share = saturated_share(p.rate * (history[6] + increment));
    yield += p.saturation * share;
    tangent += p.saturation * p.rate * (1 - share);
  }
  const T product = double_contraction(at.direction, at.direction);
  at.norm = square_root(Real(1.5) * product) + std::numeric_limits<Real>::min();
  at.excess = at.norm - yield - hardening * increment;
  at.slope = Real(1.5) * double_contraction(at.direction, recalled) / at.norm - tangent;
  return at;
}

/// Backward Euler to the total strain `strain` (Green–Lagrange, components xx, yy, zz, xy, yz, xz, tensor shears); the
/// history advances. The stress afterwards is S = lambda tr(E) I + 2 mu (E − E^p), a state of one strain and history:
/// there is no drift. The error falls with the first power of the step where the direction of flow turns or a
/// backstress recalls; perfect plasticity and linear kinematic hardening along a straight path are exact.
///
/// Newton's method on g (plastic_trial), a fixed number of times: a first one from Δp = 0, then `iterations`. What is
/// left of |g|/σ_y after 1 and 2 iterations: 5e-15 and nothing for steps of strain of 1e-6, 1e-9 and 5e-14 for 1e-4,
/// 1e-3 and 3e-7 for 1e-3 (three backstresses). An explicit step takes 1, a static increment 4, a coarse path 8. With
/// Ohno and Wang's recall the direction of flow in φ_i is that of the iteration before.
///
/// No branches over lanes: a lane that does not flow keeps its history to the last bit, whatever its neighbours do.
/// T: double, float or a pack of one of them; Real: its scalar. Scalars and packs of doubles agree to rounding, to the
/// bit where the compiler contracts no products and sums (-ffp-contract=off).
template <int terms, int iterations, class T, class Real>
RAILSTRATA_POINTWISE void advance_plastic(const PlasticParameters<Real>& p, const T (&strain)[6], T* history) {
  static_assert(terms >= 0 && terms <= kMostBackstresses && iterations >= 0);
  const T mean = (strain[0] + strain[1] + strain[2]) * (Real(1) / 3);
  T elastic[6];
  RAILSTRATA_UNROLL
  for (int j = 0; j < 3; ++j) elastic[j] = 2 * p.mu * (strain[j] - mean - history[j]);
  RAILSTRATA_UNROLL
  for (int j = 3; j < 6; ++j) elastic[j] = 2 * p.mu * (strain[j] - history[j]);
  RecalledShare<T> shares[kMostBackstresses];
  RAILSTRATA_UNROLL
  for (int k = 0; k < terms; ++k)
    shares[k] = {T{} + Real(1), T{} + (p.power == 0 ? p.recall[k] : Real(0)), T{} + Real(1)};
  T increment{};
  PlasticTrial<T> at = plastic_trial<terms>(p, elastic, history, increment, shares);
  if (!any_positive(at.excess)) return;
  T flow[6];
  RAILSTRATA_UNROLL
  for (int step = 0; step <= iterations; ++step) {
    const T next = increment - at.excess / at.slope;
    increment = next > T{} ? next : T{};
    if (p.power == 0) {
      RAILSTRATA_UNROLL
      for (int k = 0; k < terms; ++k) shares[k] = recalled_share(p.recall[k], increment);
    } else {
      RAILSTRATA_UNROLL
      for (int j = 0; j < 6; ++j) flow[j] = Real(1.5) / at.norm * at.direction[j];
      RAILSTRATA_UNROLL
      for (int k = 0; k < terms; ++k) shares[k] = recalled_share(p, k, history + 7 + 6 * k, flow, increment);
    }
    at = plastic_trial<terms>(p, elastic, history, increment, shares);
    if constexpr (iterations > kFewSteps)
      if (p.power == 0 && !unsettled(increment, at.excess, p.yield)) break;
  }
  RAILSTRATA_UNROLL
  for (int j = 0; j < 6; ++j) {
    flow[j] = Real(1.5) * increment / at.norm * at.direction[j];
    history[j] += flow[j];
  }
  history[6] += increment;
  RAILSTRATA_UNROLL
  for (int k = 0; k < terms; ++k) {
    T* alpha = history + 7 + 6 * k;
    const Real modulus = Real(2) / 3 * p.modulus[k];
    RAILSTRATA_UNROLL
    for (int j = 0; j < 6; ++j) alpha[j] = shares[k].theta * (alpha[j] + modulus * flow[j]);
  }
}

/// S = lambda tr(E) I + 2 mu (E − E^p) [Pa].
template <class T, class Real>
RAILSTRATA_POINTWISE void plastic_stress(Real lambda, Real mu, const T (&strain)[6], const T* history, T (&stress)[6]) {
  const T pressure = lambda * (strain[0] + strain[1] + strain[2]);
  RAILSTRATA_UNROLL
  for (int j = 0; j < 3; ++j) stress[j] = pressure + 2 * mu * (strain[j] - history[j]);
  RAILSTRATA_UNROLL
  for (int j = 3; j < 6; ++j) stress[j] = 2 * mu * (strain[j] - history[j]);
}

/// Free energy of the backstresses, Σ 3/(4 C_i) α_i:α_i [J/m³]. Besides it a point stores the elastic energy
/// (1/2) S : (E − E^p).
template <int terms, class T, class Real>
RAILSTRATA_POINTWISE T backstress_energy(const PlasticParameters<Real>& p, const T* history) {
  T energy{};
  RAILSTRATA_UNROLL
  for (int k = 0; k < terms; ++k) {
    const T* alpha = history + 7 + 6 * k;
    if (p.modulus[k] > 0) energy += Real(0.75) / p.modulus[k] * double_contraction(alpha, alpha);
  }
  return energy;
}

/// Dissipation of a step, (S − Σ α_i) : ΔE^p + Σ 3 γ_i φ_i/(2 C_i) α_i:α_i Δp >= 0 [J/m³], with the stress and history
/// at its end and the history at its start; isotropic hardening counts as dissipated. With the free energies it is the
/// work done, S : ΔE, to the second order of the step (backward Euler dissipates (1/2) |Δ|² of each more: > 0).
template <int terms, class T, class Real>
RAILSTRATA_POINTWISE T plastic_dissipation(const PlasticParameters<Real>& p, const T (&stress)[6], const T* before,
                                           const T* after) {
  T flow[6], relative[6];
  RAILSTRATA_UNROLL
  for (int j = 0; j < 6; ++j) {
    flow[j] = after[j] - before[j];
    relative[j] = stress[j];
  }
  const T increment = after[6] - before[6];
  T recalled{};
  RAILSTRATA_UNROLL
  for (int k = 0; k < terms; ++k) {
    const T* alpha = after + 7 + 6 * k;
    RAILSTRATA_UNROLL
    for (int j = 0; j < 6; ++j) relative[j] -= alpha[j];
    if (!(p.modulus[k] > 0)) continue;
    const T square = Real(1.5) * double_contraction(alpha, alpha);
    if (p.power == 0) {
      recalled += square * (p.recall[k] / p.modulus[k]) * increment;
    } else {
      const T size = square_root(square);
      const T along = double_contraction(flow, alpha);
      recalled += (along > T{} ? along : T{}) * size * (p.recall[k] / p.modulus[k]) *
                  whole_power(size * (p.recall[k] / p.modulus[k]), p.power);
    }
  }
  return double_contraction(relative, flow) + recalled;
}

}  // namespace railstrata
