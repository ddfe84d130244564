#pragma once
// Where the leading edge of the patch cuts a row of cells, found from the gap ahead of it.
//
// A particle sticks from the moment it enters the patch, so that u(x, y) = U(y) - xi x along a row: one constant U a
// row, for the whole of its sticking part. A row of whole cells takes U from the displacement in the cell ahead of its
// first one. There, at the distance s beyond the edge, particles still move freely: u + xi x = U + (2/3) C s^1.5. With
// s between nothing and a cell, differently in each row, neighbouring rows disagree in U by C dx^1.5 and in their
// traction by C dx^0.5, all along the rows: stripes, and forces too large by about a cell over the patch.
//
// The slip in the first empty cell, over its step from the second, has the same law. So the slip of the first cell less
// lambda times that of the empty cell ahead is the slip of the part of the step inside the patch, with
//   lambda = s^1.5/((s + dx)^1.5 - s^1.5) = g_1/(g_2 - g_1)
// g_1, g_2 the deformed gap in the first and second empty cell: it opens with s^1.5 as well and carries the same errors
// of the cells, so that no edge has to be found. Layers change C, not the law.
//
// Layers and dissimilar bodies: pressure displaces the surfaces sideways, near a straight edge by u' = -beta A p along
// its normal, where the gap opens by g' = A K sqrt(s) for p = K sqrt(distance). In stick, traction has to take that
// back, and what does so slips ahead of the edge by -(beta/pi) ∫ g' ln s ds besides the part with s^1.5, which takes up
// the unit of the logarithm. (Of z^1/2 ln z the jump across the cut z < 0 is 2 i t^1/2 ln t, the mean -pi t^1/2.) After
// lambda of the second empty cell's slip,
//   (2/3) (beta/pi) (1 + lambda) g_1 ln(g_2/g_1)
// of it is left to the first cell, along the normal; to first order in beta, Dundurs' constant of what lies within a
// cell of the surface: the ratio of the influences of pressure one cell away.
#include <cstddef>
#include <vector>

#include "bem/normal_problem.hpp"

namespace railstrata {

/// Third-body layer: what shears in it starts in proportion to the distance from the edge, so that the slip ahead of
/// the edge starts with a step there and lambda is the share s/dx of the step itself. film: the film's share of the
/// flexibility at the scale of a cell, between the two laws.
/// lambda in the first cell of every row of cells under pressure, 0 elsewhere; 0 too where two empty cells ahead of it
/// do not lie on the grid, or their gap does not open. Between 0 and 0.64: 0.55 for an edge at the centre of the first
/// cell; what is more is the staircase's.
Plane leading_weights(const PatchGrid& grid, const NormalSolution& normal, double film = 0);
/// `film` of leading_weights() for an operator; more: m/Pa, of the film at the edge beyond the operator's.
double film_share(const InfluenceOperator& influence, double more = 0);

/// The last term above [m]: what the step of each first cell slips ahead of the edge by pressure; weight from
/// leading_weights. The normal is that of the gap's contours. Nothing where beta is beyond 1/2, Dundurs' bound: under
/// an incompressible layer as thin as a cell, which is no half-space at any distance that cells know.
PlanePair leading_slip_by_pressure(const InfluenceOperator& influence, const PatchGrid& grid,
                                   const NormalSolution& normal, const Plane& weight);

/// By how much the lambda of a first cell and its slip by pressure [m] change with the gap of an empty cell ahead of
/// it, 1/m and 1.
struct LeadingByGap {
  std::size_t first = 0, empty = 0;
  double weight = 0, slip_x = 0, slip_y = 0;
};
std::vector<LeadingByGap> leading_by_gap(const InfluenceOperator& influence, const PatchGrid& grid,
                                         const NormalSolution& normal, double film = 0);

}  // namespace railstrata
