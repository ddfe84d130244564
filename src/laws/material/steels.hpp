#pragma once
// Steels by name, a row each: strengths of rail and wheel grades, for users who know no more than the name, and ready
// sets of cyclic hardening (material/plastic.hpp). Every number states how sure it is and where it comes from. None of
// them replaces a test of your steel: `railstrata material --calibrate` makes a set from one.
//
// The standards' numbers are quoted as the field knows them: hold them against the edition that your delivery names. A
// standard guarantees tensile strength and hardness of rails, not their yield strength: that of rails is a range of
// what is usual. Moduli hardly differ between grades (205 to 210 GPa, Poisson's ratio 0.3). [EN13674, EN13262]
//
// The hardening of rail and wheel grades is estimated from the least tensile strength: the cyclic stress–strain curve
// of steel,
//   σ_a = K' ε_pa^0.187,   K' = 3.1148 MPa (Rm/MPa)^0.897 / min(0.338, 1033 (Rm/MPa)^−1.235)^0.187   [Waechter2016]
// taken up by four backstresses, σ_a = σ_y0 + Σ C_i/γ_i tanh(γ_i ε_pa), γ = 4000, 700, 120, 8, within 0.5 % over
// plastic amplitudes of 1e-4 to 1.5e-2. They are of the stabilised cycle: σ_y0 is the small elastic core of the loop,
// about half the 0.2 % proof stress.
#include <string>
#include <string_view>
#include <vector>

#include "core/certainty.hpp"
#include "material/plastic.hpp"

namespace railstrata {

/// A range; low == high where one number is known. Use `low`: the safe side of a strength.
struct SteelNumber {
  double low = 0, high = 0;
  Certainty certainty = Certainty::absent;
  std::string_view source;
  bool known() const { return certainty != Certainty::absent; }
};

struct HardeningSet {
  Certainty certainty = Certainty::absent;
  std::string_view source;
  PlasticParameters<double> law{};  ///< mu = 0: of the case's elasticity
  double young = 0;                 ///< Pa, with which the set was fitted
  bool known() const { return certainty != Certainty::absent; }
};

struct Steel {
  std::string_view name;
  std::string_view use;  ///< "rail", "wheel", "crossing", "hard layer", "example"
  SteelNumber yield;     ///< Pa, uniaxial: Rp0.2 of rails, ReH of wheels
  SteelNumber tensile;   ///< Pa, Rm
  SteelNumber hardness;  ///< HBW, of the running surface (rail) or the rim (wheel)
  HardeningSet hardening;
  SteelNumber wear = {};  ///< rate over that of 900A (R260) on rails, of R8T (ER8) on wheels, the steels of the tests
                          ///< that damage/wear.hpp rests on
  bool pearlite = false;  ///< what wears by its hardness (damage/pearlite_wear.hpp)
};

/// Each has strengths (a grade), hardening, or both.
const std::vector<Steel>& steels();

/// The steel with strengths of a name, capitals aside. Throws CaseError with the nearest name and the list.
const Steel& grade(std::string_view name);
/// Null where there is none of this name.
const Steel* find_grade(std::string_view name);
std::vector<std::string> grade_names();

/// The steel with hardening of a name, likewise.
const Steel& hardening_set(std::string_view name);
std::vector<std::string> hardening_set_names();

/// Hardening of steel of a tensile strength [Pa], 300 to 2500 MPa. [Waechter2016]
PlasticParameters<double> estimated_hardening(double tensile);

/// Dang Van's criterion, max over a cycle of τ_a + weight σ_h against the limit, of steel of a tensile strength [Pa]:
/// endurance 0.45 Rm in alternating tension, 0.577 of that in alternating shear [FKM2012]; the weight makes both meet
/// it.
struct EstimatedEndurance {
  double limit = 0;   ///< Pa, amplitude of alternating shear
  double weight = 0;  ///< of the hydrostatic stress
};
EstimatedEndurance estimated_endurance(double tensile);

/// K' [Pa] of the curve behind it, and its exponent.
double cyclic_strength_coefficient(double tensile);
inline constexpr double kCyclicExponent = 0.187;

}  // namespace railstrata
