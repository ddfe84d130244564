#pragma once
// Tables of options as text: a line of column names with their units, then a line for each row.
//
//   distance [mm], wheel_load [kN], creepage          units also as distance (mm) and distance_mm
//   0, 85, 0
//   # 10, 90, 0                                       a comment: only a whole line is one
//
// Columns are separated by what the line of names has: semicolons, tabs or commas. Names are those of their keys, where
// no other key is written so in any case and with blanks for underscores ("Wheel load (kN)"). Numbers may have decimal
// commas where a comma does not separate (a spreadsheet's "2,5; 102; -0,001") and exponents of Fortran (1.0D+01).
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "options/option_table.hpp"

namespace railstrata {

/// Columns that a table may have.
struct UnitTableForm {
  struct Column {
    const Option* option;  ///< without a slot: a number
    std::string_view key;  ///< its name; the option's own key is taken too
  };
  std::vector<Column> columns;
  std::vector<std::vector<std::string_view>> rivals;
  std::string_view what;     ///< that a row, or the table, describes, for messages: "a history"
  std::string_view example;  ///< of a line of names
  bool blanks = false;       ///< a cell may be empty
  bool others = false;       ///< columns of other words (time, specimen) may stand there; they are not read
  bool as_written = false;   ///< names are whole keys, without units; all others are not read
  std::vector<std::string_view> loads = {};  ///< keys: a row with 0 or less there is of a lifted wheel and left out
  std::string_view chainage = {};  ///< a key: counted from the first row, where its values are out of the range
};

struct UnitTable {
  struct Cell {
    std::optional<double> number;  ///< SI; of an empty cell, and of a text, none
    std::string text;
  };
  struct Row {
    int line = 0;
    std::vector<Cell> cells;
  };
  int line = 0;  ///< of the names
  std::vector<const Option*> columns;
  std::vector<std::string> names;    ///< of the columns, as written
  std::vector<std::string> ignored;  ///< names of columns that are not read
  std::vector<Row> rows;
  int lifted = 0;       ///< rows that were left out (UnitTableForm::loads)
  double chainage = 0;  ///< SI, of the first row, where it was taken off all
  /// Whether one of the columns is of this key.
  bool has(std::string_view key) const;
};

/// Whether a column of this name is that of the key, whatever its unit: "Time (s)" of time.
bool names_column(std::string_view name, std::string_view key);

/// Whether a line is a comment, "#" and anything but an error of a spreadsheet ("#NV").
bool is_comment(std::string_view line);

/// The cells of the first line that is neither empty nor a comment: the line of names.
std::vector<std::string> column_names(const std::string& text);

/// Throws CaseError with file, line and remedy: unknown and rival columns, units, numbers out of an option's range.
UnitTable read_unit_table(const std::string& text, const std::filesystem::path& file, const UnitTableForm& form);

/// The CaseError of a line.
[[noreturn]] void refuse_in_table(const std::filesystem::path& file, int line, const std::string& what,
                                  const std::string& remedy);

}  // namespace railstrata
