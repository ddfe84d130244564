#pragma once
// What the ranks other than 0 do of a run in a folder (runs/folder_run.hpp): they compute with it and touch no file.
#include "runs/folder_run.hpp"

namespace railstrata {

/// A run as a rank sees it that does not speak.
struct RankedRun {
  LoadedCase loaded;
  std::optional<RunState> begun = {};
};

/// The run that rank 0 begins by begin_run(). Throws CaseError as that does for what the case asks.
RankedRun join_run(LoadedCase loaded, const Ranks& ranks);
/// The one that it goes on with by resume_run().
RankedRun join_resumed_run(const std::filesystem::path& folder, const Ranks& ranks);

/// Computes along with rank 0's solve_in_folder(), until the files are to be written. Throws as solve_fem.
void follow_run(RankedRun& run, const FemOptions& options);

}  // namespace railstrata
