#include "tables/history_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "options/option_table.hpp"
#include "tables/column_words.hpp"
#include "tables/unit_table.hpp"

namespace railstrata {
namespace {

/// "distance" for at_distance.
std::string_view short_key(std::string_view key) { return key.starts_with("at_") ? key.substr(3) : key; }

}  // namespace

HistoryLines read_history_table(const std::string& text, const std::filesystem::path& file, CaseSpec& spec) {
  const OptionTable& options = *find_table("transient");
  UnitTableForm form{{}, options.rivals, "a history", "distance [mm], tractive_force [kN]"};
  for (const Option& option : options.options) {
    if (!std::holds_alternative<std::vector<double>*>(option.slot(spec, 0))) continue;
    form.columns.push_back({&option, short_key(option.key)});
    for (const std::string_view word : words_of(short_key(option.key))) form.columns.push_back({&option, word});
  }
  form.others = true;
  const UnitTable table = read_unit_table(text, file, form);
  HistoryLines out{{table.line}, {}};
  if (!table.ignored.empty())
    out.notes.push_back(fmt::format("{}: not read: {}", file.filename().string(), fmt::join(table.ignored, ", ")));
  for (const UnitTable::Row& row : table.rows) out.of.push_back(row.line);
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    const bool way = table.columns[k]->key.starts_with("at_");  // counted from the first row
    const double start = way ? table.rows.front().cells[k].number.value() : 0;
    if (start != 0)
      out.notes.push_back(fmt::format("{}: {} counts from its first row, {}", file.filename().string(), table.names[k],
                                      format_quantity(start, table.columns[k]->dimension)));
    std::vector<double>& column = *std::get<std::vector<double>*>(table.columns[k]->slot(spec, 0));
    for (const UnitTable::Row& row : table.rows) column.push_back(row.cells[k].number.value() - start);
  }
  return out;
}

}  // namespace railstrata
