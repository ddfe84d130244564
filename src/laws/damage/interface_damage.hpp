#pragma once
// Stresses of an interface between materials while a wheel rolls over it.
#include <optional>
#include <span>
#include <vector>

#include "damage/residual_rows.hpp"
#include "damage/stress_history.hpp"

namespace railstrata {

/// Strength of a bond in normal tension N and in shear S, Pa, > 0.
struct BondStrength {
  double normal = 0, shear = 0;
};

/// Smallest and largest value over the cycle, Pa.
struct StressRange {
  double low = 0, high = 0;
  double range() const { return high - low; }
};

/// One point of an interface over the cycle. Tractions are those that act across the plane z = const; they are the same
/// on both sides, and the mean of the two rows is taken.
struct InterfacePoint {
  double tension = 0;        ///< t_n = <sigma_zz>, the largest, Pa
  double shear = 0;          ///< t_s = sqrt(tau_xz² + tau_yz²), the largest, Pa
  StressRange shear_x;       ///< tau_xz: its range drives a crack along the interface (mode II)
  double delamination = 0;   ///< the largest of (t_n/N)² + (t_s/S)² at one time; 0 without strengths
  StressRange xx[2], yy[2];  ///< sigma_xx and sigma_yy above and below, residual stress included
  double traction_jump = 0;  ///< Pa, largest difference between tractions of the two rows: error of the solution
};

struct Interface {
  int row_above = 0;                  ///< the row below is the next
  double depth = 0;                   ///< m
  std::vector<InterfacePoint> point;  ///< by column
  /// Columns with the largest tension, shear, range of tau_xz and delamination index.
  int most_tension = 0, most_shear = 0, most_range = 0, most_delamination = 0;
};

/// Every pair of rows of one depth, from the surface down. `bonds` in that order, or empty: no delamination index, as
/// the strength of a bond has no default. (t_n/N)² + (t_s/S)² = 1 begins delamination [BrewerLagace1988]; compression
/// does not count. Throws std::invalid_argument when counts do not fit or a strength is not positive.
std::vector<Interface> interface_damage(const StressHistory& history, ResidualRows residual,
                                        std::span<const BondStrength> bonds = {});

}  // namespace railstrata
