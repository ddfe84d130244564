#pragma once
// Both wheels of an axle from one shift and yaw: the case's wheel, and the other one on the rail beside it.
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "model/model.hpp"

namespace railstrata {

/// The other wheel has the same profile on the same rail, mirrored: shift, yaw and roll change their signs. Creepages
/// are those of an axle that rolls without a couple, in the curve of geometry.curve_radius R (centre on this wheel's
/// field side), with e half the distance of the tape circles and r_m the mean of the rolling radii:
///   xi = 1 -+ e/R - r/r_m (- this wheel),   eta of the yaw,   spin = -sin(delta)/r +- cos(delta)/R.
struct AxleWheel {
  RigidContact contact;
  double creepage_x = 0, creepage_y = 0, spin = 0;  ///< spin in 1/m
};
struct AxleOnTrack {
  AxleWheel here, other;
  double radius_difference = 0,
         wanted_difference = 0;  ///< m, r of the other less here; what rolls the curve, 2 e r_m/R
};
AxleOnTrack axle_of(const CaseSpec& spec, const Placement& placement);

/// Empty where the wheels stand on no track (an arc, a plane, a roller) or the other wheel misses its rail.
std::string axle_text(const CaseSpec& spec, const Placement& placement);
nlohmann::ordered_json axle_json(const CaseSpec& spec, const Placement& placement);

}  // namespace railstrata
