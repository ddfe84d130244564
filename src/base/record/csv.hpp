#pragma once
// Tables as text: "#" lines with the origin of the numbers, one header row of names with units, then rows of numbers
// with a decimal point that read back to the same doubles; what is not a number is left empty. Errors: EnvironmentError
// for the disk, std::invalid_argument for columns of unequal length or names with commas.
#include <cassert>
#include <filesystem>
#include <initializer_list>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "record/column.hpp"
#include "record/output_file.hpp"

namespace railstrata {

struct CsvColumn {
  std::string name;  ///< with its unit: "pressure_MPa"
  std::vector<double> values;
};

/// Texts as the "# " lines that head a table, one for each of their lines.
std::string csv_remarks(const std::vector<std::string>& texts);

/// Writes a finished table, whole (record/output_file). provenance: one "# …" line each.
void write_csv(const std::filesystem::path& file, const std::vector<std::string>& provenance,
               const std::vector<CsvColumn>& columns);

/// The columns of records, each a row.
template <class Record>
std::vector<CsvColumn> csv_columns(const std::vector<Record>& records, const Columns<Record>& columns) {
  std::vector<CsvColumn> out;
  for (const Column<Record>& column : columns) {
    out.push_back({column.column_name(), {}});
    std::transform(records.begin(), records.end(), std::back_inserter(out.back().values),
                   [&](const Record& record) { return column.in_table(record); });
  }
  return out;
}
template <class Record>
void write_csv(const std::filesystem::path& file, const std::vector<std::string>& provenance,
               const std::vector<Record>& records, const Columns<Record>& columns) {
  write_csv(file, provenance, csv_columns(records, columns));
}

/// A table read back: what write_csv and CsvLog have written. Columns of earlier programs have their present names.
struct CsvTable {
  std::filesystem::path file;
  std::vector<CsvColumn> columns;

  /// The values of a column times `unit`. Throws CaseError naming the file if there is no such column.
  std::vector<double> column(const std::string& name, double unit = 1) const;
  std::size_t rows() const { return columns.empty() ? 0 : columns.front().values.size(); }
};

/// A further row; the first one brings the names.
template <class Record>
void add_row(const Columns<Record>& columns, const Record& record, CsvTable& table) {
  if (table.columns.empty())
    for (const std::string& name : names_of(columns)) table.columns.push_back({name, {}});
  for (std::size_t c = 0; c < columns.size(); ++c) table.columns[c].values.push_back(columns[c].in_table(record));
}

/// The first rows of a table with these columns, whatever they were called when it was written.
template <class Record>
CsvTable first_rows(CsvTable table, const Columns<Record>& columns, std::size_t rows) {
  assert(table.columns.size() == columns.size() && table.rows() >= rows);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    table.columns[c].name = columns[c].column_name();
    table.columns[c].values.resize(rows);
  }
  return table;
}

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

/// The same for records.
template <class Record>
class RecordLog {
 public:
  RecordLog(const std::filesystem::path& file, const std::vector<std::string>& provenance, Columns<Record> columns)
      : columns_(std::move(columns)), log_(file, provenance, names_of(columns_)) {}
  void add(const Record& record) { log_.add(table_row(columns_, record)); }
  /// A row of an earlier table with these columns.
  void add_row(std::span<const double> row) { log_.add(row); }

 private:
  Columns<Record> columns_;
  CsvLog log_;
};

}  // namespace railstrata
