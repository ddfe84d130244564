#pragma once
// Strengths of steel from its hardness. All are estimates: ISO 18265 itself calls tensile strength its least reliable
// conversion.
#include <stdexcept>

#include "damage/positive.hpp"
#include "record/unit.hpp"

namespace railstrata {

inline constexpr double kTensilePerVickers = 3.2 * kMega, kBrinellPerVickers = 0.95;

/// Vickers from Brinell hardness, HV = HBW/0.95: steels of 80 to 620 HV. [ISO18265]
inline double vickers_from_brinell(double brinell) { return positive(brinell, "hardness") / kBrinellPerVickers; }
/// Tensile strength [Pa], Rm = 3.2 MPa HV: unalloyed and low-alloy steels, 80 to 650 HV, within some 5 % of the table.
/// [ISO18265]
inline double tensile_from_vickers(double vickers) { return positive(vickers, "hardness") * kTensilePerVickers; }
inline double vickers_from_tensile(double tensile) {
  return positive(tensile, "tensile strength") / kTensilePerVickers;
}
/// Yield strength [Pa] as a share of the tensile strength, Y = share 3.2 MPa HV, 0 < share <= 1. The share depends on
/// the steel and has no default; the ranges of material/steels.hpp give 0.53 to 0.57 for R260, 0.65 to 0.70 for R350HT,
/// 0.63 for ER7. Throws std::invalid_argument unless vickers > 0 and the share lies in its range.
inline double yield_from_vickers(double vickers, double yield_to_tensile) {
  if (!(yield_to_tensile > 0 && yield_to_tensile <= 1))
    throw std::invalid_argument("yield over tensile strength must lie in (0, 1]");
  return yield_to_tensile * tensile_from_vickers(vickers);
}

}  // namespace railstrata
