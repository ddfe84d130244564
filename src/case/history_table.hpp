#pragma once
// A table of a transient's history: what transient.history_file names.
//
//   distance [mm], wheel_load [kN], creepage          keys of [transient] with their units, also as distance_mm;
//   0, 85, 0                                          "distance" and "time" stand for at_distance and at_time
//   5, 102, -0.001                                    commas or semicolons; "#" begins a comment
#include <filesystem>
#include <string>

#include "case/case_spec.hpp"

namespace railstrata {

/// Fills the columns of spec.transient that the table has. Throws CaseError with line and remedy; `file` names it.
void read_history_table(const std::string& text, const std::filesystem::path& file, CaseSpec& spec);

}  // namespace railstrata
