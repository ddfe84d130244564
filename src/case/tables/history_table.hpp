#pragma once
// A table of a transient's history: what transient.history_file names.
//
//   distance [mm], wheel_load [kN], creepage          keys of [transient] with their units, also as distance_mm;
//   0, 85, 0                                          "distance" and "time" stand for at_distance and at_time
//   5, 102, -0.001                                    "#" begins a comment
#include <filesystem>
#include <string>
#include <vector>

#include "spec/case_spec.hpp"

namespace railstrata {

/// The option that names such a file.
inline constexpr const char* kHistoryFile = "transient.history_file";

/// Fills the columns of spec.transient that the table has. Returns the numbers of its lines in the file: of the names,
/// then of each row. Throws CaseError with file, line and remedy; `file` names it.
std::vector<int> read_history_table(const std::string& text, const std::filesystem::path& file, CaseSpec& spec);

}  // namespace railstrata
