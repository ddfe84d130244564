#pragma once
// The contact patch in numbers, from a ContactField of either engine.
#include "contact/contact_field.hpp"

namespace railstrata {

struct PatchMeasures {
  double p_max = 0;  ///< Pa, top of the parabola through the largest value and its neighbours
  double p_max_x = 0, p_max_y = 0;
  double q_max = 0;              ///< Pa, largest magnitude of the tangential traction
  double length = 0, width = 0;  ///< m, in and across the rolling direction; edges where p² extrapolates to zero, as
                                 ///< Hertz's pressure does
  double area = 0;               ///< m², from the chords of the columns
  double slip_area_fraction =
      0;  ///< area of slipping points / area of points in contact (p above 2.5 % of p_max: ContactField::p_noise)
  double force_x = 0, force_y = 0, force_z = 0;  ///< N on the wheel, sums of area times traction (z: normal)
};

PatchMeasures measure_patch(const ContactField& field);

/// Values along the rolling direction through the point of largest pressure.
struct CentreLine {
  std::vector<double> x, p, q_x, q_y, slip_x;
  double y = 0;
};
CentreLine centre_line(const ContactField& field);

}  // namespace railstrata
