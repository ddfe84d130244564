#pragma once
// Tables as text: "#" lines that say where the numbers come from, one header row of names with units, then rows of
// numbers with a decimal point that read back to the same doubles; what is not a number is left empty. Errors:
// EnvironmentError for the disk, std::invalid_argument for columns of unequal length or names with commas.
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/output_file.hpp"

namespace railstrata {

struct CsvColumn {
  std::string name;  ///< with its unit: "pressure_MPa"
  std::vector<double> values;
};

/// Every value times a factor, for a column in another unit.
std::vector<double> scaled(std::vector<double> values, double factor);

/// Texts as the "# " lines that head a table, one for each of their lines.
std::string csv_remarks(const std::vector<std::string>& texts);

/// Writes a finished table, whole (io/output_file). provenance: one "# …" line each.
void write_csv(const std::filesystem::path& file, const std::vector<std::string>& provenance,
               const std::vector<CsvColumn>& columns);

/// A table read back: what write_csv and CsvLog have written.
struct CsvTable {
  std::filesystem::path file;
  std::vector<CsvColumn> columns;

  /// The values of a column times `unit`. Throws CaseError naming the file if there is no such column.
  std::vector<double> column(const std::string& name, double unit = 1) const;
  std::size_t rows() const { return columns.empty() ? 0 : columns.front().values.size(); }
};

/// Throws CaseError with the line if a row is not as many numbers as there are names, or if the file cannot be read.
CsvTable read_csv(const std::filesystem::path& file);

/// The same from a text; `file` names it in messages.
CsvTable parse_csv(const std::string& text, const std::filesystem::path& file);

/// A table that grows during a run (history.csv): every row is handed to the system at once, so it can be watched and
/// survives a crash of the program.
class CsvLog {
 public:
  CsvLog(const std::filesystem::path& file, const std::vector<std::string>& provenance,
         const std::vector<std::string>& names);
  /// One value per column.
  void add(std::span<const double> row);
  void add(std::initializer_list<double> row) { add(std::span<const double>(row.begin(), row.size())); }

 private:
  OutputFile file_;
  std::size_t columns_;
};

}  // namespace railstrata
