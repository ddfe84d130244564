#pragma once
// Stress intensities of a crack while a wheel rolls over it.
//
// The wheel rolls along +x. The stresses of the body without a crack are those of a passage (damage/stress_history.hpp)
// plus the residual stress; the crack does not end across its plane (plane strain, no mode III), the load passes slowly
// (no inertia), and it passes again and again until the cycle repeats.
#include <vector>

#include "crack/crack_line.hpp"
#include "crack/plane_of_rolling.hpp"
#include "halfspace/layered.hpp"

namespace railstrata {

struct PassageOptions {
  double friction = 0.2;  ///< of the faces
  CrackFluid fluid = CrackFluid::none;
  int points = 24;   ///< of the crack
  int places = 240;  ///< of the wheel
  int most_passes = 6;
  double repeats = 1e-3;  ///< of the ranges, from one passage to the next
};

/// Of the last passage: a value a place of the wheel.
struct CrackPassage {
  std::vector<double> place;                ///< m, of the contact's origin from the crack's start along the rail
  std::vector<StressIntensity> end, start;  ///< start: of a crack inside
  std::vector<double> open, slipping;       ///< shares of the length
  std::vector<double> fluid;                ///< Pa
  double modulus = 0;                       ///< Pa, of CrackFaces
  int passes = 0;
  bool settled = true;  ///< the faces' conditions at all places, and the cycle repeats
};
CrackPassage pass_over(const CrackLine& line, const LayeredHalfSpace& body, const PlaneOfRolling& plane,
                       const PassageOptions& options);

/// Energy release rate [J/m²] and phase angle [rad] atan2(K_II, K_I) at a place of the wheel: of the end, or of the
/// start where it is larger.
struct Release {
  double rate = 0, phase = 0;
};
Release release_at(const CrackPassage& passage, std::size_t place);

/// Largest less smallest over the passage, K_I never below 0.
StressIntensity range_of(const std::vector<StressIntensity>& passage);

/// Range of the opening intensity of a small kink that leaves the tip by an angle (rad, from the crack's direction
/// towards the left of it), and the angle with the largest.
///   k_I = ¼ (3 cos α/2 + cos 3α/2) K_I - ¾ (sin α/2 + sin 3α/2) K_II   [CotterellRice1980]
struct Kink {
  double range = 0, angle = 0;
};
Kink worst_kink(const std::vector<StressIntensity>& passage);

}  // namespace railstrata
