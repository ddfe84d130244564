#pragma once
// A cubic spline through listed points of a plane curve, C2 in (very nearly) arc length.
//
// Points listed every 0.1 mm and rounded to 1e-6 mm do not carry a usable second derivative point by point: rounding of
// e changes it by 4 e / h². The spline is therefore fitted by least squares to knots so far apart that this noise stays
// below 1e-4 of a rail's curvatures, and knots are added wherever the fit misses the points by more than the noise
// allows (kinks, small radii).
#include <vector>

#include "core/vec.hpp"

namespace railstrata {

/// On [s_i, s_{i+1}] the curve is the cubic with positions p and second derivatives d2 given at both ends. Where a few
/// points lie very much closer than others, the equations of the fit lose their digits: the curve then misses points by
/// more than they lie apart, which is for the caller to refuse.
struct SmoothingSpline {
  std::vector<double> s;
  std::vector<Vec2> p, d2;
  std::vector<double> miss;  ///< distance of each point from its place on the curve [m]
  double tolerance = 0;      ///< what the points' scatter allows [m]
};

/// Needs at least 5 points, neighbours distinct. Lengths in metres; `rounding`: the last digit of the heights, 0: none.
/// knots_moved: as of Profile::from_points.
SmoothingSpline fit_smoothing_spline(const std::vector<Vec2>& points, double rounding = 0, double knots_moved = 0);

}  // namespace railstrata
