#pragma once
// Passes of wheels over a rail that yields in a result folder, by either method, begun anew or gone on with: what the
// command line and Python share. The files are those of passes/pass_files.hpp, with report.html at the end.
#include <filesystem>
#include <string>

#include "case/case_file.hpp"
#include "runs/folder_run.hpp"
#include "runs/run_control.hpp"
#include "runs/write_report.hpp"

namespace railstrata {

/// What is wanted.
struct PassOrder {
  std::filesystem::path folder;
  int passes = 20;              ///< since the first one
  bool resume = false;          ///< go on with those of the folder
  bool force = false;           ///< the folder may hold older results, which are removed
  bool page = true;             ///< report.html at the end
  double cell = 0.25e-3;        ///< m, of the half-spaces; stationary method
  double roll_length = 0;       ///< m, 0: chosen; finite elements
  double checkpoint_every = 0;  ///< s of wall time, 0: never; finite elements
  RunCommand command;
};

struct PassesEnd {
  int passes = 0;         ///< that the folder now has
  bool stopped = false;   ///< before all that were wanted
  bool converged = true;  ///< stationary: every pass of this call settled, and the checks of its contact hold
};

/// Passes by the stationary method (passes/rail_passes.hpp). A pass that is stopped is given up: its folder goes on with
/// it from its beginning. Progress: "passes". Throws CaseError (transients, no strength, a folder in use or of another
/// case), NumericalError, EnvironmentError, Interrupted where it is stopped before there is a folder.
PassesEnd passes_in_folder(LoadedCase loaded, const PassOrder& order, Control& control);

/// Passes by the finite elements (runs/rolled_passes.hpp); a pass that is stopped leaves a checkpoint. `loaded`: with
/// run.plasticity and run.rolling. Throws as the other, and as solve_fem.
PassesEnd rolled_passes_in_folder(LoadedCase loaded, const PassOrder& order, Control& control);

}  // namespace railstrata
