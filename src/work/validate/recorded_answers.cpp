#include "validate/recorded_answers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "tables/unit_table.hpp"
#include "text/text_file.hpp"
#include "validate/validation_set.hpp"

namespace railstrata {
namespace {

/// Columns of a table of results, as texts.
class Recorded {
 public:
  Recorded(const std::filesystem::path& file, const std::vector<std::string>& columns) : file_(file) {
    std::vector<Option> options;
    for (const std::string& name : columns)
      options.push_back({.key = name,
                         .slot = [](CaseSpec& spec, std::size_t) -> Slot { return &spec.title; },  // texts are kept
                         .doc = {},
                         .dimension = dimension::kNumber});
    UnitTableForm form{.columns = {}, .rivals = {}, .what = "a recorded answer", .example = "p_max_MPa"};
    form.as_written = form.blanks = true;
    for (const Option& o : options) form.columns.push_back({&o, o.key});
    table_ = read_unit_table(read_text_file(file, "a table of results, e.g. the study.csv of a study"), file, form);
    for (const std::string& name : columns) place_of(name);
  }

  /// Null: there is none.
  const UnitTable::Row* row(const std::vector<NamedText>& wanted) const {
    const auto found = std::find_if(table_.rows.begin(), table_.rows.end(), [&](const UnitTable::Row& r) {
      return std::all_of(wanted.begin(), wanted.end(),
                         [&](const NamedText& w) { return r.cells[place_of(w.name)].text == w.text; });
    });
    return found == table_.rows.end() ? nullptr : &*found;
  }

  double number(const UnitTable::Row* row, const std::string& name) const {
    double value = std::numeric_limits<double>::quiet_NaN();
    if (!row) return value;
    const std::string& text = row->cells[place_of(name)].text;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
  }

 private:
  std::size_t place_of(const std::string& name) const {
    const auto found = std::find(table_.names.begin(), table_.names.end(), name);
    if (found == table_.names.end())
      refuse_in_table(file_, table_.line, fmt::format("no column {}", name),
                      "record the answers anew, or take [[vary]], where and result from these columns");
    return static_cast<std::size_t>(found - table_.names.begin());
  }
  std::filesystem::path file_;
  UnitTable table_;
};

}  // namespace

Answers recorded_answers(const ValidationSet& set, const ValidationSeries& series, const RowTexts& rows) {
  std::vector<std::string> columns;
  const auto name = [&](const std::string& column) {
    if (std::find(columns.begin(), columns.end(), column) == columns.end()) columns.push_back(column);
  };
  for (const VariedColumn& v : set.varied) name(v.key);
  for (const NamedText& w : series.where) name(w.name);
  for (const ComparedColumn& c : set.compared) name(c.result);
  const Recorded recorded(series.recorded, columns);
  Answers out;
  for (const ComparedColumn& c : set.compared) out.numbers.push_back({c.result, {}});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<NamedText> wanted = series.where;
    for (std::size_t k = 0; k < rows[i].size(); ++k) wanted.push_back({set.varied[k].key, rows[i][k]});
    const UnitTable::Row* row = recorded.row(wanted);
    if (!row) {
      std::vector<std::string> words;
      for (const NamedText& w : wanted) words.push_back(fmt::format("{} = {}", w.name, w.text));
      out.faults.push_back(fmt::format("row {}: {} has no row with {}", i + 1, series.recorded.filename().string(),
                                       fmt::join(words, ", ")));
    }
    for (CsvColumn& c : out.numbers) c.values.push_back(recorded.number(row, c.name));
  }
  return out;
}

}  // namespace railstrata
