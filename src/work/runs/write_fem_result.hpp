#pragma once
// The files of a finite element run: those that grow while it is solved, and its results.
#include <filesystem>
#include <memory>
#include <string>

#include "io/checkpoint_file.hpp"
#include "runs/solve_fem.hpp"

namespace railstrata {

/// Writes checkpoint.h5 and reports it. One that cannot be written is a warning; of a run that stops it throws
/// EnvironmentError.
void save_checkpoint(const std::filesystem::path& folder, const CheckpointOrigin& origin, const RunState& state,
                     bool stopping, const Control& control);

/// A checkpoint is there, or the one before it.
bool has_checkpoint(const std::filesystem::path& folder);

class FemWriter {
 public:
  /// Into a folder that is there. `origin.provenance`: "#" lines of the tables. `begun`: the state that the run goes on
  /// from; history.csv and the series of its patch are then written again up to there.
  FemWriter(const RollingSystem& system, std::filesystem::path folder, CheckpointOrigin origin,
            const RunState* begun = nullptr);
  ~FemWriter();

  /// Makes the observer write history.csv, patch.pvd with its frames in patch_series/ (if the case asks for them) and
  /// checkpoint.h5, by save_checkpoint. The writer and the control must outlive the observer.
  void observe(RunObserver& observer, const Control& control);

  /// Writes per position (in the folder itself for the last of a finished run, in position_<mm>/ for the others)
  /// summary.json; patch.csv, centre_line.csv, depth_line.csv and two sections a body; patch.vtp, rail_surface.vtp,
  /// wheel_surface.vtp, geometry.json and view.py; rail.vtu and wheel.vtu if the case asks for them. Removes the
  /// checkpoints of a finished run. Throws EnvironmentError for the disk.
  void write(const FemSolution& solution);

 private:
  struct GrowingFiles;
  const RollingSystem& system_;
  std::filesystem::path folder_;
  CheckpointOrigin origin_;
  std::unique_ptr<GrowingFiles> growing_;
};

}  // namespace railstrata
