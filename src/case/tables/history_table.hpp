#pragma once
// A table of a transient's history: what transient.history_file names.
//
//   distance [mm], wheel_load [kN], creepage          keys of [transient] with their units, also as distance_mm;
//   0, 85, 0                                          "distance" and "time" stand for at_distance and at_time
//   5, 102, -0.001                                    way and time count from the first row
//
// Headings of other languages as in a collective (column_words.hpp); other columns are not read.
#include <filesystem>
#include <string>
#include <vector>

#include "spec/case_spec.hpp"

namespace railstrata {

/// The option that names such a file.
inline constexpr const char* kHistoryFile = "transient.history_file";

struct HistoryLines {
  std::vector<int> of;             ///< numbers of the lines in the file: of the names, then of each row
  std::vector<std::string> notes;  ///< what was not read, and from where the way counts
};

/// Fills the columns of spec.transient that the table has. Throws CaseError with file, line and remedy; `file` names
/// it.
HistoryLines read_history_table(const std::string& text, const std::filesystem::path& file, CaseSpec& spec);

}  // namespace railstrata
