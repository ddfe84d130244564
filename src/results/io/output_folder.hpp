#pragma once
// The folder of a run's results.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "io/folder_hold.hpp"
#include "reader/case_file.hpp"

namespace railstrata {

/// Folders within that of a result: its half-space reference, the patch during the rolling, positions before the last
/// ("position_170mm").
inline constexpr const char *kReferenceFolder = "half_space", *kSeriesFolder = "patch_series",
                            *kPositionFolder = "position_";

/// Makes the folder, holds it and tries to write in it. With `begun` several may work together in one that it calls
/// theirs, or that is empty. Throws CaseError when it is held or holds files and `force` is not set, EnvironmentError
/// when it cannot be made or written.
[[nodiscard]] FolderHold prepare_output_folder(const std::filesystem::path& folder, bool force,
                                               const std::function<bool()>& begun = {});

/// Removes an older result of `run` or `bem`, so that nothing of it stands beside what is on its way: its tables and
/// pictures, those of its positions and its half-space reference, checkpoints. Other files stay.
void clear_old_results(const std::filesystem::path& folder);

/// Throws CaseError if write_origin() would replace the file that the case was read from.
void require_apart(const std::filesystem::path& folder, const LoadedCase& loaded);

/// Copies of the profile files (io/kept_inputs.hpp), case.toml with every option written out, case.original.toml as
/// it was given, provenance.json. Each file is whole or not there.
void write_origin(const std::filesystem::path& folder, const LoadedCase& loaded,
                  const std::vector<std::string>& command_line, int threads);

/// Whose half written files: of dead processes of this machine, or anyone's, where the folder is ours alone.
enum class PartsOf { dead, anyone };
/// Removes files that a killed run left half written in the folder and its subfolders:
/// <a result's name>.part-<host>-<process id>.
void remove_parts(const std::filesystem::path& folder, PartsOf whom);

/// SHA-256 over the resolved case but for run.device and the content of the profile files it names, wherever they lie:
/// what a checkpoint must agree with.
std::string case_identity(const LoadedCase& loaded);

/// The same as of a folder's own case.toml: folders from before 0.2.0 keep no copies of their profiles, and their
/// checkpoints carry identity_by_path.
std::string identity_in_folder(const std::filesystem::path& folder, const LoadedCase& loaded);

/// SHA-256 over the resolved case with the absolute paths of its profile files, and their content.
std::string identity_by_path(const LoadedCase& loaded);

/// The "#" lines of a case's tables: program, case, axes and signs.
std::vector<std::string> table_origin(const LoadedCase& loaded);

}  // namespace railstrata
