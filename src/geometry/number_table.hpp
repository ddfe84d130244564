#pragma once
// Two-column number files as people write them.
#include <filesystem>
#include <string>
#include <vector>

#include "core/vec.hpp"

namespace railstrata {

struct NumberTable {
  std::vector<Vec2> rows;
  std::vector<int> lines;    ///< of each row, from 1
  std::string heading;       ///< comments and header lines before the first row, for a look at the units
  bool decimal_commas = false;
  std::size_t columns = 2;   ///< most columns met; only the first two are kept
};

/// Reads blanks, tabs, commas or semicolons between columns; decimal points or commas; comments after # % ! "; header lines before the first row; a lone count
/// of points before the rows. Throws CaseError with file:line for a line that is not two numbers, NaN and infinities; and for a file that cannot be read.
NumberTable read_number_table(const std::filesystem::path& file);

}  // namespace railstrata
