#pragma once
// Pairs of components in planes other than the section's (y, z), which is core/vec.hpp's Vec2.

namespace railstrata {

/// Components in the plane of the contact: x in the rolling direction, y lateral.
struct Tangential {
  double x = 0, y = 0;
};
constexpr Tangential operator+(Tangential a, Tangential b) { return {a.x + b.x, a.y + b.y}; }

/// Components in the plane in which a wheel turns: x in the rolling direction, z up.
struct WheelPlane {
  double x = 0, z = 0;
};

}  // namespace railstrata
