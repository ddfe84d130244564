#pragma once
// The page of passes over a rail that yields, from the files of their folders (passes/pass_files.hpp): the verdict in
// words, what every pass has done, maps of the section, profiles, loops.
#include <filesystem>
#include <vector>

namespace railstrata {

/// Writes the page of one folder, or of several side by side, from their passes.json, passes.csv, residual.csv and
/// profile.csv, and loops.csv and along.csv where they are there. Throws CaseError at a file that is missing or
/// damaged.
void write_passes_page(const std::filesystem::path& page, const std::vector<std::filesystem::path>& folders);

}  // namespace railstrata
