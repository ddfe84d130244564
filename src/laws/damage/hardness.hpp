#pragma once
// Strengths of steel from its hardness. All are estimates: ISO 18265 itself calls tensile strength its least reliable
// conversion.

namespace railstrata {

/// Vickers from Brinell hardness, HV = HBW/0.95: steels of 80 to 620 HV. [ISO18265]
double vickers_from_brinell(double brinell);
/// Tensile strength [Pa], Rm = 3.2 MPa HV: unalloyed and low-alloy steels, 80 to 650 HV, within some 5 % of the table.
/// [ISO18265]
double tensile_from_vickers(double vickers);
double vickers_from_tensile(double tensile);
/// Yield strength [Pa] as a share of the tensile strength, Y = share 3.2 MPa HV, 0 < share <= 1. The share depends on
/// the steel and has no default; the ranges of material/steels.hpp give 0.53 to 0.57 for R260, 0.65 to 0.70 for R350HT,
/// 0.63 for ER7. Throws std::invalid_argument unless vickers > 0 and the share lies in its range.
double yield_from_vickers(double vickers, double yield_to_tensile);

}  // namespace railstrata
