#pragma once
// The folder of a run's results.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "io/folder_hold.hpp"
#include "reader/case_file.hpp"

namespace railstrata {

/// Folders within that of a result: its references on half-spaces and sections, the patch during the rolling, positions
/// before the last ("position_170mm").
inline constexpr const char *kReferenceFolder = "half_space", *kSectionsFolder = "sections",
                            *kSeriesFolder = "patch_series", *kPositionFolder = "position_";

// ---- the profile files of a case, kept with its results: inputs/<name>. case.toml there names them by these relative
// paths, so that the folder can be moved and computed again when the files it was made from are gone.
inline constexpr const char* kInputsFolder = "inputs";

struct KeptInput {
  std::filesystem::path source;  ///< where the case has it
  std::string kept;              ///< its copy, relative to the result folder: "inputs/wheel.csv"
};

/// The profile files of the case (built-in profiles are none) and the names of their copies in `folder`: their own, or
/// "wheel-2.csv" where another file of that name is there; a copy that is there already is found again. Throws
/// EnvironmentError if a file cannot be read.
std::vector<KeptInput> kept_inputs(const LoadedCase& loaded, const std::filesystem::path& folder);

/// Copies what is not there yet. Throws EnvironmentError for the disk.
void copy_inputs(const std::vector<KeptInput>& inputs, const std::filesystem::path& folder);

/// case.toml of a result: every option with its value, profile files by the names of their copies.
std::string kept_case(const LoadedCase& loaded, const std::vector<KeptInput>& inputs);

/// Every option with its value, profile files by the SHA-256 of their content: the same wherever the files lie.
std::string case_by_content(const LoadedCase& loaded);

// ---- the folder
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

/// Copies of the profile files, case.toml with every option written out, case.original.toml as
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

/// The "#" lines of a case's tables: program, case, axes and signs.
std::vector<std::string> table_origin(const LoadedCase& loaded);

}  // namespace railstrata
