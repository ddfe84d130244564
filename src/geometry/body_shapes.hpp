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

}  // namespace railstrata
