#pragma once
// Life of a material in closed plastic cycles, by Coffin and Manson: De_p/2 = e_f (2N)^c. [Coffin1954] [Manson1965]
//
// A closed cycle flows there and back, so its strain range De_p is half the equivalent plastic strain Dp that it
// accumulates: N = (4 e_f/Dp)^(-1/c)/2. The exponent c of metals lies between -0.5 and -0.7. [Suresh1998]
#include <array>
#include <cmath>

namespace railstrata {

/// Exponents -c of short, middle and long lives. [Suresh1998; Manson1965]
inline constexpr std::array kLowCycleExponents{0.7, 0.6, 0.5};

/// Cycles, of an exponent -c; 0: the first cycle is too much. accumulated: Dp, above 0; ductility: e_f, the amplitude
/// of plastic strain that one reversal bears.
inline double low_cycle_life(double accumulated, double ductility, double exponent) {
  const double share = 4 * ductility / accumulated;
  return share > 1 ? 0.5 * std::pow(share, 1 / exponent) : 0;
}

/// Cycles, between the two exponents.
struct LowCycleLife {
  double fewest = 0, most = 0;
};

inline LowCycleLife low_cycle_life(double accumulated, double ductility) {
  return {low_cycle_life(accumulated, ductility, kLowCycleExponents.front()),
          low_cycle_life(accumulated, ductility, kLowCycleExponents.back())};
}

}  // namespace railstrata
