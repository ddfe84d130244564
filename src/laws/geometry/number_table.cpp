#include "geometry/number_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/faults.hpp"
#include "core/text.hpp"

namespace railstrata {
namespace {

struct Line {
  int number = 0;
  std::string text;
};

constexpr const char* kBlank = " \t\r\f\v";

bool looks_numeric(const std::string& text) {
  return !text.empty() && std::string("0123456789+-.").find(text.front()) != std::string::npos;
}

std::vector<Line> split_lines(std::string_view all, std::string& comments) {
  if (all.starts_with("\xEF\xBB\xBF")) all.remove_prefix(3);
  std::vector<Line> lines;
  bool rows_begun = false;
  for (int number = 1; !all.empty(); ++number) {
    const std::size_t length = std::min(all.find('\n'), all.size());
    const std::string text = plain_signs(all.substr(0, length));
    all.remove_prefix(std::min(length + 1, all.size()));
    const std::size_t comment = text.find_first_of("#%!\"");
    if (comment != std::string::npos && !rows_begun) comments += text.substr(comment) + '\n';
    const std::string content(trimmed(text.substr(0, comment)));
    rows_begun = rows_begun || looks_numeric(content);
    if (!content.empty()) lines.push_back({number, content});
  }
  return lines;
}

/// "1,5 2": a number with a comma, blanks, another number. (A std::regex would take a stack frame for each character of
/// the line.)
bool two_with_blanks(std::string_view text) {
  const auto skip = [&](const char* characters) {
    const std::size_t n = std::min(text.find_first_not_of(characters), text.size());
    text.remove_prefix(n);
    return n;
  };
  const auto take = [&](const char* one_of) {
    const bool there = !text.empty() && std::string_view(one_of).find(text.front()) != std::string_view::npos;
    if (there) text.remove_prefix(1);
    return there;
  };
  constexpr const char* kDigits = "0123456789";
  take("+-");
  skip(kDigits);
  if (!take(",") || skip(kDigits) == 0) return false;
  if (take("eE") && (take("+-"), skip(kDigits) == 0)) return false;
  if (skip(kBlank) == 0) return false;
  take("+-");
  return take(kDigits);
}

/// A row of points that a stray letter spoils, not a heading: digits in every word, and one that is a number.
bool is_spoiled_row(const std::vector<std::string>& words) {
  const auto has_digit = [](const std::string& word) { return word.find_first_of("0123456789") != std::string::npos; };
  return words.size() > 1 && std::all_of(words.begin(), words.end(), has_digit) &&
         std::any_of(words.begin(), words.end(), [](const std::string& word) { return number_of(word).has_value(); });
}

/// Commas are decimal when something else separates the columns and no point occurs.
bool commas_are_decimal(const std::vector<Line>& lines) {
  for (const Line& line : lines) {
    if (!looks_numeric(line.text) || line.text.find(',') == std::string::npos) continue;
    if (line.text.find('.') != std::string::npos) return false;
    return line.text.find_first_of(";\t") != std::string::npos || two_with_blanks(line.text);
  }
  return false;
}

}  // namespace

std::vector<std::string> split_words(std::string_view line) {
  std::vector<std::string> out;
  constexpr const char* separators = " \t\r\f\v;,";
  for (std::size_t begin = line.find_first_not_of(separators); begin != std::string_view::npos;) {
    const std::size_t end = line.find_first_of(separators, begin);
    out.emplace_back(line.substr(begin, end - begin));
    begin = end == std::string_view::npos ? end : line.find_first_not_of(separators, end);
  }
  return out;
}

std::optional<double> number_of(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  std::string fortran;
  if (const std::size_t d = word.find_first_of("dD"); d != std::string_view::npos && d > 0) {
    fortran = word;
    fortran[d] = 'e';
    word = fortran;
  }
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

NumberTable parse_number_table(std::string_view all, const std::string& name) {
  NumberTable table;
  const std::vector<Line> lines = split_lines(all, table.heading);
  table.decimal_commas = commas_are_decimal(lines);
  for (const Line& line : lines) {
    const std::string where = fmt::format("{}:{}", name, line.number);
    std::string text = line.text;
    if (table.decimal_commas) std::replace(text.begin(), text.end(), ',', '.');
    const std::vector<std::string> words = split_words(text);
    double y = 0, z = 0;
    const auto read = [&](std::size_t column, double& value) {
      const std::optional<double> number = column < words.size() ? number_of(words[column]) : std::nullopt;
      value = number.value_or(0);
      return number.has_value();
    };
    const bool has_y = read(0, y), has_z = read(1, z);
    if (!std::isfinite(y) || !std::isfinite(z))
      throw CaseError("'" + line.text + "' is not a finite number", "remove or repair the point", where);
    if (has_y && has_z) {
      if (!table.rows.empty() && words.size() != table.columns)
        throw CaseError(
            fmt::format("'{}' has {} numbers, the lines before it {}", line.text, words.size(), table.columns),
            "give every point as many columns; mark comments with #", where);
      table.rows.push_back({y, z});
      table.lines.push_back(line.number);
      table.columns = words.size();
    } else if (table.rows.empty() && !is_spoiled_row(words) && (!looks_numeric(line.text) || words.size() == 1)) {
      table.heading += line.text + '\n';
      ++table.skipped;
    } else {
      throw CaseError("'" + line.text + "' is not two numbers", "give two columns, y and z; mark comments with #",
                      where);
    }
  }
  return table;
}

}  // namespace railstrata
