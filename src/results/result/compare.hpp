#pragma once
// Two contact solutions on one grid, whichever engines made them.
#include <vector>

#include "contact/contact_field.hpp"

namespace railstrata {

/// Differences a - b where either touches, over the largest value of b; kNotApplicable where b has none.
struct FieldDifference {
  double largest = 0;   ///< of the magnitude, with its place
  double x = 0, y = 0;  ///< m
  double rms = 0;
};

/// Both fields at the points of a regular grid over both patches, by bilinear interpolation; index j + y.size() i. |q|
/// is the magnitude of the traction.
struct FieldComparison {
  std::vector<double> x, y;                ///< m
  std::vector<double> p_a, p_b, q_a, q_b;  ///< Pa
  FieldDifference p, q;
};

/// The grid is the finer field's, in x and in y, continued over both patches (thinned to kMostPoints a side); points
/// stay where they are: x from the axle, y in the model frame. Both fields need x growing with the station and y with
/// the column. Throws std::invalid_argument if not, or if neither has pressure.
inline constexpr int kMostPoints = 400;
FieldComparison compare_fields(const ContactField& a, const ContactField& b);

}  // namespace railstrata
