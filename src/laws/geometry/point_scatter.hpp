#pragma once
// What a list of points of a plane curve is worth: how far apart they lie, how they are rounded, how they scatter, and
// which of them lie off the curve of the others.
#include <cstddef>
#include <vector>

#include "core/vec.hpp"

namespace railstrata {

inline constexpr double kFarApart = 2e-3;  ///< m, of neighbours: too far for the curvature of a running surface

struct PointScatter {
  double spacing = 0;   ///< m, median distance between neighbours
  double rounding = 0;  ///< m, last digit of the heights; 0: below a micrometre, or none
  double noise = 0;     ///< m, standard deviation off a smooth curve, at least that of the rounding
  bool dense = false;   ///< closer than half a millimetre in the mean
};

/// The last digit of numbers as they were written, in their unit: the largest power of ten of which all are multiples.
/// 0 where they use fewer than six of the ten digits in that place, as lists of exact numbers do.
double last_digit(const std::vector<double>& numbers);

/// Of at least 5 points, neighbours distinct, m; `rounding` of the heights, m.
///
/// Points closer than half a millimetre in the mean: the noise is the median over all runs of five neighbours of the
/// middle one's distance from the cubic through the other four, scaled so that independent errors give their own
/// deviation. Farther apart the shape between points adds to these distances where curvature changes: the smaller of
/// the lower quartiles over runs of five and seven; farther apart than kFarApart it hides them, and only the rounding
/// counts.
PointScatter scatter_of(const std::vector<Vec2>& points, double rounding = 0);

struct StrayPoint {
  std::size_t index = 0;
  double off = 0;  ///< m, from the curve of its neighbours
};

/// Runs of up to three points that lie more than seven scatters and 2 micrometres off the cubic of the four points on
/// either side, which themselves miss it by no more than two in the mean, and five off that of the two nearest on
/// either side. A bend or a kink is no stray point.
std::vector<StrayPoint> stray_points(const std::vector<Vec2>& points, const PointScatter& scatter);

}  // namespace railstrata
