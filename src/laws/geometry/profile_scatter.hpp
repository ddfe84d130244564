#pragma once
// What the points of a profile leave open of its curve, as other curves that they could as well be of.
#include "geometry/profile.hpp"

namespace railstrata {

/// Fits of a list: of points that are moved, then by another smoothing.
inline constexpr int kMovedFits = 6, kOtherFits = kMovedFits + 2;

bool far_apart(const Profile& profile);

/// Whether the points leave more open than a calculation shows: they scatter by more than knots 4 mm apart smooth away,
/// or lie farther apart than kFarApart. Never of an exact curve.
bool leaves_open(const Profile& profile);

/// Fit number k of kOtherFits. The first kMovedFits are of points on the curve that are moved and rounded by as much as
/// those of the list are, with knots elsewhere; then one that takes the list's scatter for twice as large, and one
/// without every other point. Of points far apart all are of lists without every other point. The same for the same k
/// on every machine.
Profile other_fit(const Profile& profile, int k);

}  // namespace railstrata
