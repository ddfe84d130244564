#pragma once
// Life of a material in closed plastic cycles, by Coffin and Manson: De_p/2 = e_f (2N)^c. [Coffin1954] [Manson1965]
//
// A closed cycle flows there and back, so its strain range De_p is half the equivalent plastic strain Dp that it
// accumulates: N = (4 e_f/Dp)^(-1/c)/2. The exponent c of metals lies between -0.5 and -0.7. [Suresh1998]
#include <cmath>

namespace railstrata {

/// Cycles, between the two exponents.
struct LowCycleLife {
  double fewest = 0, most = 0;
};

/// accumulated: Dp, above 0; ductility: e_f, the amplitude of plastic strain that one reversal bears.
inline LowCycleLife low_cycle_life(double accumulated, double ductility) {
  const double share = 4 * ductility / accumulated;
  const auto cycles = [&](double exponent) { return 0.5 * std::pow(share, 1 / exponent); };
  return share > 1 ? LowCycleLife{cycles(0.7), cycles(0.5)} : LowCycleLife{};
}

}  // namespace railstrata
