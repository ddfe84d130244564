#pragma once
// The points of a worn rail, in the frame of the unworn one, as a profile.
#include <vector>

#include "model/model.hpp"

namespace railstrata {

/// A wheel without a flange stands over the rail's axis, whatever the gauge.
bool has_gauge(const Placement& placement);

/// m, z of the points at y = 0, where a profile's own frame has z = 0.
double crown_height(const std::vector<Vec2>& points);

/// The points in the frame of their own profile, and that profile.
std::vector<Vec2> in_own_frame(std::vector<Vec2> points);
Profile worn_profile(const std::vector<Vec2>& in_own_frame);

/// m, of the track by the worn gauge faces of both rails: a rail stays in its place.
double gauge_widening(const Profile& worn, const Placement& unworn);

}  // namespace railstrata
