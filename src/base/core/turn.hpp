#pragma once
// Rotations by an angle, pointwise.
#include <cmath>
#include <numbers>

#include "core/pointwise.hpp"
#include "core/rotation.hpp"

namespace railstrata {

/// By `angle` [rad], positive as in Rotation::forward. On a card by way of half turns, which need no stack for the
/// reduction of large angles; the angle is rounded once more there.
RAILSTRATA_POINTWISE Rotation<double> turn_of(double angle) {
#ifdef __CUDA_ARCH__
  Rotation<double> r;
  sincospi(angle * std::numbers::inv_pi, &r.s, &r.c);
  return r;
#else
  return {std::cos(angle), std::sin(angle)};
#endif
}

}  // namespace railstrata
