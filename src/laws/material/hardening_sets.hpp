#pragma once
// Ready sets of cyclic hardening (material/plastic.hpp), each with how sure it is and where it comes from. None of them
// replaces a test of your steel: `railstrata material --calibrate` makes a set from one.
//
// Those of rail and wheel grades are estimates from tensile strength: the cyclic stress–strain curve of steel,
//   σ_a = K' ε_pa^0.187,   K' = 3.1148 MPa (Rm/MPa)^0.897 / min(0.338, 1033 (Rm/MPa)^−1.235)^0.187   [Waechter2016]
// taken up by four backstresses, σ_a = σ_y0 + Σ C_i/γ_i tanh(γ_i ε_pa), γ = 4000, 700, 120, 8, within 0.5 % over
// plastic amplitudes of 1e-4 to 1.5e-2. They are of the stabilised cycle: σ_y0 is the small elastic core of the loop,
// about half the 0.2 % proof stress.
#include <string_view>
#include <vector>

#include "core/certainty.hpp"
#include "material/plastic.hpp"

namespace railstrata {

struct HardeningSet {
  std::string_view name;
  Certainty certainty = Certainty::absent;
  std::string_view source;
  std::string_view use;             ///< "rail", "wheel", "hard layer", "example"
  PlasticParameters<double> law{};  ///< mu = 0: of the case's elasticity
  double tensile = 0;               ///< Pa, of an estimate
  double young = 0;                 ///< Pa, with which the set was fitted
};

/// R220, R260, R350HT, R400HT, B320, ER7, ER8, ER9, then sets that can be traced to a source.
const std::vector<HardeningSet>& hardening_sets();

/// The set of a name, not case-sensitive. Throws CaseError with the nearest name and the list.
const HardeningSet& hardening_set(std::string_view name);

/// Hardening of steel of a tensile strength [Pa], 300 to 2500 MPa. [Waechter2016]
PlasticParameters<double> estimated_hardening(double tensile);

/// K' [Pa] of the curve behind it, and its exponent.
double cyclic_strength_coefficient(double tensile);
inline constexpr double kCyclicExponent = 0.187;

}  // namespace railstrata
