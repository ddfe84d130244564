#pragma once
// Dang Van's fatigue criterion at every point of a section. [DangVan1993]
//
//   s_DV = max over the cycle of tau_a(t) + c sigma_h(t),    fatigue where s_DV > limit
// sigma_h the hydrostatic stress, residual stress included; tau_a the largest shear (Tresca's) of the deviator less its
// mean over the cycle. That mean is the centre of the smallest ball around the path of the deviator, in the measure
// J2: the residual stress to which a grain shakes down. Constant shear, residual stress included, leaves no tau_a;
// constant hydrostatic stress counts in full.
//
// c and limit are the material's and have no default: from two fatigue limits, alternating torsion t and tension f,
// limit = t and c = 3 (t/f - 1/2).
#include <optional>
#include <span>
#include <vector>

#include "damage/residual_rows.hpp"
#include "damage/stress_history.hpp"

namespace railstrata {

struct DangVanLimit {
  double c = 0;      ///< >= 0; 0.3 to 0.4 for rail and wheel steel
  double limit = 0;  ///< Pa, > 0: the fatigue limit in alternating torsion; infinite: this row does not count
};

struct DangVanStress {
  double stress = 0;       ///< Pa, s_DV
  double amplitude = 0;    ///< Pa, tau_a at that time
  double hydrostatic = 0;  ///< Pa, sigma_h at that time
  int sample = 0;
};
DangVanStress dang_van_stress(std::span<const Sym3> cycle, const Sym3& residual, double c);

struct DangVanSection {
  std::vector<DangVanStress> point;  ///< row by row
  std::optional<int> row;            ///< with the largest utilisation; none: no row counts
  int column = 0;                    ///< of the largest s_DV there
  double utilisation = 0;            ///< s_DV/limit there; > 1: fatigue. Negative where pressure outweighs shear
};
/// Limits by row. In parallel; the bits do not depend on the number of threads. Throws std::invalid_argument when rows
/// and limits do not fit, or a limit is not positive.
DangVanSection dang_van(const StressHistory& history, ResidualRows residual, std::span<const DangVanLimit> limits);

}  // namespace railstrata
