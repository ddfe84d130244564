#pragma once
// Shapes and places of wheel and rail of a case and the track below the rail, in SI units.
#include <optional>
#include <string>

#include "geometry/body_shapes.hpp"
#include "geometry/track_presets.hpp"
#include "track/sleeper_track.hpp"

namespace railstrata {

enum class ContactShape {
  point,  ///< a patch, closed all round
  line    ///< a cylinder along its whole length: plane strain (halfspace/line_contact.hpp)
};

/// The numbers of the track, if they are not given, are those of `track`.
struct GeometrySpec : TrackNumbers {
  std::string rail_profile = "CN60";  ///< a built-in name or a file
  std::string wheel_profile = "LMA";
  bool rail_mirror = false, wheel_mirror = false;  ///< of a file: y changes its sign, before the offset is added
  double rail_offset = 0, wheel_offset = 0;        ///< m, to the y of a file's points
  RailShape rail_shape = RailShape::rail;
  WheelShape wheel_shape = WheelShape::wheel;
  ContactShape contact = ContactShape::point;
  std::optional<double> line_length;  ///< m, of a line contact: what bears the load
  TrackKind track = TrackKind::by_profile;
  double lateral_shift = 0.0;
  double yaw = 0.0;                    ///< tangent of the angle of attack, positive towards the field side
  double roll = 0.0;                   ///< tangent of the wheelset's roll, positive with the field side up
  std::optional<double> curve_radius;  ///< m, positive with the centre on the field side; none: straight track
  std::optional<double> rail_radius;   ///< m, of the rail along rolling: a roller, a disc; < 0: hollow; none: straight
  double block_width = 0.06, block_height = 0.06;
  WheelSection wheel_section;
  bool in_line() const { return contact == ContactShape::line; }
};

struct TrackSpec {
  TrackSet preset = TrackSet::held;
  SleeperTrack support;  ///< where the preset is not `held`
  bool held() const { return preset == TrackSet::held; }
};

}  // namespace railstrata
