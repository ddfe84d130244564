#pragma once
// The page of a sweep: its numbers over a varied key, and all cases in a table.
#include <filesystem>
#include <string>
#include <vector>

#include "many/sweep.hpp"

namespace railstrata {

/// A chart for each number over the key with most values on an axis, a line for each combination of the other keys'.
/// Throws EnvironmentError for the disk.
void write_sweep_page(const std::filesystem::path& page, const std::string& title, const std::vector<Axis>& keys,
                      const std::vector<CaseRow>& rows);

}  // namespace railstrata
