#pragma once
// The files of a finite element run: those that grow while it is solved, and its results.
#include <filesystem>
#include <optional>
#include <vector>

#include "io/checkpoint_file.hpp"
#include "runs/solve_fem.hpp"
#include "runs/write_transient.hpp"

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

  /// Makes the observer write history.csv, patch.pvd with its frames in patch_series/ (if the case asks for them) and
  /// checkpoint.h5, by save_checkpoint. The writer and the control must outlive the observer.
  void observe(RunObserver& observer, const Control& control);

  /// Writes per position (in the folder itself for the last of a finished run, in position_<mm>/ for the others)
  /// summary.json; patch.csv, centre_line.csv, depth_line.csv and two sections a body; patch.vtp, rail_surface.vtp,
  /// wheel_surface.vtp, geometry.json and view.py; rail.vtu and wheel.vtu if the case asks for them. Removes the
  /// checkpoints of a finished run. Throws EnvironmentError for the disk.
  void write(const FemSolution& solution);

 private:
  void begin_history();
  void add(const HistoryRow& row);
  bool has_series() const;
  PatchSeries& series(const std::vector<double>& times = {});
  const RollingSystem& system_;
  std::filesystem::path folder_;
  CheckpointOrigin origin_;
  // made when there is something to put in: a run stopped before the rolling leaves none
  std::optional<RecordLog<HistoryRow>> history_;
  std::optional<RecordLog<PointRow>> points_;
  std::optional<PatchSeries> series_;
};

}  // namespace railstrata
