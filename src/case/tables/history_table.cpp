#include "tables/history_table.hpp"

#include "options/option_table.hpp"
#include "tables/unit_table.hpp"

namespace railstrata {
namespace {

/// "distance" for at_distance.
std::string_view short_key(std::string_view key) { return key.starts_with("at_") ? key.substr(3) : key; }

}  // namespace

std::vector<int> read_history_table(const std::string& text, const std::filesystem::path& file, CaseSpec& spec) {
  const OptionTable& options = *find_table("transient");
  UnitTableForm form{{}, options.rivals, "a history", "distance [mm], tractive_force [kN]"};
  for (const Option& option : options.options)
    if (std::holds_alternative<std::vector<double>*>(option.slot(spec, 0)))
      form.columns.push_back({&option, short_key(option.key)});
  const UnitTable table = read_unit_table(text, file, form);
  std::vector<int> lines{table.line};
  for (const UnitTable::Row& row : table.rows) {
    lines.push_back(row.line);
    for (std::size_t k = 0; k < row.cells.size(); ++k)
      std::get<std::vector<double>*>(table.columns[k]->slot(spec, 0))->push_back(row.cells[k].number.value());
  }
  return lines;
}

}  // namespace railstrata
