#pragma once
// Simplified theory on the elements: Kalker's FASTSIM (M = 3) and FaStrip (M = 5), steady rolling to +x. The surfaces
// are springs that do not know of each other, u = L q / k, so that a row is one pass from its leading edge back.
// [Kalker1982, SpiryaginPolachCole2013, SichaniEnblomBerg2016]
//
// L of each element, C11, C22, C23 and the slip reduction are CONTACT's, and so are the results.
#include <array>

#include "cntc/problem.hpp"

namespace railstrata::cntc {

/// 2/G = 1/G1 + 1/G2 [Pa] and the mean of nu/G times G. [Kalker1990 eq. 1.44]
struct PairModuli {
  double shear = 0, poisson = 0;
};
PairModuli pair_moduli(const Materials& materials);

/// B = 2 and 3: Hertz's pressure at the middle of the elements, and a paraboloid on the same ellipse, of his load.
NormalSolution assumed_pressure(const Discretisation& on, const PatchGrid& grid, bool parabolic);

struct SimplifiedSolution {
  TangentialSolution tangential;
  double friction = 0;                      ///< of all elements
  std::array<double, 2> flexibility{0, 0};  ///< L / k along x and y, m/Pa
  double reduction = 1;                     ///< k
};

/// contact: creepages, spin, extra slip, friction, velocity. ellipse: Hertz's; without one, of the elements that carry
/// pressure. Throws Refused for an ellipse that the table of creep coefficients does not have.
SimplifiedSolution solve_simplified(const Materials& materials, const Hertz& ellipse, const PatchGrid& grid,
                                    const NormalSolution& normal, const RollingContact& contact);

}  // namespace railstrata::cntc
