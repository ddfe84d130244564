#include "many/case_row.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/summary_json.hpp"
#include "record/csv.hpp"
#include "record/escaped_text.hpp"
#include "record/json.hpp"
#include "record/output_file.hpp"
#include "result/result_table.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;

/// The names of pairs of any row, each once.
template <class Pairs>
std::vector<std::string> names_in(const std::vector<CaseRow>& rows, Pairs CaseRow::*pairs) {
  std::vector<std::string> out;
  for (const CaseRow& row : rows)
    for (const auto& [name, value] : row.*pairs)
      if (std::find(out.begin(), out.end(), name) == out.end()) out.push_back(name);
  return out;
}

template <class Value>
Value found(const std::vector<std::pair<std::string, Value>>& pairs, const std::string& name, Value otherwise) {
  const auto at = std::find_if(pairs.begin(), pairs.end(), [&](const auto& pair) { return pair.first == name; });
  return at == pairs.end() ? otherwise : at->second;
}

/// In quotes where it needs them, no formula to a spreadsheet.
std::string csv_cell(const std::string& given) {
  const std::string text = without_formula(given);
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

/// Empty for a number that does not apply.
std::string csv_cell(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

}  // namespace

std::string CaseRow::value(const std::string& key) const { return found(values, key, std::string()); }
double CaseRow::number(const std::string& column) const { return found(numbers, column, kNotApplicable); }

std::vector<CaseColumn> value_columns(const std::vector<CaseRow>& rows) {
  std::vector<CaseColumn> out;
  for (const std::string& key : names_in(rows, &CaseRow::values))
    out.push_back({key, [key](const CaseRow& row) { return row.value(key); }});
  return out;
}

std::vector<CaseColumn> number_columns(const std::vector<CaseRow>& rows) {
  std::vector<CaseColumn> out;
  for (const std::string& name : names_in(rows, &CaseRow::numbers))
    out.push_back({name, [name](const CaseRow& row) {
                     const double v = row.number(name);
                     return std::isinf(v) ? Json(kEndlessLife) : json_number(v);
                   }});
  return out;
}

std::vector<CaseColumn> answer_columns(const std::vector<CaseRow>& rows) {
  const std::vector<CaseColumn> all{{"lasts", [](const CaseRow& row) { return row.remarks.lasts; }},
                                    {"decided_by", [](const CaseRow& row) { return row.remarks.decided_by; }},
                                    {"life", [](const CaseRow& row) { return row.remarks.life; }}};
  const auto given = [&](std::string ResultRemarks::*remark) {
    return std::any_of(rows.begin(), rows.end(), [=](const CaseRow& row) { return !(row.remarks.*remark).empty(); });
  };
  std::vector<CaseColumn> out;
  if (given(&ResultRemarks::lasts)) out = {all[0], all[1]};
  if (given(&ResultRemarks::life)) out.push_back(all[2]);
  return out;
}

std::vector<CaseColumn> remark_columns() {
  return {{"fault", [](const CaseRow& row) { return row.fault.empty() ? Json(nullptr) : Json(row.fault); }},
          {"patches", [](const CaseRow& row) { return row.remarks.patches; }},
          {"checks", [](const CaseRow& row) { return row.remarks.checks; }},
          {"warnings", [](const CaseRow& row) { return row.remarks.warnings; }}};
}

std::string csv_line(const std::vector<Json>& cells) {
  std::string out;
  for (const Json& cell : cells) {
    if (cell.is_number()) out += csv_cell(cell.get<double>());
    if (cell.is_string()) out += csv_cell(cell.get<std::string>());
    out += &cell == &cells.back() ? '\n' : ',';
  }
  return out;
}

void write_cases(const std::filesystem::path& file, const std::vector<std::string>& origin, const CaseTable& table) {
  write_whole_file(file, csv_remarks(origin) + csv_lines(table.columns, table.rows));
}

Json json_of(const CaseTable& table) { return json_rows(table.columns, table.rows); }

}  // namespace railstrata
