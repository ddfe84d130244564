#pragma once
// Profiles as the files of other programs: what geometry/exchange_profiles.hpp reads. Lengths in mm with ten digits (a
// micrometre of 100 mm is the fifth), y positive to the field side, z up.
#include <string>
#include <vector>

#include "core/vec.hpp"
#include "geometry/profile.hpp"

namespace railstrata {

/// Simpack .prr (rail) or .prw (wheel): one spline of points of weight 1, nothing shifted, cut, mirrored or smoothed.
/// `remark`: a comment for its header; points in m, in the order along the curve.
std::string simpack_text(ProfileKind kind, const std::vector<Vec2>& points, const std::string& remark);

/// MiniProf .ban (rail) or .whl (wheel): keys, a blank line, X and Y in mm with a tab between.
std::string miniprof_text(ProfileKind kind, const std::vector<Vec2>& points, const std::string& remark);

}  // namespace railstrata
