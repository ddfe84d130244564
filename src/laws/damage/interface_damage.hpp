#pragma once
// Stresses of an interface between materials while a wheel rolls over it.
#include <span>
#include <vector>

#include "damage/residual_rows.hpp"
#include "damage/stress_history.hpp"

namespace railstrata {

/// Strength of a bond in normal tension N and in shear S, Pa, > 0.
struct BondStrength {
  double normal = 0, shear = 0;
};

/// What an interface sees over the cycle, the largest of all its points. Tractions are those that act across the plane
/// z = const; they are the same on both sides, and the mean of the two rows is taken.
struct Interface {
  int row_above = 0;        ///< the row below is the next
  double depth = 0;         ///< m
  double tension = 0;       ///< t_n = <sigma_zz>, Pa
  double shear = 0;         ///< t_s = sqrt(tau_xz² + tau_yz²), Pa
  double delamination = 0;  ///< (t_n/N)² + (t_s/S)² at one time; 0 without strengths
  double shear_range = 0;   ///< Pa, of tau_xz at a point: drives a crack along the interface (mode II)
  double xx_range[2] = {};  ///< Pa, of sigma_xx above and below at that point
};

/// Every pair of rows of one depth, from the surface down. `bonds` in that order, or empty: no delamination index, as
/// the strength of a bond has no default. (t_n/N)² + (t_s/S)² = 1 begins delamination [BrewerLagace1988]; compression
/// does not count. Throws std::invalid_argument when counts do not fit or a strength is not positive.
std::vector<Interface> interface_damage(const StressHistory& history, ResidualRows residual,
                                        std::span<const BondStrength> bonds = {});

}  // namespace railstrata
