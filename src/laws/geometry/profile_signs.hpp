#pragma once
// What the shape of a profile says about the frame that it was measured in.
#include <optional>
#include <vector>

#include "geometry/profile.hpp"

namespace railstrata {

/// Slope of a rail's running surface over the 10 mm about y = 0: 0 upright, positive with the gauge side down, as a
/// rail stands that is inclined to the track's centre. None where the surface is shorter.
std::optional<double> head_inclination(const Profile& rail);

/// Whether a slope is one that rails are laid with: between 1:50 and 1:15, to either side.
bool looks_laid(double slope);

/// m, y of the middle between the faces of a head, 14 mm below its highest point; none where the list ends above.
std::optional<double> head_middle(const Profile& rail);

/// m, distance of a wheel's flange back from its tape circle: where the curve begins, steeper than 1:5; none elsewhere.
std::optional<double> flange_back(const Profile& wheel);

/// A place where the tangent of a listed curve turns at once, as between the facets of a ground rail.
struct ProfileEdge {
  double s = 0;     ///< m
  double turn = 0;  ///< rad, within 0.6 mm
};

/// Edges of more than 5 mrad, and of more than six scatters of the points over 0.6 mm, that turn more than four times
/// what the curve turns in as much of the 2 mm on either side.
std::vector<ProfileEdge> edges_of(const Profile& profile);

}  // namespace railstrata
