#pragma once
// Two-column number files as people write them.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/vec.hpp"

namespace railstrata {

struct NumberTable {
  std::vector<Vec2> rows;
  std::vector<int> lines;   ///< of each row, from 1
  std::string heading;      ///< comments and header lines before the first row, for a look at the units
  std::size_t skipped = 0;  ///< lines before the first row that are neither comments nor points
  bool decimal_commas = false;
  std::size_t columns = 2;         ///< columns of every row; only the first two are kept
  std::vector<std::string> notes;  ///< what a reader of another program's files has done, one sentence each
};

/// The words of a line between blanks, commas and semicolons.
std::vector<std::string> split_words(std::string_view line);
/// A whole word as a number, with an exponent of C or of Fortran (1.0D+01); none if it is not one.
std::optional<double> number_of(std::string_view word);

/// Reads blanks, tabs, commas or semicolons between columns; decimal points or commas; U+2212 as a minus; comments
/// after # % ! "; header lines before the first row; a lone count of points before the rows. Throws CaseError with
/// name:line for a line that is not two numbers, another count of columns, NaN and infinities; before the first row for
/// one with digits in every word, one of them a number.
NumberTable parse_number_table(std::string_view text, const std::string& name);

}  // namespace railstrata
