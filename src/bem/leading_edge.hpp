#pragma once
// Where the leading edge of the patch cuts a row of cells, told by the gap ahead of it.
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
// g_1, g_2 the deformed gap in the first and second empty cell: it opens with s^1.5 as well [Johnson1985 sec. 5.1], and
// carries the same errors of the cells, so that no edge has to be found. Layers change C, not the law.
#include "bem/normal_problem.hpp"

namespace railstrata {

/// lambda in the first cell of every row of cells under pressure, 0 elsewhere; 0 too where two empty cells ahead of it
/// do not lie on the grid, or their gap does not open. Between 0 and 0.64: 0.55 for an edge at the centre of the first
/// cell; what is more is the staircase's.
Plane leading_weights(const PatchGrid& grid, const NormalSolution& normal);

}  // namespace railstrata
