#pragma once
// The smallest ball that holds given points, with a centre that may move in some directions only: the one minimax that
// Melan's shakedown condition and Dang Van's residual stress both ask for.
#include <array>
#include <span>

#include "damage/deviator.hpp"

namespace railstrata {

/// Directions in which the centre may move, as bits: bit d is coordinate d.
using FreeDirections = unsigned;
inline constexpr FreeDirections kAllFree = 0b11111;
/// free_directions(0, 1): the centre moves in the first two coordinates.
template <class... D>
constexpr FreeDirections free_directions(D... d) {
  return ((1U << d) | ... | 0U);
}

struct EnclosingBall {
  Vec5 centre{};      ///< in fixed coordinates 0
  double radius = 0;  ///< largest distance of a point
  int support_count = 0;
  /// Indices of the points that hold the ball, with weights > 0 that add up to 1. In the free
  /// directions the centre is their weighted mean: the certificate that no smaller ball exists.
  std::array<int, 6> support{};
  std::array<double, 6> weight{};
  /// Index in `support` of the largest weight, the first of equal ones.
  int heaviest() const;
};

/// min over c of max over i of |p_i - c|, c free in `free`, 0 in the other coordinates. A dual active-set method
/// [GoldfarbIdnani1983]: exact but for rounding (1e-12 of the radius, and 1e-15 of the largest coordinate's distance
/// from the first point), finite, some d + 10 passes over the points. Repeated, collinear and single points are
/// nothing special; the answer is a function of the points in their order. No points: radius 0, no support.
EnclosingBall enclosing_ball(std::span<const Vec5> points, FreeDirections free = kAllFree);

}  // namespace railstrata
