#pragma once
// What resists a crack that lies level: inside a layer, or along an interface of unlike metals.
//
// Per wave number k a jump (U, W) has the tractions k M(k) (jump_waves.hpp). Its limit M∞ for large k is that of the
// two metals that meet at the crack, each without end: on its diagonal Cauchy's kernel, Ē/4, Ē = E*/(1 - β²),
// 1/E* = half the sum of (1 - ν²)/E, β Dundurs' second constant. Off its diagonal stands β Ē/4, a traction by the
// local slope of the jump, which lets K turn without end towards the tip. It is kept but for waves shorter than
// a sixteenth of the length (or of four depths, where they are less): nearer to the tip β counts as 0, so that K_I
// and K_II are those of cracks in one metal there, of the complex K at the reference length K_I + i K_II = K L^(iε).
// The energy release rate is (K_I² + K_II²)/Ē [RiceSih1965; HutchinsonSuo1992].
#include <Eigen/Core>

#include "crack/crack_rule.hpp"
#include "halfspace/layered.hpp"

namespace railstrata {

struct LevelCrack {
  double modulus = 0;         ///< Ē, Pa
  Eigen::MatrixXd stiffness;  ///< tractions at the points from jumps there, as of CrackFaces; Pa/m
};
LevelCrack level_crack(const LayeredHalfSpace& body, const CrackLine& line, const CrackRule& rule);

/// Energy release rate of a long crack below a layer that is cut through at the crack's start and bears a tension: all
/// of the strip's energy, whatever it lies on; J/m². [HutchinsonSuo1992]
double strip_release(const HalfSpaceMaterial& layer, double thickness, double tension);

/// L, m.
double reference_length(const CrackLine& line);

/// Points that resolve a crack as long as its depth and longer.
int level_points(const CrackLine& line, int points);

}  // namespace railstrata
