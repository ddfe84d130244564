#pragma once
// The contact patch in numbers, from a ContactField of either engine.
#include <algorithm>
#include <cmath>
#include <optional>

#include "contact/contact_field.hpp"

namespace railstrata {

struct PatchMeasures {
  double p_max = 0;  ///< Pa, top of the parabola through the largest value and its neighbours
  double p_max_x = 0;
  double q_max = 0;        ///< Pa, largest magnitude of the tangential traction; of what rolls shear_at_front_of_slip
  double q_max_point = 0;  ///< Pa, the largest of a point
  /// m, in and across the rolling direction; edges where p² extrapolates to zero, as Hertz's pressure does. A line
  /// contact has no width: NaN
  double length = 0, width = 0;
  double area = 0;  ///< m², from the chords of the columns
  /// area of slipping cells / area of cells in contact; of values at points, of the columns' chords (p above
  /// ContactField::p_noise), cut at the front of slip
  double slip_area_fraction = 0;
  double force_x = 0, force_y = 0, force_z = 0;  ///< N on the wheel, sums of area times traction (z: normal)
};

/// m, of length and width; without a width the length.
inline double shorter_axis(const PatchMeasures& patch) {
  return patch.width < patch.length ? patch.width : patch.length;
}
inline double longer_axis(const PatchMeasures& patch) {
  return patch.width > patch.length ? patch.width : patch.length;
}

/// The share of one point in the sums and extremes over all points.
inline void add_point(PatchMeasures& m, const ContactField& f, int i) {
  m.q_max = m.q_max_point = std::max(m.q_max_point, std::hypot(f.q_x[i], f.q_y[i]));
  m.force_x -= f.area[i] * f.q_x[i];
  m.force_y -= f.area[i] * f.q_y[i];
  m.force_z += f.area[i] * f.p[i];
}

PatchMeasures measure_patch(const ContactField& field);

/// Largest |q| [Pa] of bodies that roll: the largest of a point, or of a row's front of slip where that is more.
/// There |q| has a cusp that points miss by up to half their distance: it follows f p in slip behind the front and
/// leaves it like the square root of the distance in stick ahead of it, so that (f p - |q|)² of the last two points
/// that stick is linear and zero at the front; |q| there is f p between the points on either side. f is |q|/p of the
/// point that slips.
double shear_at_front_of_slip(const ContactField& field);

/// Values along the rolling direction through the point of largest pressure.
struct CentreLine {
  std::vector<double> x, p, q_x, q_y, slip_x;
  double y = 0;
};
CentreLine centre_line(const ContactField& field);

/// m, where "below the surface" begins: a tenth of the patch's shorter semi-axis, or half of a thinner surface layer.
/// Nearer to the surface a stress is the surface's, whatever the cell: tension behind the patch dies out within a few
/// hundredths of the patch.
double subsurface_begin(const PatchMeasures& patch, double first_layer);

// ---- where the front of slip is between two points of a row
//
// Next to the front, on its sticking side, the margin f p - |q| is c sqrt(t), t being the distance to the front: its
// square is linear. [Johnson1985 sec. 8.3] Cells have one traction each, the mean over the cell, so that the cell next
// to the front, or with the front in it, has the mean of that root.

/// The margins f p - |q| [Pa] of the sticking points next to the front, nearest first.
struct StickMargins {
  double near = 0, next = 0;
  std::optional<double> after;
};

/// Distance from the nearest sticking point to the front, of points: 0 to 1.
double front_behind_point(const StickMargins& margins);

/// Distance from the middle of the nearest sticking cell to the front, of cells: -0.5 (the cell's far side) to 1 (the
/// middle of the slipping cell). Without the third margin as of points.
double front_behind_cell(const StickMargins& margins);

}  // namespace railstrata
