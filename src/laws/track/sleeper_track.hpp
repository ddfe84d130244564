#pragma once
// The track below a rail: pads, rigid sleepers and ballast, as numbers.
#include <string_view>
#include <vector>

namespace railstrata {

/// Track per rail seat. Sleepers are at x = (phase + k) spacing, k any whole number; the wheel starts at x = 0.
/// Vertically a pad joins the foot to the sleeper, half a sleeper's mass, and the ballast joins that to the ground.
/// Sideways and along the rail the sleeper is at rest, and the pad has `pad_shear` of its vertical numbers. Without
/// others the numbers are those of `medium`.
struct SleeperTrack {
  double spacing = 0.6;                                     ///< m
  double phase = 0.5;                                       ///< of a spacing; 0: a sleeper at x = 0, 0.5: midspan
  double pad_stiffness = 200e6, pad_damping = 28e3;         ///< N/m, N s/m
  double pad_length = 0.15;                                 ///< m, along the rail; 0: a point
  double pad_shear = 0.1;                                   ///< sideways and along over vertical stiffness and damping
  double sleeper_mass = 140;                                ///< kg
  double ballast_stiffness = 40e6, ballast_damping = 47e3;  ///< N/m, N s/m
  int bays = 12;                                            ///< length of the model over the spacing
  double length() const { return bays * spacing; }          ///< m
};

enum class TrackSet {
  held,    ///< no track: the foot's base is held
  delft,   ///< hard pads
  medium,  ///< UIC60 on B70
  cn60     ///< soft pads
};

/// The numbers of a set by its word; null for `held` and for a word that names none.
const SleeperTrack* named_track(std::string_view name);

/// Positions of the sleepers whose pads lie within [begin, end], m, increasing.
std::vector<double> sleepers_between(const SleeperTrack& track, double begin, double end);

}  // namespace railstrata
