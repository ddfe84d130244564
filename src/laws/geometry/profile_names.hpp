#pragma once
// Profiles by name: those shipped inside the program, planes and arcs.
#include <string>
#include <vector>

#include "geometry/profile.hpp"

namespace railstrata {

/// Whether a name is that of a plane or an arc: "flat", "flat:W=10 mm", "arc:R=300 mm".
bool names_primitive(const std::string& name);
/// Names accepted by builtin_profile: LMA, S1002 (wheel); CN60, UIC60, UIC54 (rail); "flat" (both).
std::vector<std::string> builtin_profile_names(ProfileKind kind);
/// The built-in name that is meant by one that is not there: another name of the same profile (60E1 of EN 13674-1 for
/// UIC60), else the nearest; empty if none is near.
std::string likely_profile(ProfileKind kind, const std::string& name);
/// A profile shipped inside the program. Besides the names above it understands "arc:R=300 mm" (also m; positive
/// convex, negative hollow) and widths, "flat:W=10 mm", "arc:R=300 mm, W=10 mm", see circular_profile. Throws CaseError
/// with the nearest name.
Profile builtin_profile(ProfileKind kind, const std::string& name);

/// An arc of the given radius [m] (convex positive, hollow negative, infinite: a plane) with y from -half_width to
/// half_width, tangent horizontal at y = 0. For tests and verification cases.
Profile circular_profile(ProfileKind kind, double radius, double half_width = 0.030);

}  // namespace railstrata
