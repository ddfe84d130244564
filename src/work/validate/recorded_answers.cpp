#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <map>

#include "tables/unit_table.hpp"
#include "text/text_file.hpp"
#include "validate/validation_set.hpp"

namespace railstrata {
namespace {

using RecordedRow = std::map<std::string, std::string>;

/// The rows of a table of results, of these columns, as texts.
std::vector<RecordedRow> recorded_rows(const std::filesystem::path& file, const std::vector<std::string>& columns) {
  std::vector<Option> options;
  for (const std::string& name : columns)
    options.push_back({.key = name,
                       .slot = [](CaseSpec& spec, std::size_t) -> Slot { return &spec.title; },  // texts are kept
                       .doc = {},
                       .dimension = dimension::kNumber});
  UnitTableForm form{.columns = {}, .rivals = {}, .what = "a recorded answer", .example = "p_max_MPa"};
  form.as_written = form.blanks = true;
  for (const Option& o : options) form.columns.push_back({&o, o.key});
  const UnitTable table =
      read_unit_table(read_text_file(file, "a table of results, e.g. the study.csv of a study"), file, form);
  for (const std::string& name : columns)
    if (std::find(table.names.begin(), table.names.end(), name) == table.names.end())
      refuse_in_table(file, table.line, fmt::format("no column {}", name),
                      "record the answers anew, or take [[vary]], where and result from these columns");
  std::vector<RecordedRow> out;
  for (const UnitTable::Row& row : table.rows) {
    RecordedRow& texts = out.emplace_back();
    for (std::size_t k = 0; k < row.cells.size(); ++k) texts.emplace(table.names[k], row.cells[k].text);
  }
  return out;
}

}  // namespace

Answers recorded_answers(const ValidationSet& set, const ValidationSeries& series, const RowTexts& rows) {
  std::vector<std::string> columns;
  const auto name = [&](const std::string& column) {
    if (std::find(columns.begin(), columns.end(), column) == columns.end()) columns.push_back(column);
  };
  for (const VariedColumn& v : set.varied) name(v.key);
  for (const NamedText& w : series.where) name(w.name);
  for (const ComparedColumn& c : set.compared) name(c.result);
  const std::vector<RecordedRow> recorded = recorded_rows(series.recorded, columns);
  Answers out;
  for (const ComparedColumn& c : set.compared) out.numbers.push_back({c.result, {}});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<NamedText> wanted = series.where;
    for (std::size_t k = 0; k < rows[i].size(); ++k) wanted.push_back({set.varied[k].key, rows[i][k]});
    const auto fits = [&](const RecordedRow& row) {
      return std::all_of(wanted.begin(), wanted.end(), [&](const NamedText& w) { return row.at(w.name) == w.text; });
    };
    const auto row = std::find_if(recorded.begin(), recorded.end(), fits);
    if (row == recorded.end()) {
      std::vector<std::string> words;
      for (const NamedText& w : wanted) words.push_back(fmt::format("{} = {}", w.name, w.text));
      out.faults.push_back(fmt::format("row {}: {} has no row with {}", i + 1, series.recorded.filename().string(),
                                       fmt::join(words, ", ")));
    }
    for (CsvColumn& c : out.numbers) {
      double& value = c.values.emplace_back(std::numeric_limits<double>::quiet_NaN());
      if (row == recorded.end()) continue;
      const std::string& text = row->at(c.name);
      std::from_chars(text.data(), text.data() + text.size(), value);
    }
  }
  return out;
}

}  // namespace railstrata
