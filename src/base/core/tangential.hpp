#pragma once
// A pair of components in the plane of the contact. Those of a section, (y, z), are Vec2 (core/vec.hpp); those of the
// plane in which a wheel turns, (x, z), are PlaneVector (core/rotation.hpp).

namespace railstrata {

/// Components in the plane of the contact: x in the rolling direction, y lateral.
struct Tangential {
  double x = 0, y = 0;
};
constexpr Tangential operator+(Tangential a, Tangential b) { return {a.x + b.x, a.y + b.y}; }

}  // namespace railstrata
