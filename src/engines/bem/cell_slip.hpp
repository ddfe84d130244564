#pragma once
// Where the slip of the tangential problem belongs, and the work that friction does with it.
//
// A step of rolling takes the particle of the cell x from x + dx to x. Its slip s(x) is the mean over that way, half a
// cell ahead of x, while the traction is that at its end. Taken together in one cell both give too little work, by
//   sum of q (A q - S A q)/dx = 1/(2 dx) (q - S q)·A (q - S q) > 0,      S: a cell on, A: the influence, symmetric,
// of first order in dx. With the mean of the particle's tractions at both ends of its step this is zero:
//   sum of 1/2 (q + S q)·s dA = sum of q·w dA,                           w: the rigid slip at x,
// what forces, creepages, moment and spin put in, exactly on every grid. The sum has the step out of the patch, in the
// empty cell behind each row, too. In steps of a history S q is the traction of the state before, and the balance has
// the change of the elastic energy, exactly as well.
//
// The same sum, by cells instead of steps, gives each cell the mean of the steps into and out of it: the slip at x, of
// second order away from the front of slip. Behind the patch surfaces follow another law (the displacement leaves that
// of the patch by a term with s^1.5): there the step out of the last cell is the two before it, continued.
#include "bem/tangential_problem.hpp"

namespace railstrata {

/// Slip over the step that ends in each cell; 0 where it sticks, and where no work is done. One empty cell behind each
/// row has it too.
using StepSlip = PlanePair;

/// Slip at the middle of each cell of the patch, in the unit of the steps. A sticking cell at the front of slip has
/// half of the step that leads out of it. Shift: the steps themselves.
PlanePair slip_of_cells(const PatchGrid& grid, RollingKind kind, const std::vector<ContactState>& state,
                        const StepSlip& steps);

/// Work of friction over the length of a step [N]; shift: over its increment [J]. A shift has no mean: what slips does
/// so at its bound, that of the increment's end. before: traction of the state before at (x + dq, y), transient only;
/// empty: as at the end.
double dissipated(const PatchGrid& grid, RollingKind kind, const Plane& q_x, const Plane& q_y, const PlanePair& before,
                  const StepSlip& steps);

}  // namespace railstrata
