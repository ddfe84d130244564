#pragma once
// A text file a user names.
#include <filesystem>
#include <string>
#include <vector>

namespace railstrata {

/// The whole file, of 64 MiB at most, in UTF-8; one that is not is read as Windows-1252, which `notes` say. Throws
/// CaseError with the system's reason; `remedy`: where such files are.
std::string read_text_file(const std::filesystem::path& file, const std::string& remedy,
                           std::vector<std::string>* notes = nullptr);

}  // namespace railstrata
