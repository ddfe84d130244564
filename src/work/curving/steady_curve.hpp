#pragma once
// Bogies that run through a curve at constant speed.
//
// In plan view, x along the track, y outwards (the curve is a right-hand one of radius R): two wheelsets at x_i = +-a
// with the shift y_i, the yaw psi_i and the rotation V/r0 + omega_i, a frame with y_f and psi_f that carries the car
// body. Cant deficiency is the acceleration outwards b = V^2/R cos(phi) - g sin(phi), sin(phi) = h/(2 e) of the
// superelevation h and the distance 2 e of the tape circles. With the primary springs of two boxes k_y and of the yaw
// k_psi, contacts' forces F and moments M [Wickens2003]
//   F_y - S_i + m_w b = 0,   S_i = k_y (y_i - x_i^2/(2 R) - y_f - x_i psi_f)
//   M_z - T_i = 0,           T_i = k_psi (psi_i - x_i/R - psi_f)
//   M_y + mu Q r0 = 0        mu: traction over load
//   sum S_i + (2 Q/g - 2 m_w) b = 0,   sum (T_i + x_i S_i) = 0
// The contacts bear Q (cos(phi) + V^2/(R g) sin(phi)), Q the axle load, under the roll moment -(Q/g - m_w) b h_g of all
// above, h_g its height over the axle.
#include <array>
#include <string>
#include <vector>

#include "ask/wheelset.hpp"
#include "core/control.hpp"

namespace railstrata {

/// A wheelset of a bogie; left: the outer wheel.
struct WheelsetInCurve {
  WheelsetState state;
  WheelsetForces forces;
  std::array<double, 2> creepage{};  ///< of the wheels at their tape circles, (V - omega r0)/V of the track below each
};

struct BogieInCurve {
  std::string name;
  std::array<WheelsetInCurve, 2> wheelsets;  ///< the leading one first
  double deficiency = 0;                     ///< m/s^2 outwards, in the plane of the track
  double frame_y = 0, frame_yaw = 0;         ///< m, rad
  int iterations = 0;
  std::string fault;  ///< why there is no equilibrium; empty: there is one
};

/// Every bogie of the case's curve, side by side. Throws CaseError where the case has none.
std::vector<BogieInCurve> solve_curve(const LoadedCase& loaded, const Control* control);

/// Throws CaseError where no bogie has an equilibrium.
void require_equilibrium(const std::vector<BogieInCurve>& bogies);

/// The case with the wheels on the rail of the curve as its loads, and their creepages those of wheels. Bogies without
/// an equilibrium are left out. Throws CaseError as require_equilibrium.
LoadedCase with_curve_loads(const LoadedCase& loaded, const std::vector<BogieInCurve>& bogies);

}  // namespace railstrata
