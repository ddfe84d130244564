#include "tables/unit_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>
#include <utility>

#include "core/faults.hpp"
#include "core/nearest_word.hpp"
#include "core/printable.hpp"
#include "core/text.hpp"

namespace railstrata {
namespace {

struct Place {
  const std::filesystem::path& file;
  int line;
  [[noreturn]] void refuse(const std::string& what, const std::string& remedy) const {
    refuse_in_table(file, line, what, remedy);
  }
};

struct Column {
  const Option* option;
  std::string unit;
  bool text = false;
};

std::string cell_of(std::string_view text) { return std::string(trimmed(text, " \t\r\"")); }

/// Those that are neither empty nor comments.
template <class See>
void for_each_line(const std::string& text, See&& see) {
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    if (!cell_of(line).empty() && !is_comment(line)) see(line, number);
  }
}

/// By the line of names. One column alone has nothing to separate.
char separator_of(const std::string& names) {
  for (const char c : {';', '\t', ','})
    if (names.find(c) != std::string::npos) return c;
  return ';';
}

/// Between quotes nothing separates. Spreadsheets end lines with an empty cell: it is none, but of a row that asks for
/// it.
std::vector<std::string> cells_of(const std::string& line, char separator, std::size_t asked = 1) {
  std::vector<std::string> out(1);
  bool quoted = false;
  for (const char c : line) {
    quoted = quoted != (c == '"');
    if (c == separator && !quoted)
      out.emplace_back();
    else
      out.back() += c;
  }
  for (std::string& cell : out) cell = cell_of(cell);
  if (out.size() > asked && out.back().empty()) out.pop_back();
  return out;
}

/// As a cell's begin.
bool is_spreadsheet_error(std::string_view cell) {
  constexpr std::array kErrors{"#NV",        "#N/A",     "#NA",        "#DIV/0!", "#WERT!", "#VALUE!",  "#VALEUR!",
                               "#VÄRDEFEL!", "#REF!",    "#BEZUG!",    "#NAME?",  "#NOM?",  "#NAMN?",   "#NUM!",
                               "#ZAHL!",     "#NOMBRE!", "#OGILTIGT!", "#NULL!",  "#NUL!",  "#SAKNAS!", "#####"};
  return std::any_of(kErrors.begin(), kErrors.end(), [&](std::string_view error) { return cell == error; });
}

/// Lower case, blanks and hyphens as underscores.
std::string folded(std::string_view name) {
  std::string out(name);
  for (char& c : out) c = c == ' ' || c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

/// The unit that follows a key: "distance [mm]", "distance (mm)" and "distance_mm" have "mm", "spin_per_m" and
/// "spin_1_m" have "1/m"; nothing for a name that does not begin with the key. fold: in any case, with blanks.
std::optional<std::string> unit_after(const std::string& name, std::string_view key, bool fold) {
  const std::string_view begin = std::string_view(name).substr(0, key.size());
  if (begin != key && !(fold && folded(begin) == folded(key))) return std::nullopt;
  std::string rest = cell_of(std::string_view(name).substr(key.size()));
  if (rest.empty()) return "";
  if (rest.size() > 2 && ((rest.front() == '[' && rest.back() == ']') || (rest.front() == '(' && rest.back() == ')')))
    return cell_of(std::string_view(rest).substr(1, rest.size() - 2));
  if (rest.front() != '_') return std::nullopt;
  rest.erase(0, 1);
  if (rest.starts_with("per_")) rest.replace(0, 3, "1");
  std::replace(rest.begin(), rest.end(), '_', '/');
  return rest;
}

[[noreturn]] void refuse_width(std::size_t cells, std::size_t columns, char separator, const Place& at) {
  at.refuse(fmt::format("{} {} in a table of {} {}", cells, cells == 1 ? "value" : "values", columns,
                        columns == 1 ? "column" : "columns"),
            separator == ',' ? "give every row one value a column; decimal commas need semicolons between the columns, "
                               "in the line of names too"
                             : "give every row one value a column, separated as the names are");
}

/// A word, not a number of a table without names.
bool is_word(const std::string& name) {
  constexpr unsigned char kBeyondAscii = 0x80;  // letters of other scripts
  if (name.empty()) return false;
  const auto first = static_cast<unsigned char>(name.front());
  return std::isalpha(first) || first >= kBeyondAscii;
}

class TableReader {
 public:
  explicit TableReader(const UnitTableForm& form) : form_(form) {}

  void read_line(const std::string& line, const Place& at) {
    if (columns_.empty()) return read_names(line, at);
    const std::vector<std::string> cells = cells_of(line, separator_, form_.blanks ? columns_.size() : 1);
    if (std::all_of(cells.begin(), cells.end(), [](const std::string& cell) { return cell.empty(); })) return;
    if (cells.size() != columns_.size()) refuse_width(cells.size(), columns_.size(), separator_, at);
    UnitTable::Row row{.line = at.line, .cells = {}};
    for (std::size_t k = 0; k < cells.size(); ++k)
      if (columns_[k].option) row.cells.push_back(cell(columns_[k], cells[k], at));
    if (std::exchange(lifted_, false))
      ++table_.lifted;
    else
      table_.rows.push_back(std::move(row));
  }

  UnitTable table() && {
    if (decimal_commas_ && thousands_)
      refuse_in_table(thousands_->file, thousands_->line,
                      fmt::format("\"{}\" has a point, numbers beside it have decimal commas: is it {}, or {}?",
                                  thousands_->number, without(thousands_->number, '.'), thousands_->number),
                      "write it without marks of thousands, or with a comma for the decimals");
    return std::move(table_);
  }

 private:
  /// 420.000 in a file with decimal commas.
  struct Thousands {
    std::string number;
    std::filesystem::path file;
    int line;
  };

  static std::string without(std::string text, char mark) {
    text.erase(std::remove(text.begin(), text.end(), mark), text.end());
    return text;
  }

  UnitTable::Cell cell(const Column& column, const std::string& written, const Place& at) {
    if (column.text || (form_.blanks && written.empty())) return {std::nullopt, written};
    decimal_commas_ = decimal_commas_ || written.find(',') != std::string::npos;
    const std::size_t point = written.find('.');
    if (!thousands_ && point != std::string::npos && written.size() - point == 4)
      thousands_ = {written, at.file, at.line};
    return {quantity(column, written, at), written};
  }

  /// A number with the column's unit, rounded once. What is no separator may be a decimal comma.
  double quantity(const Column& column, const std::string& given, const Place& at) {
    double value = 0;
    std::string number = plain_signs(given);
    if (const std::size_t d = number.find_first_of("dD"); d != std::string::npos && d > 0) number[d] = 'e';
    if (number.starts_with('+')) number.erase(0, 1);
    if (given.find('.') == std::string::npos && std::count(given.begin(), given.end(), ',') == 1)
      number[number.find(',')] = '.';
    if (is_spreadsheet_error(given))
      at.refuse(fmt::format("\"{}\" is an error of the spreadsheet, in the column {}", given, column.option->key),
                "repair the formula, or take the row out");
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (error != std::errc{} || end != number.data() + number.size() || !std::isfinite(value))
      at.refuse(
          fmt::format("\"{}\" is not a number, in the column {}", given.substr(0, 40), column.option->key),
          given.find('#') != std::string::npos
              ? "a comment stands on a line of its own that begins with #"
              : "write numbers with a decimal point, or with a decimal comma between semicolons; the unit stands in "
                "the column's name");
    value = with_its_unit(column, number, at);
    const std::string_view key = column.option->key;
    if (!(value > 0) && std::find(form_.loads.begin(), form_.loads.end(), key) != form_.loads.end()) {
      lifted_ = true;
      return value;
    }
    if (key == form_.chainage && !column.option->range.holds(value) && table_.rows.empty()) table_.chainage = value;
    if (key == form_.chainage) value -= table_.chainage;
    if (!column.option->range.holds(value))
      at.refuse(fmt::format("{} = {}{}{}: must be {}", column.option->key, given, column.unit.empty() ? "" : " ",
                            column.unit, describe(column.option->range, column.option->dimension)),
                "choose a value in this range, or another unit in the column's name");
    return value;
  }

  /// Refuses a unit of another dimension where it stands.
  void unit_check(const Column& column, const Place& at) const { with_its_unit(column, "1", at); }

  double with_its_unit(const Column& column, const std::string& number, const Place& at) const {
    try {
      return in_si(column, column.unit.empty() ? number : number + " " + column.unit);
    } catch (const UnitError& e) {
      at.refuse(fmt::format("the column {}: {}", column.option->key, e.what()), e.remedy);
    }
  }

  double in_si(const Column& column, const std::string& text) const {
    try {
      return parse_quantity(text, column.option->dimension);
    } catch (const UnitError&) {
      if (column.option->dimension != dimension::kForce) throw;
    }
    return kGravity * parse_quantity(text, dimension::kMass);
  }

  /// The column of the longest key with which the name begins.
  std::optional<Column> known_column(const std::string& name, bool fold) const {
    std::optional<Column> best;
    std::size_t longest = 0;
    for (const UnitTableForm::Column& c : form_.columns)
      for (const std::string_view key : {c.option->key, c.key})
        if (const auto unit = form_.as_written && name != key ? std::nullopt : unit_after(name, key, fold);
            unit && key.size() > longest) {
          longest = key.size();
          best = Column{c.option, *unit, c.option->slot && std::holds_alternative<std::string*>(any_slot(*c.option))};
        }
    return best;
  }

  Column column_named(const std::string& name, const Place& at) {
    std::optional<Column> best = known_column(name, false);
    if (!best) best = known_column(name, true);
    std::vector<std::string> known;
    for (const UnitTableForm::Column& c : form_.columns)
      if (std::find(known.begin(), known.end(), c.option->key) == known.end()) known.emplace_back(c.key);
    if (!best && form_.as_written) return {nullptr, ""};
    const std::string near = nearest_word(name, known);
    if (!best && form_.others && near.empty() && is_word(name)) return {nullptr, ""};
    if (!best)
      at.refuse(fmt::format("unknown column \"{}\"", name.substr(0, 60)),
                fmt::format("{}columns: {}, each with its unit, e.g. \"{}\"",
                            near.empty() ? "" : fmt::format("did you mean {}? ", near), fmt::join(known, ", "),
                            form_.example));
    const bool plain = best->text || best->option->dimension == dimension::kNumber;
    if (best->unit.empty() && !plain && best->option->dimension != dimension::kSlope)
      at.refuse(fmt::format("the column \"{}\" has no unit", name),
                fmt::format("write it into the column's name: {}", describe(best->option->dimension)));
    if (!best->text) unit_check(*best, at);
    return *best;
  }

  void read_names(const std::string& line, const Place& at) {
    separator_ = separator_of(line);
    table_.line = at.line;
    for (const std::string& name : cells_of(line, separator_)) {
      columns_.push_back(column_named(name, at));
      if (!columns_.back().option) {
        table_.ignored.push_back(name);
        continue;
      }
      table_.names.push_back(name);
      for (std::size_t k = 0; k + 1 < columns_.size(); ++k)
        if (columns_[k].option == columns_.back().option)
          at.refuse(fmt::format("two columns are {}", columns_.back().option->key), "keep one of them");
    }
    for (const auto& rivals : form_.rivals) {
      std::vector<std::string_view> given;
      for (const Column& c : columns_)
        if (c.option && std::find(rivals.begin(), rivals.end(), c.option->key) != rivals.end())
          given.push_back(c.option->key);
      if (given.size() > 1)
        at.refuse(fmt::format("the table has {}: {} has one of them", fmt::join(given, " and "), form_.what),
                  "keep one of them");
    }
    for (const Column& c : columns_)
      if (c.option) table_.columns.push_back(c.option);
    if (table_.columns.empty() && !form_.as_written)
      at.refuse(fmt::format("no column of {} among {}", form_.what, fmt::join(table_.ignored, ", ")),
                fmt::format("name the columns as in \"{}\"", form_.example));
  }

  const UnitTableForm& form_;
  std::vector<Column> columns_;
  UnitTable table_;
  char separator_ = ',';
  bool decimal_commas_ = false;
  bool lifted_ = false;  ///< the wheel of the row
  std::optional<Thousands> thousands_;
};

}  // namespace

void refuse_in_table(const std::filesystem::path& file, int line, const std::string& what, const std::string& remedy) {
  throw CaseError(printable(what), remedy, fmt::format("{}:{}", file.string(), line));
}

bool UnitTable::has(std::string_view key) const {
  return std::any_of(columns.begin(), columns.end(), [&](const Option* o) { return o->key == key; });
}

bool names_column(std::string_view name, std::string_view key) {
  return unit_after(std::string(name), key, true).has_value();
}

bool is_comment(std::string_view line) {
  const std::string_view text = trimmed(line, " \t\r\"");
  return text.starts_with('#') && !is_spreadsheet_error(trimmed(text.substr(0, text.find_first_of(";\t,\""))));
}

std::vector<std::string> column_names(const std::string& text) {
  std::vector<std::string> out;
  for_each_line(text, [&](const std::string& line, int) {
    if (out.empty()) out = cells_of(line, separator_of(line));
  });
  return out;
}

UnitTable read_unit_table(const std::string& text, const std::filesystem::path& file, const UnitTableForm& form) {
  TableReader reader(form);
  int number = 0;
  for_each_line(text, [&](const std::string& line, int at) {
    number = at;
    reader.read_line(line, {file, at});
  });
  UnitTable table = std::move(reader).table();
  if (table.rows.empty())
    refuse_in_table(file, std::max(number, 1), "the table has no rows",
                    fmt::format("write a line of column names, e.g. \"{}\", then a line for each row", form.example));
  return table;
}

}  // namespace railstrata
