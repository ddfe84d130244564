#pragma once
// A creep-force table as the bytes of an HDF5 file, and read from a file.
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "table/force_table.hpp"

namespace railstrata {

/// Texts of the file itself: the case, the program, the measured error of interpolation.
using TableRemarks = std::vector<std::pair<std::string, std::string>>;

/// Empty where HDF5 gives up (no memory).
std::string table_image(const ForceTable& table, const TableRemarks& remarks);
/// None: the file holds no such table.
std::optional<ForceTable> table_in_file(const std::filesystem::path& file);

}  // namespace railstrata
