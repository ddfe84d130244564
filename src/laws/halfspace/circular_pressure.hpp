#pragma once
// Stresses and sinking inside a layered half-space under circles of uniform pressure: the load of pavement design.
#include <span>

#include "core/vec.hpp"
#include "halfspace/layered.hpp"

namespace railstrata {

/// A circle on the surface under a uniform pressure.
struct PressedCircle {
  double x = 0, y = 0, radius = 0;  ///< m
  double pressure = 0;              ///< Pa, pressing
};

struct PointBelow {
  Sym3 stress, strain;  ///< Pa, axes x, y, z into the body; tension positive
  double sinking = 0;   ///< m, into the body
};

/// At a point, z > 0 into the body; on an interface in the layer above it. The waves of layer_waves.hpp of a circle of
/// radius a, summed over wave numbers,
///   s_zz(r, z) = p a ∫ S(k, z) J1(k a) J0(k r) dk,   S(k, 0) = −1,
/// and so for the others: to 2e-5 of the pressure, by some 50 (a + r + z + layers)/z wave numbers with a factor of 30.
/// [ChenEngel1972]
PointBelow below_circles(const LayeredHalfSpace& body, std::span<const PressedCircle> circles, Vec3 at);

}  // namespace railstrata
