#pragma once
// The cases and profiles that come with the program.
#include <filesystem>

namespace railstrata {

/// The folder that holds cases/ and data/: $RAILSTRATA_DATA if that is set, share/railstrata beside an installed
/// program, wherever it was moved to, or the source tree around the build folder. Empty if there is none.
std::filesystem::path shipped_folder();

/// `file` as it is given. If nothing is there and a shipped file or folder has that name ("cases/quick"), the shipped
/// one: the examples of the help texts work in any folder.
std::filesystem::path shipped_unless_there(const std::filesystem::path& file);

/// The same; of a folder that has it the file of this name in it ("case.toml").
std::filesystem::path shipped_unless_there(const std::filesystem::path& file, const char* in_folder);

}  // namespace railstrata
