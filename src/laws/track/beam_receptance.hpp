#pragma once
// Receptance of an endless rail on its track as a Timoshenko beam on discrete supports, in closed form by Green's
// functions: the reference of finite elements, and an answer at once.
//
//   S = kappa G A (1 + i eta), B = E I (1 + i eta), e^(i omega t)
//   D(k) = S B k^4 - (S rho I + B rho A) omega^2 k^2 - rho A omega^2 (S - rho I omega^2)
//   g(x) = i sum over the two roots with Im k > 0 of (B k^2 + S - rho I omega^2)/D'(k) e^(i k |x|)
// is the deflection at x under a force of one. A pad of stiffness k_p + i omega c_p acts at the points of a Gauss rule
// over its length (two points have its resultant and its moment), the sleeper below it has the stiffness
// k_b + i omega c_b - m omega^2. The forces F of the pads on the rail follow from
//   (G + C) F = -g(x_pad - x_force),   C: 1/(share k_p) on the diagonal, 1/k_sleeper between points of one sleeper
// and the receptance is g(x - x_force) + sum of g(x - x_pad) F. [GrassieGregory1982] has the model, [Timoshenko1921]
// the beam.
#include <complex>

#include "track/sleeper_track.hpp"

namespace railstrata {

struct RailBeam {
  double bending = 0;         ///< E I, N m²
  double shear = 0;           ///< kappa G A, N
  double mass = 0;            ///< rho A, kg/m
  double rotary = 0;          ///< rho I, kg m
  double loss_factor = 0.01;  ///< eta, of steel and rail
};

/// Displacement over force, m/N, at the place x of the force; phase as e^(i omega t): negative where it lags. Only
/// `supports` sleepers next to the force count; the rail goes on without end.
std::complex<double> beam_receptance(const RailBeam& rail, const SleeperTrack& track, double x, double frequency,
                                     int supports = 121);

/// Hz, of the pinned-pinned mode, where the rail vibrates between supports that stand still: pi/spacing in
/// D(k) = 0 without loss.
double pinned_pinned_frequency(const RailBeam& rail, double spacing);

}  // namespace railstrata
