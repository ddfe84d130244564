#pragma once
// The convex program of Melan's theorem for a section: the least R for which residual stresses of given shapes bring
// every sample of every point into a ball of radius R.
#include <array>
#include <vector>

#include "damage/deviator.hpp"

namespace railstrata {

/// A shape's part in the deviator of a point: `value[j]` in component `component[j]` for a unit of unknown `unknown`.
struct ShapeTerm {
  int unknown = 0;
  std::array<int, 2> component{};
  std::array<double, 2> value{};
};

/// min R over q and c_p subject to |u_pi + B_p q + c_p e_2| <= R for every sample i of every point p.
/// u: `path`; B_p: `shapes` (none in component u2, index 1, which is free at every point by c_p).
struct ConePoint {
  std::vector<Vec5> path;
  std::vector<ShapeTerm> shapes;
};

struct ConeSolution {
  double radius = 0;             ///< R that q and c reach
  std::vector<double> unknowns;  ///< q
  std::vector<double> free;      ///< c_p
  std::vector<double>
      work;             ///< per point, sum 1: share of the plastic work of the mechanism that R is about to set off
  double gap = 0;       ///< R - dual objective, relative to R: the error of R
  double residual = 0;  ///< largest entry of B^T z, the dual equations
  int iterations = 0;
};

/// Primal-dual predictor-corrector method on products of second-order cones with the scaling of [NesterovTodd1998].
/// Unknowns of one point must not be further apart than `half_bandwidth`. Stops at gap < accuracy and residual
/// < accuracy / 10; throws NumericalError if that does not come about in 100 iterations (10 to 40 are usual). Parallel
/// over points, the same bits for any number of threads.
ConeSolution solve_cone_program(const std::vector<ConePoint>& points, int unknowns, int half_bandwidth,
                                double accuracy);

}  // namespace railstrata
