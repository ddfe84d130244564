#pragma once
// Bounds that a run must keep while it rolls: finite numbers and a wheel that rolls forward after every step, the
// others at the rows of the history. A run that leaves them computes nothing of use any more and ends with a
// NumericalError with what, where and a remedy. They are wide: results are judged by the far narrower checks of
// the summary.
#include <optional>

#include "fem/rolling_sample.hpp"

namespace railstrata {

struct GuardLimits {
  double lost_contact = 0.02;    ///< least F_z over the static load
  double highest_flight = 5e-3;  ///< m that the axle may rise over heights of rail or wheel while there is less
  double energy_drift =
      0.25;  ///< largest |change of the energy balance| over the largest of torque work and strain energy
  double penetration = 1.0;       ///< largest over the Hertzian approach
  double hourglass_share = 0.25;  ///< largest hourglass over strain energy, of bodies that stay elastic
  int rows_between_shapes = 8;    ///< rows of history.csv between two looks at the elements' shapes
};

/// An element of a contact band that is turned inside out.
struct InvertedElement {
  Vec3 centre;          ///< m; x from the axle, y and z in the body's section
  double jacobian = 0;  ///< least of its corners, over that of the undeformed element
};

/// The worst element of a sample whose Jacobian determinant is not positive in some corner, with the nodes where they
/// are. section: y and z of the band's nodes [row * (columns + 1) + column].
std::optional<InvertedElement> inverted_element(const BandSample& sample, const std::vector<Vec2>& section);

// Each throws a NumericalError.
/// If forces, creepage or the axle's motion are not finite, or the axle moves by an element in one step.
void require_sound(const Stepper& stepper);
/// If a displacement is not finite.
void require_finite(const Stepper& stepper);
/// If the wheel no longer rolls forward.
void require_forward(const Stepper& stepper);
/// If a row of the history, or now and then the elements' shapes, leave the limits. largest_energy: of torque work and
/// strain energy so far [J]; row_number: from 0.
void require_within_bounds(const Stepper& stepper, const HistoryRow& row, double largest_energy, std::size_t row_number,
                           const GuardLimits& limits = {});

}  // namespace railstrata
