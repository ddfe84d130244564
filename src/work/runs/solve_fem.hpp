#pragma once
// The finite element solution of a case as values: from a system that is ready for computing to patch, stresses and
// summary. Nothing is written, printed or installed here; files are made by an observer (runs/write_fem_result.hpp).
#include <filesystem>
#include <optional>
#include <vector>

#include "fatigue/shakedown_summary.hpp"
#include "fatigue/streamlines.hpp"
#include "passes/rolled_pass.hpp"
#include "result/band_surface.hpp"
#include "result/summary.hpp"
#include "runs/run_control.hpp"

namespace railstrata {

struct FemOptions {
  RunTimes times;
  Control* control = nullptr;          ///< asked between two steps; progress: "rolling"
  const RailBefore* before = nullptr;  ///< what earlier wheels have left in the rail; none: nothing
  bool residual = true;                ///< with run.plasticity: what the run leaves in the rail
  Ranks ranks = {};                    ///< that solve the case together; positions are for rank 0 alone
};

/// The contact at one wanted position of the wheel.
struct FemPosition {
  MeanContact contact;     ///< patch: pressure, traction, slip; mean of the samples around the position
  BandStress rail, wheel;  ///< stresses of the bodies below the patch; they refer to the system's meshes
  std::vector<StreamlineRow> streamlines;   ///< of what rolls
  std::vector<SectionShakedown> shakedown;  ///< of the bodies whose strength the case gives
  Summary summary;
};

struct FemSolution {
  std::vector<FemPosition> positions;  ///< in their order; of a stopped run those that were finished
  std::vector<HistoryRow> history;
  bool stopped = false;                 ///< before the last position
  bool limit_reached = false;           ///< that was for RunTimes::limit
  std::optional<RunState> state;        ///< of a stopped run: what solve_fem goes on from
  std::optional<RunResidual> residual;  ///< of a run with run.plasticity that was not stopped
};

/// Meshes the case and makes both bodies ready for computing. Relative profile names are looked for in `folder`. Throws
/// as build_model, and EnvironmentError if the run does not fit into the memory at hand.
RollingSystem fem_system(const CaseSpec& spec, const std::filesystem::path& folder);

/// Preload, rolling (if the case rolls), means and stresses at every wanted position. `begun`: the state that an
/// earlier run of the same system has left; the results then have the bits of a run in one go. `observer`: its preload
/// and demand are the control's. summary.run.threads is the number of threads of the calling thread
/// (core/parallel.hpp), commit that of the program.
/// Throws NumericalError and CaseError as run_rolling does, Interrupted when it is stopped during the preload,
/// EnvironmentError when the preload takes longer than the limit.
FemSolution solve_fem(const RollingSystem& system, const RunObserver& observer = {}, const FemOptions& options = {},
                      std::optional<RunState> begun = {});

}  // namespace railstrata
