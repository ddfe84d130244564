#pragma once
// Strengths of rail and wheel steels by grade, for users who know no more than the name. Every number states how sure
// it is and where it comes from: nothing here replaces a measurement.
//
// The standards' numbers are quoted as the field knows them: hold them against the edition that your delivery names. A
// standard guarantees tensile strength and hardness of rails, not their yield strength: that of rails is a range of
// what is usual. Moduli hardly differ between grades (205 to 210 GPa, Poisson's ratio 0.3).
#include <string_view>
#include <vector>

#include "core/certainty.hpp"

namespace railstrata {

/// A range; low == high where one number is known. Use `low`: the safe side of a strength.
struct GradeNumber {
  double low = 0, high = 0;
  Certainty certainty = Certainty::absent;
  std::string_view source;
  bool known() const { return certainty != Certainty::absent; }
};

struct Grade {
  std::string_view name;
  std::string_view use;  ///< "rail", "wheel", "crossing"
  GradeNumber yield;     ///< Pa, uniaxial: Rp0.2 of rails, ReH of wheels
  GradeNumber tensile;   ///< Pa, Rm
  GradeNumber hardness;  ///< HBW, of the running surface (rail) or the rim (wheel)
};

/// R220, R260, R350HT, R400HT, B320, ER7, ER8, ER9, Hadfield. [EN13674, EN13262]
const std::vector<Grade>& grades();

/// By name, capitals aside. Throws CaseError with the nearest name and the list.
const Grade& grade(std::string_view name);
/// Null where there is none of this name.
const Grade* find_grade(std::string_view name);

/// Shear yield strength of von Mises' condition, k = Y/sqrt(3).
double shear_yield(double yield);

// Conversions of hardness. All are estimates: ISO 18265 itself calls tensile strength its least reliable conversion.

/// Vickers from Brinell hardness, HV = HBW/0.95: steels of 80 to 620 HV. [ISO18265]
double vickers_from_brinell(double brinell);
/// Tensile strength [Pa], Rm = 3.2 MPa HV: unalloyed and low-alloy steels, 80 to 650 HV, within some 5 % of the table.
/// [ISO18265]
double tensile_from_vickers(double vickers);
double vickers_from_tensile(double tensile);
/// Yield strength [Pa] as a share of the tensile strength, Y = share 3.2 MPa HV, 0 < share <= 1. The share depends on
/// the steel and has no default; the ranges of grades() give 0.53 to 0.57 for R260, 0.65 to 0.70 for R350HT, 0.63 for
/// ER7. Throws std::invalid_argument unless vickers > 0 and the share lies in its range.
double yield_from_vickers(double vickers, double yield_to_tensile);
double vickers_from_yield(double yield, double yield_to_tensile);
/// Flow stress at some 8 % strain [Pa], Y = H/3, with the hardness as a pressure, H = 9.80665 MPa HV; so k = H/(3
/// sqrt(3)). [Tabor1951] An upper bound of the yield strength: near it for martensite, which hardly hardens; for
/// pearlite the 0.2 % proof stress is 0.5 to 0.7 of it.
double flow_stress_from_vickers(double vickers);
double vickers_from_flow_stress(double flow_stress);

}  // namespace railstrata
