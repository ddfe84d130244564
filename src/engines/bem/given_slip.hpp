#pragma once
// The part of the slip that the unknown traction does not change (tangential_problem.hpp).
#include "bem/tangential_problem.hpp"

namespace railstrata {

/// A first cell of a row: its slip counts less lambda times that of the empty cell ahead, over 1 - lambda.
struct LeadingCell {
  std::size_t index;
  double weight;  ///< lambda/(1 - lambda)
};

/// Pairs of planes, x and y one after the other.
struct GivenSlip {
  Plane rigid;         ///< of spin, geometry and pressure; the creepages are added to it
  Plane history;       ///< of the state before
  Plane to_own_place;  ///< -phi dq/3 in each cell: from the spin's mean over the step to the cell itself; empty: no
                       ///< spin, or whole cells
  Plane to_middle_of_step;  ///< phi dq/3 in each row of cells, [j]: to the spin's mean over the step; empty: no spin,
                            ///< or `rigid` has it
  std::vector<LeadingCell> leading;
  Plane first_step;  ///< m, of the first cells (1 - lambda) times the step; empty: the step everywhere
};

/// One step of the rolled distance: dq [m], dx in steady rolling, 1 for a shift.
inline double step_length(const PatchGrid& grid, const TangentialProblem& problem) {
  return problem.kind == RollingKind::transient ? problem.step : problem.kind == RollingKind::shift ? 1.0 : grid.dx;
}

GivenSlip given_slip(const PatchGrid& grid, const TangentialProblem& problem);

}  // namespace railstrata
