#pragma once
// The folder of a study: what says that it is one, and where its table comes from.
#include <filesystem>
#include <string>
#include <vector>

#include "io/output_folder.hpp"
#include "study/study_file.hpp"

namespace railstrata {

/// A study has begun in this folder. It is known by the command line in provenance.json, which prepare_study_folder
/// writes first; study.toml is what people call their own files.
bool is_study_folder(const std::filesystem::path& folder);

/// Makes the folder, or takes one where a study has begun, and writes provenance.json and study.toml into it. Throws as
/// prepare_output_folder.
[[nodiscard]] FolderHold prepare_study_folder(const std::filesystem::path& folder, const LoadedStudy& study,
                                              const std::vector<std::string>& command_line,
                                              const std::vector<std::string>& overrides, int threads, bool force);

/// The "#" lines of study.csv.
std::vector<std::string> study_origin(const LoadedStudy& study);

}  // namespace railstrata
