#pragma once
// Profile files of other programs as tables of points; units, origin and orientation are then found as for any other
// list (read_profile).
#include <string>
#include <string_view>

#include "geometry/number_table.hpp"
#include "geometry/profile.hpp"

namespace railstrata {

/// Simpack .prr (rail) and .prw (wheel): key = value in sections ("spline.begin" … "spline.end"), points between
/// point.begin and point.end, comments after "!" and "%". The points are worked on in Simpack's order: point.dist.min,
/// shift, bound (where min < max), mirror, inversion, units.len.f (points of a metre: 1000 means millimetres). Weights
/// and approx.smooth are not used. What was done stands in `notes`. Throws CaseError with name:line: no number, no or
/// two lists of points, a profile of the other kind, points to be rotated.
NumberTable parse_simpack(ProfileKind kind, std::string_view text, const std::string& name);

/// MiniProf .ban (rail) and .whl (wheel): a header of Key=Value lines up to a blank line, or free text up to the first
/// line of two numbers; then rows of X, Y and more. Points in quotes are switched off. What was met stands in `notes`.
/// Throws CaseError with name:line: a line that is not two numbers, columns that do not begin with X,Y.
NumberTable parse_miniprof(std::string_view text, const std::string& name);

}  // namespace railstrata
