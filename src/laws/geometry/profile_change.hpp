#pragma once
// What is gone between two measurements of one profile.
#include <vector>

#include "geometry/profile.hpp"

namespace railstrata {

/// Arc lengths on a profile.
struct ProfileStretch {
  double from = 0, to = 0;  ///< m
};

/// The second measurement moved onto the first by least squares of their distance outside the stretches that wear, then
/// the area between them within these.
///
/// Its uncertainty (one standard deviation) follows from the distances that are left outside: what they leave open of
/// the motion, and as much again of the worn stretch itself, both with 5 mm as the length over which errors of a
/// measured profile are alike.
struct ProfileChange {
  double area = 0, area_error = 0;    ///< m², lost, so positive for wear
  double deepest = 0, deepest_y = 0;  ///< m, depth, and where on the first profile
  double shift_y = 0, shift_z = 0;    ///< m, of the second measurement
  double turn = 0;                    ///< rad, about the first profile's origin
  double left = 0, length = 0;        ///< m: root mean square outside, and the length it was taken over
};

/// `worn`: stretches of the first profile. Throws CaseError where less than kLeastAligned is outside them on both
/// profiles, or the second does not come onto the first.
ProfileChange profile_change(const Profile& before, const Profile& after, const std::vector<ProfileStretch>& worn);
inline constexpr double kLeastAligned = 10e-3;  // m

}  // namespace railstrata
