#pragma once
// Wheels that touch at several places.
#include <cmath>

#include "bem/solve_bem.hpp"
#include "geometry/placement.hpp"
#include "reader/case_file.hpp"

namespace railstrata {

inline constexpr double kCrown = 0.1, kHalfDistance = 12e-3;  // m

/// A rail with two crowns of R = 100 mm at y = -12 and 12 mm and a hollow between them; the wheel a cone (of the rail's
/// inclination) or a cylinder.
inline Placement two_crowns(double cant, double wheel_slope) {
  constexpr double kOuter = 22e-3;
  const double h = std::sqrt(4 * kCrown * kCrown - kHalfDistance * kHalfDistance) - kCrown,  // of the hollow's centre
      join = 0.5 * (h - kCrown), end = std::sqrt(kCrown * kCrown - 1e-4) - kCrown, half = 0.5 * kHalfDistance;
  const Vec2 along = (1 / std::hypot(1.0, wheel_slope)) * Vec2{1, wheel_slope};
  Placement p{Profile::from_segments(ProfileKind::wheel, "cone", {{-40e-3 * along, 40e-3 * along, {}, 0}}),
              Profile::from_segments(ProfileKind::rail, "two crowns",
                                     {{{-kOuter, end}, {-half, join}, {-kHalfDistance, -kCrown}, kCrown},
                                      {{-half, join}, {half, join}, {0, h}, kCrown},
                                      {{half, join}, {kOuter, end}, {kHalfDistance, -kCrown}, kCrown}}),
              {},
              {},
              {}};
  p.track.gauge_depth = 0.3e-3;
  p.track.cant = cant;
  const double tape = 0.5 * p.track.back_to_back + p.track.flange_back_to_tape,
               axis = 0.5 * p.track.gauge - gauge_face_y(p.rail, p.track);
  p.track.lateral_shift = axis - tape;  // the tape circle over the rail's axis
  p.contact = place_wheel(p.wheel, p.rail, p.track);
  return p;
}

/// Two crowns with contacts of one angle, atan(cant).
inline Placement level_crowns(double cant) {
  TrackGeometry track;
  track.cant = cant;
  const Vec2 tangent = rail_to_model(track, {1, 0});
  return two_crowns(cant, tangent.z / tangent.y);
}

inline CaseSpec driven(double traction) {
  CaseSpec spec;
  spec.drive.friction_coefficient = 0.3;
  spec.drive.traction_coefficient = traction;
  return spec;
}

inline BemOptions coarse() {
  BemOptions options;
  options.cell = 0.5e-3;
  return options;
}

/// S1002 on UIC60, one wheel of 80 kN without friction.
inline CaseSpec european(double shift) {
  const char* text =
      "geometry.wheel_profile = \"S1002\"\ngeometry.rail_profile = \"UIC60\"\nvehicle.wheel_load = \"80 kN\"\n"
      "drive.traction_coefficient = 0.0\ndrive.friction_coefficient = 0.0\n";
  CaseSpec spec = parse_case(text, "european.toml").spec;
  spec.geometry.lateral_shift = shift;
  return spec;
}

}  // namespace railstrata
