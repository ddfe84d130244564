#pragma once
// A finite element run as a job: what the command line and Python share. Its state is checkpoint.h5, its files are
// those of runs/write_fem_result.hpp; phases: meshing, preload, rolling, writing.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "jobs/job.hpp"
#include "runs/write_fem_result.hpp"

namespace railstrata {

/// The case of a folder, as it was run. Throws CaseError: there is no run to go on with.
LoadedCase case_to_resume(const std::filesystem::path& folder);

class RunJob : public CaseJob {
 public:
  /// loaded: to resume, case_to_resume(). Throws CaseError (what finite elements refuse, faulty profiles),
  /// EnvironmentError (a device that is not here).
  RunJob(LoadedCase loaded, JobOrder order, const FemOptions& options, Control& control);

  // once it has ended, in whatever way
  const std::vector<Summary>& summaries() const { return summaries_; }  ///< of every position that was reached
  const std::optional<RunResidual>& residual() const { return residual_; }

 private:
  FolderHold hold() override;
  void begin() override;
  void resume() override;
  bool finished() const override { return finished_; }
  bool step() override;
  void finish() override {}
  bool write_page() override;
  bool out_of_time() const override { return out_of_time_; }
  std::string how_far() const override { return out_of_time_ ? "for --max-time" : "on request"; }
  std::string to_resume() const override;
  bool has_state() const override { return has_checkpoint(folder()); }
  void mesh();

  FemOptions options_;
  CheckpointOrigin checkpoint_;
  std::optional<RunState> begun_;  ///< the state to go on from
  std::unique_ptr<const RollingSystem> system_;
  bool finished_ = false, out_of_time_ = false;
  std::vector<Summary> summaries_;
  std::optional<RunResidual> residual_;
};

/// A rank other than 0: computes along with rank 0's job until the files are to be written, and touches none. resumed:
/// the folder that rank 0 resumes; empty: it begins. Throws CaseError as RunJob does for what the case asks, and as
/// solve_fem.
void follow_run(const LoadedCase& loaded, const std::filesystem::path& resumed, const FemOptions& options);

}  // namespace railstrata
