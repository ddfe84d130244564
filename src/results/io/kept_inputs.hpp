#pragma once
// The profile files of a case, kept with its results: inputs/<name>. case.toml there names them by these relative
// paths, so that the folder can be moved and computed again when the files it was made from are gone.
#include <filesystem>
#include <string>
#include <vector>

#include "reader/case_file.hpp"

namespace railstrata {

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

}  // namespace railstrata
