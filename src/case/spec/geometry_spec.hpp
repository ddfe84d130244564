#pragma once
// Shapes and places of wheel and rail of a case, in SI units.
#include <optional>
#include <string>

#include "geometry/body_shapes.hpp"
#include "geometry/track_presets.hpp"

namespace railstrata {

enum class ContactShape {
  point,  ///< a patch, closed all round
  line    ///< a cylinder along its whole length: plane strain (halfspace/line_contact.hpp)
};

struct GeometrySpec {
  std::string rail_profile = "CN60";  ///< a built-in name or a file
  std::string wheel_profile = "LMA";
  bool rail_mirror = false, wheel_mirror = false;  ///< of a file: y changes its sign, before the offset is added
  double rail_offset = 0, wheel_offset = 0;        ///< m, to the y of a file's points
  RailShape rail_shape = RailShape::rail;
  WheelShape wheel_shape = WheelShape::wheel;
  ContactShape contact = ContactShape::point;
  std::optional<double> line_length;        ///< m, of a line contact: what bears the load
  TrackKind track = TrackKind::by_profile;  ///< whose numbers the next line and cant, wheel_radius have if not given
  double gauge = 1.435, gauge_depth = 0.016, back_to_back = 1.353, flange_back_to_tape = 0.070;
  double cant = 0.025;  ///< tangent (1:40)
  double lateral_shift = 0.0;
  double yaw = 0.0;                    ///< tangent of the angle of attack, positive towards the field side
  double roll = 0.0;                   ///< tangent of the wheelset's roll, positive with the field side up
  std::optional<double> curve_radius;  ///< m, positive with the centre on the field side; none: straight track
  double wheel_radius = 0.430;
  std::optional<double> rail_radius;  ///< m, of the rail along rolling: a roller, a disc; < 0: hollow; none: straight
  double block_width = 0.06, block_height = 0.06;
  WheelSection wheel_section;
  bool in_line() const { return contact == ContactShape::line; }
};

}  // namespace railstrata
