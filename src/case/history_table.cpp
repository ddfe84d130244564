#include "case/history_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <vector>

#include "case/option_table.hpp"
#include "core/faults.hpp"
#include "core/nearest_word.hpp"
#include "core/printable.hpp"

namespace railstrata {
namespace {

struct Place {
  const std::filesystem::path& file;
  int line;
  [[noreturn]] void refuse(const std::string& what, const std::string& remedy) const {
    throw CaseError(printable(what), remedy, fmt::format("{}:{}", file.string(), line));
  }
};

struct Column {
  const Option* option;
  std::string unit;
  std::vector<double>* values;
};

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\""), last = text.find_last_not_of(" \t\r\"");
  return first == std::string_view::npos ? std::string() : std::string(text.substr(first, last - first + 1));
}

/// By the line of names. One column alone has nothing to separate.
char separator_of(const std::string& names) {
  for (const char c : {';', '\t', ','})
    if (names.find(c) != std::string::npos) return c;
  return ';';
}

/// Between quotes nothing separates. Spreadsheets end lines with an empty cell: it is none.
std::vector<std::string> cells_of(const std::string& line, char separator) {
  std::vector<std::string> out(1);
  bool quoted = false;
  for (const char c : line) {
    quoted = quoted != (c == '"');
    if (c == separator && !quoted)
      out.emplace_back();
    else
      out.back() += c;
  }
  for (std::string& cell : out) cell = trimmed(cell);
  if (out.size() > 1 && out.back().empty()) out.pop_back();
  return out;
}

const OptionTable& transient_options() {
  return *std::find_if(case_tables().begin(), case_tables().end(),
                       [](const OptionTable& t) { return t.name == "transient"; });
}

bool is_column(const Option& option, CaseSpec& spec) {
  return std::holds_alternative<std::vector<double>*>(option.slot(spec, 0));
}

/// "distance" for at_distance.
std::string_view short_key(std::string_view key) { return key.starts_with("at_") ? key.substr(3) : key; }

/// The unit that follows a key: "distance [mm]" and "distance_mm" have "mm", "spin_1_m" has "1/m"; nothing for a name
/// that does not begin with the key.
std::optional<std::string> unit_after(const std::string& name, std::string_view key) {
  if (!name.starts_with(key)) return std::nullopt;
  std::string rest = trimmed(std::string_view(name).substr(key.size()));
  if (rest.empty()) return "";
  if (rest.size() > 2 && rest.front() == '[' && rest.back() == ']') return trimmed(rest.substr(1, rest.size() - 2));
  if (rest.front() != '_') return std::nullopt;
  rest.erase(0, 1);
  std::replace(rest.begin(), rest.end(), '_', '/');
  return rest;
}

/// A number with its column's unit, rounded once. What is no separator may be a decimal comma.
double quantity(const Column& column, const std::string& given, const Place& at) {
  double value = 0;
  std::string number = given;
  if (given.find('.') == std::string::npos && std::count(given.begin(), given.end(), ',') == 1)
    number[given.find(',')] = '.';
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error != std::errc{} || end != number.data() + number.size() || !std::isfinite(value))
    at.refuse(fmt::format("\"{}\" is not a number, in the column {}", given.substr(0, 40), column.option->key),
              "write numbers with a decimal point, or with a decimal comma between semicolons; the unit stands in the "
              "column's name");
  try {
    value = parse_quantity(column.unit.empty() ? number : number + " " + column.unit, column.option->dimension);
  } catch (const UnitError& e) {
    at.refuse(fmt::format("the column {}: {}", column.option->key, e.what()), e.remedy);
  }
  if (!column.option->range.holds(value))
    at.refuse(fmt::format("{} = {}{}{}: must be {}", column.option->key, given, column.unit.empty() ? "" : " ",
                          column.unit, describe(column.option->range, column.option->dimension)),
              "choose a value in this range, or another unit in the column's name");
  return value;
}

Column column_named(const std::string& name, CaseSpec& spec, const Place& at) {
  std::optional<Column> best;
  std::size_t longest = 0;
  std::vector<std::string> known;
  for (const Option& option : transient_options().options) {
    if (!is_column(option, spec)) continue;
    known.emplace_back(short_key(option.key));
    for (const std::string_view key : {option.key, short_key(option.key)})
      if (const auto unit = unit_after(name, key); unit && key.size() > longest) {
        longest = key.size();
        best = Column{&option, *unit, std::get<std::vector<double>*>(option.slot(spec, 0))};
      }
  }
  const std::string near = nearest_word(name, known);
  if (!best)
    at.refuse(fmt::format("unknown column \"{}\"", name.substr(0, 60)),
              fmt::format("{}columns: {}, each with its unit: \"tractive_force [kN]\" or \"tractive_force_kN\"",
                          near.empty() ? "" : fmt::format("did you mean {}? ", near), fmt::join(known, ", ")));
  const bool plain = best->option->dimension == dimension::kNumber;
  if (best->unit.empty() && !plain)
    at.refuse(fmt::format("the column \"{}\" has no unit", name),
              fmt::format("write it into the column's name: {}", describe(best->option->dimension)));
  quantity(Column{best->option, best->unit, nullptr}, best->option->range.holds(0) ? "0" : "1e-3", at);
  return *best;
}

std::vector<Column> columns_of(const std::string& line, char separator, CaseSpec& spec, const Place& at) {
  std::vector<Column> out;
  for (const std::string& name : cells_of(line, separator)) {
    out.push_back(column_named(name, spec, at));
    for (std::size_t k = 0; k + 1 < out.size(); ++k)
      if (out[k].values == out.back().values)
        at.refuse(fmt::format("two columns are {}", out.back().option->key), "keep one of them");
  }
  for (const auto& rivals : transient_options().rivals) {
    std::vector<std::string_view> given;
    for (const Column& c : out)
      if (std::find(rivals.begin(), rivals.end(), c.option->key) != rivals.end()) given.push_back(c.option->key);
    if (given.size() > 1)
      at.refuse(fmt::format("the table has {}: a history has one of them", fmt::join(given, " and ")),
                "keep one of them");
  }
  return out;
}

[[noreturn]] void refuse_width(std::size_t cells, std::size_t columns, char separator, const Place& at) {
  at.refuse(fmt::format("{} {} in a table of {} {}", cells, cells == 1 ? "value" : "values", columns,
                        columns == 1 ? "column" : "columns"),
            separator == ',' ? "give every row one value a column; decimal commas need semicolons between the columns, "
                               "in the line of names too"
                             : "give every row one value a column, separated as the names are");
}

}  // namespace

std::vector<int> read_history_table(const std::string& text, const std::filesystem::path& file, CaseSpec& spec) {
  std::istringstream stream(text);
  std::vector<Column> columns;
  std::vector<int> lines;
  char separator = ',';
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    line = line.substr(0, line.find('#'));
    if (trimmed(line).empty()) continue;
    const Place at{file, number};
    lines.push_back(number);
    if (columns.empty()) {
      separator = separator_of(line);
      columns = columns_of(line, separator, spec, at);
      continue;
    }
    const std::vector<std::string> cells = cells_of(line, separator);
    if (cells.size() != columns.size()) refuse_width(cells.size(), columns.size(), separator, at);
    for (std::size_t k = 0; k < cells.size(); ++k) columns[k].values->push_back(quantity(columns[k], cells[k], at));
  }
  if (lines.size() < 2)
    Place{file, std::max(number, 1)}.refuse(
        "the table has no rows",
        "write a line of column names, e.g. \"distance [mm], tractive_force [kN]\", "
        "then a line for each row");
  return lines;
}

}  // namespace railstrata
