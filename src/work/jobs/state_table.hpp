#pragma once
// A state, or a part of it, as a table that is whole or not there: every number of a row is named once, for writing and
// for reading back. Rows keep the units of their table, so that a job that goes on writes the bits that it has read.
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/vec.hpp"
#include "record/csv.hpp"

namespace railstrata {

template <class Row>
struct StateColumn {
  const char* symbol;  ///< its name without a unit
  double Row::*value;
  Unit unit = unit::kNone;

  std::string name() const { return symbol + std::string(unit.column_ending); }
};

template <class Row>
using StateColumns = std::vector<StateColumn<Row>>;

/// A row of SI numbers in the units of its table, and back.
template <class Row>
Row in_table(const StateColumns<Row>& columns, Row si) {
  for (const StateColumn<Row>& column : columns) si.*column.value *= column.unit.column_factor;
  return si;
}
template <class Row>
Row in_si(const StateColumns<Row>& columns, Row row) {
  for (const StateColumn<Row>& column : columns) row.*column.value *= 1 / column.unit.column_factor;
  return row;
}

template <class Row>
void write_rows(const std::filesystem::path& file, const std::vector<std::string>& origin,
                const StateColumns<Row>& columns, const std::vector<Row>& rows) {
  std::vector<CsvColumn> table;
  for (const StateColumn<Row>& column : columns) {
    table.push_back({column.name(), {}});
    for (const Row& row : rows) table.back().values.push_back(row.*column.value);
  }
  write_csv(file, origin, table);
}

/// Throws CaseError naming the file where a column is missing.
template <class Row>
std::vector<Row> read_rows(const std::filesystem::path& file, const StateColumns<Row>& columns) {
  const CsvTable table = read_csv(file);
  std::vector<Row> rows(table.rows());
  for (const StateColumn<Row>& column : columns) {
    const std::vector<double> values = table.column(column.name());
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k].*column.value = values[k];
  }
  return rows;
}

/// A profile as profiles are read (geometry/read_profile.hpp): y and z in mm.
inline const StateColumns<Vec2> kProfileColumns{{"y", &Vec2::y, unit::kMillimetres},
                                                {"z", &Vec2::z, unit::kMillimetres}};

inline void write_profile_table(const std::filesystem::path& file, const std::vector<std::string>& origin,
                                std::vector<Vec2> points) {
  for (Vec2& p : points) p = in_table(kProfileColumns, p);
  write_rows(file, origin, kProfileColumns, points);
}
inline std::vector<Vec2> read_profile_table(const std::filesystem::path& file) {
  std::vector<Vec2> points = read_rows(file, kProfileColumns);
  for (Vec2& p : points) p = in_si(kProfileColumns, p);
  return points;
}

}  // namespace railstrata
