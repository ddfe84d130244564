#pragma once
// A case's result as a row of a table over many cases, and the table as CSV and JSON.
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/engine.hpp"
#include "many/result_columns.hpp"
#include "report/report.hpp"

namespace railstrata {

struct CaseRow {
  std::string group, name;
  Engine engine = Engine::bem;
  std::string state;             ///< "done", "failed", "to do"
  std::string fault;             ///< of a failed case its reason; of a result the check that fails
  std::filesystem::path folder;  ///< of the result, if it has one
  std::vector<std::pair<std::string, std::string>> values;  ///< what is varied: key and text
  std::vector<std::pair<std::string, double>> numbers;      ///< columns by their names; empty unless done
  ResultRemarks remarks{};

  bool done() const { return state == "done"; }
  std::string value(const std::string& key) const;  ///< "" if the case has no such key
  double number(const std::string& column) const;   ///< NaN if there is none
};

using CaseColumn = TextColumn<CaseRow>;

struct CaseTable {
  std::vector<CaseColumn> columns;
  std::vector<CaseRow> rows;
};

/// The keys that any case varies and the numbers that any case has, in the order of the rows.
std::vector<CaseColumn> value_columns(const std::vector<CaseRow>& rows);
std::vector<CaseColumn> number_columns(const std::vector<CaseRow>& rows);
/// Whether it lasts and what decides, where any row has a strength; whether a life ends, where one was asked for.
std::vector<CaseColumn> answer_columns(const std::vector<CaseRow>& rows);
/// The last columns of every row: fault, patches, checks, warnings.
std::vector<CaseColumn> remark_columns();

template <class... Lists>
std::vector<CaseColumn> joined(std::vector<CaseColumn> first, const Lists&... more) {
  (first.insert(first.end(), more.begin(), more.end()), ...);
  return first;
}

/// Cells as a line of CSV.
std::string csv_line(const std::vector<nlohmann::ordered_json>& cells);

/// The lines of a table: names, then rows.
template <class Row>
std::string csv_lines(const std::vector<TextColumn<Row>>& columns, const std::vector<Row>& rows) {
  ReportTable table;
  add_rows(table, rows, columns);
  std::string text = csv_line({table.columns.begin(), table.columns.end()});
  for (const std::vector<nlohmann::ordered_json>& cells : table.rows) text += csv_line(cells);
  return text;
}
/// An object a row.
template <class Row>
nlohmann::ordered_json json_rows(const std::vector<TextColumn<Row>>& columns, const std::vector<Row>& rows) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const Row& row : rows) {
    nlohmann::ordered_json& one = out.emplace_back(nlohmann::ordered_json::object());
    for (const TextColumn<Row>& c : columns) one[c.name] = c.cell(row);
  }
  return out;
}

/// Writes the table whole, `origin` as "#" lines above it.
void write_cases(const std::filesystem::path& file, const std::vector<std::string>& origin, const CaseTable& table);
/// An object a row.
nlohmann::ordered_json json_of(const CaseTable& table);

}  // namespace railstrata
