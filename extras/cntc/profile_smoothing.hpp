#pragma once
// SMOOTH of a profile: CONTACT's smoothing splines. [eve70a/CONTACT, user guide, profile smoothing]
#include <vector>

#include "core/vec.hpp"

namespace railstrata::cntc {

struct Smoothing {
  double amount = 0;      ///< lambda, mm^3, or the filtered wavelength, mm; 0: none
  bool weighted = false;  ///< ISMOOTH = 1: points weigh as far as they lie apart
  /// Kinks: a turn above `kink`, and none above `beside` within `width`.
  double kink = 0.52359877559829887, beside = 0.10471975511965977, width = 2;  ///< rad, mm
  double zigzag = 2.6179938779914944;                                          ///< rad
};

/// Two points in turn with turns above `zigzag` become one: ends of sections that were joined the wrong way round.
std::vector<Vec2> without_zigzags(const std::vector<Vec2>& points, double zigzag);

/// The points [mm] moved onto the spline of y and z over the arc length that makes sum w (points - f)^2 + lambda
/// integral f''^2 least; curves end at kinks.
std::vector<Vec2> smoothed(const std::vector<Vec2>& points, const Smoothing& how);

}  // namespace railstrata::cntc
