#pragma once
// Where the numbers of a case do not fit the shape of its profiles from files.
#include <string>
#include <vector>

#include "geometry/profile.hpp"
#include "spec/geometry_spec.hpp"

namespace railstrata {

/// Warnings, one sentence each: points too far apart, a rail that is inclined already, a flange back elsewhere. Nothing
/// about built-in profiles.
std::vector<std::string> profile_doubts(const GeometrySpec& geometry, const Profile& wheel, const Profile& rail);

/// "1:40, gauge side down", "upright" (flatter than 1:500).
std::string inclination_text(double slope);

}  // namespace railstrata
