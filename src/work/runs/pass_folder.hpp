#pragma once
// Passes of wheels over a rail that yields as jobs, by either method. The files are those of passes/pass_files.hpp,
// with report.html at the end.
#include "bem/patch_grid.hpp"
#include "jobs/job.hpp"
#include "reader/case_file.hpp"

namespace railstrata {

struct PassOrder : JobOrder {
  int passes = 20;              ///< since the first one
  double cell = kDefaultCell;   ///< m, of the half-spaces; stationary method
  double roll_length = 0;       ///< m, 0: chosen; finite elements
  double checkpoint_every = 0;  ///< s of wall time, 0: never; finite elements
};

struct PassesEnd {
  int passes = 0;  ///< that the folder now has
  JobEnd end = JobEnd::finished;
};

/// Passes by the stationary method (passes/rail_passes.hpp). An interrupted pass is discarded; resuming starts that
/// pass again. A pass that has not settled, or a check of the contact that does not hold, is a failed check. Progress:
/// "passes". Throws CaseError (transients, no strength, a folder in use or of another case), NumericalError,
/// EnvironmentError, Interrupted where it is stopped before there is a folder.
PassesEnd passes_in_folder(LoadedCase loaded, const PassOrder& order, Control& control);

/// Passes by the finite elements (runs/rolled_passes.hpp); a pass that is stopped leaves a checkpoint. `loaded`: with
/// run.plasticity and run.rolling. Throws as the other, and as solve_fem.
PassesEnd rolled_passes_in_folder(LoadedCase loaded, const PassOrder& order, Control& control);

}  // namespace railstrata
