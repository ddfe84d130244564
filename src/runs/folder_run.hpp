#pragma once
// A finite element run in a result folder, begun anew or gone on with: what the command line and Python share.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/output_folder.hpp"
#include "runs/write_fem_result.hpp"

namespace railstrata {

struct FolderRun {
  LoadedCase loaded;
  std::filesystem::path folder;
  CheckpointOrigin origin;
  FolderHold hold;
  std::optional<RunState> begun = {};   ///< the state to go on from
  std::vector<std::string> notes = {};  ///< what the user should know of the checkpoint
};

/// Makes the folder and holds it; with `force` it may hold an older result, which is removed when the run begins.
/// `ranks`: of the run. Throws CaseError (what finite elements refuse, faulty profiles, a folder in use),
/// EnvironmentError (a device that is not here, the disk).
FolderRun begin_run(LoadedCase loaded, const std::filesystem::path& folder, bool force = false,
                    const Ranks& ranks = {});

/// Goes on with the newest whole checkpoint of the folder. Throws CaseError: no run to go on with; EnvironmentError.
FolderRun resume_run(const std::filesystem::path& folder, const Ranks& ranks = {});

/// Where a run comes from, for its provenance.json.
struct RunCommand {
  std::vector<std::string> command_line;
  int threads = 0;
};

/// Solves the run and writes its files (runs/write_fem_result.hpp). Its phases: meshing, preload, rolling, writing.
/// Throws as solve_fem and FemWriter; the messages say what can be done with the folder.
FemSolution solve_in_folder(FolderRun& run, const RunCommand& command, const FemOptions& options = {});

/// "railstrata run --resume FOLDER"
std::string resume_command(const std::filesystem::path& folder);

}  // namespace railstrata
