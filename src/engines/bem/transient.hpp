#pragma once
// Rolling contact that is not steady, and contact that is shifted back and forth, by half-spaces: the history of a
// case's [transient] table. [Kalker1990 ch. 4]
//
// Rolling begins at rest (pressed together and shifted by the first forces: Cattaneo's shift; directions whose creepage
// is given are not shifted) or in steady rolling under the first row, and goes on in steps of one cell. Forces and load
// are those at a step's end, creepages and spin those at its middle. A shift goes from row to row in equal increments,
// forces and displacements totals at their ends. Load: vertical; normal and lateral force bear it together, as in
// solve_bem. Friction has no memory of time: a shift may be as fast or slow as one likes.
#include <functional>
#include <limits>

#include "bem/load_history.hpp"
#include "bem/solve_bem.hpp"

namespace railstrata {

/// A state on the way. Step 0: the beginning.
struct TransientState {
  int step = 0, steps = 0;                                 ///< the latter altogether
  double distance = 0;                                     ///< m, rolled
  double time = std::numeric_limits<double>::quiet_NaN();  ///< s; NaN where it is not known
  double displacement_x = 0, displacement_y = 0;           ///< m, of the wheel over the rail: the shift's
  double friction_work = 0;                                ///< J, since the beginning
  LoadedMoment moment;                                     ///< what holds at its end
  BemResult result;
};

/// Called with every state; false: stop after it.
using TransientObserver = std::function<bool(const TransientState&)>;

/// How many steps a case takes on cells of this size [m], the beginning not counted.
int transient_steps(const CaseSpec& spec, const Placement& placement, double cell);

/// The last state. The grid holds the patch under the history's largest load. Throws CaseError as solve_bem, and for
/// forces that friction cannot carry on the way; NumericalError if the patch leaves the grid.
TransientState solve_transient(const CaseSpec& spec, const Placement& placement, const BemOptions& options = {},
                               const TransientObserver& observer = {});

/// Whether a third-body layer that yields can carry what a transient asks for, before the first step. In every row of
/// the history the force must be below the sum of min(f p, tau_c) dA under the frictionless pressure.
/// The force is linear between rows and the sum a concave function of the load, so rows stand for what lies between.
/// Nothing to test where the film hardens, for then friction alone is the limit. Throws CaseError with the row.
void require_film_carries(const CaseSpec& spec, const Placement& placement, const BemOptions& options);

}  // namespace railstrata
