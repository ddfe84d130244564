#pragma once
// How fast a crack grows, by a wheel.
//
//   da/dN = A (ΔK_eq^m - ΔK_th^m),    0 below the threshold
//   shear:  ΔK_eq^2 = ΔK_I² + [(614/507) ΔK_II^3.21]^(2/3.74),  A = 0.000507 nm, m = 3.74; MPa √m. In its own plane
//           under shear, of rail steel; constants as later work quotes them. [Bold1991]
//   paris:  ΔK_eq² = ΔK_I² + ΔK_II²,  A and m of the most that the standard of rails allows in tension: 17 nm at 10 and
//           55 nm at 13.5 MPa √m. [EN13674]
#include "crack/crack_line.hpp"

namespace railstrata {

/// Pa √m; the threshold in the law's ΔK_eq.
double equivalent_range(GrowthLaw law, const StressIntensity& range);
/// m a wheel.
double growth_rate(GrowthLaw law, const StressIntensity& range, double threshold);

/// Factors of a half-elliptical crack that is `aspect` times as long at the surface, from its middle, as it is deep
/// along its plane, on what the straight front of a crack endless in y has.
struct FrontFactors {
  double I = 1;   ///< of K_I at the deepest point: M / (1.1215 sqrt Q), M = 1.13 - 0.09/aspect [NewmanRaju1981]
  double II = 1;  ///< of K_II there: that of an ellipse inside under shear along its minor axis [KassirSih1966]
};
/// aspect from 1 on; infinite: the straight front.
FrontFactors front_factors(double aspect, double poisson);

}  // namespace railstrata
