#pragma once
// Ranks other than 0 of a run in a folder (runs/run_job.hpp): they compute and touch no file.
#include "runs/run_job.hpp"

namespace railstrata {

/// A run on a rank other than 0: computes, writes no file.
struct RankedRun {
  LoadedCase loaded;
  std::optional<RunState> begun = {};
};

/// The run that rank 0 begins. Throws CaseError as RunJob does for what the case asks.
RankedRun join_run(LoadedCase loaded, const Ranks& ranks);
/// The one that it resumes.
RankedRun join_resumed_run(const std::filesystem::path& folder, const Ranks& ranks);

/// Computes along with rank 0's job, until the files are to be written. Throws as solve_fem.
void follow_run(RankedRun& run, const FemOptions& options);

}  // namespace railstrata
