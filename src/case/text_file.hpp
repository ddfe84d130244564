#pragma once
// A text file a user names.
#include <filesystem>
#include <string>

namespace railstrata {

/// The whole file, of 4 MiB at most. Throws CaseError with the system's reason; `remedy`: where such files are.
std::string read_text_file(const std::filesystem::path& file, const std::string& remedy);

}  // namespace railstrata
