#pragma once
// The body below its running surface: a real section, or a plain solid for verification against closed forms.

namespace railstrata {

enum class RailShape {
  rail,  ///< head, web and foot
  block  ///< a rectangle with the profile on top
};

enum class WheelShape {
  wheel,  ///< rim, web and hub
  disc    ///< the rim goes on down to the bore
};

/// The wheel below its tread, m.
struct WheelSection {
  double rim_thickness = 0.060;                    ///< tape circle to the rim's inner face
  double web_thickness = 0.030, web_offset = 0.0;  ///< lateral position of the plate's middle, tape circle = 0
  double hub_radius = 0.135, hub_width = 0.17, bore_radius = 0.095;
};

}  // namespace railstrata
