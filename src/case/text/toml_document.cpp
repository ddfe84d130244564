#include "text/toml_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace railstrata {
namespace {

/// Length of a text in triple quotes, which may span lines and end with up to two quotes of its own; without a closing
/// mark, all the rest.
std::size_t length_of_long_text(std::string_view rest, std::string_view quotes) {
  for (std::size_t i = quotes.size(); i < rest.size(); ++i) {
    if (rest[i] == '\\' && quotes[0] == '"') {
      ++i;
    } else if (rest.substr(i).starts_with(quotes)) {
      const std::size_t end = std::min(rest.find_first_not_of(quotes[0], i), rest.size());
      return std::min(end, i + quotes.size() + 2);
    }
  }
  return rest.size();
}

/// The length of a comment or of a text in quotes with its quotes, else 0. An open text ends with its line: beyond,
/// this is no TOML.
std::size_t length_of_words(std::string_view rest) {
  if (rest[0] == '#') return std::min(rest.find('\n'), rest.size());
  if (rest[0] != '"' && rest[0] != '\'') return 0;
  for (const std::string_view quotes : {std::string_view(R"(""")"), std::string_view("'''")})
    if (rest.starts_with(quotes)) return length_of_long_text(rest, quotes);
  for (std::size_t i = 1; i < rest.size() && rest[i] != '\n'; ++i) {
    if (rest[i] == rest[0]) return i + 1;
    if (rest[i] == '\\' && rest[0] == '"') ++i;
  }
  return std::min(rest.find('\n'), rest.size());
}

}  // namespace

std::optional<TextPlace> deep_key(std::string_view text) {
  std::vector<std::ptrdiff_t> outside{0};  // dots of the keys around each open bracket
  std::ptrdiff_t dots = 0;
  int line = 1;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (const std::size_t words = length_of_words(text.substr(at)); words > 0) {
      line += static_cast<int>(std::count(text.begin() + at, text.begin() + at + words, '\n'));
      at += words - 1;
      continue;
    }
    const char c = text[at];
    if (c == '.' && ++dots > kMostDots) return TextPlace{line, 1};
    if (c == '[' || c == '{') outside.push_back(dots);
    if (c == ',' || c == '\n' || c == ']' || c == '}') dots = outside.back();
    if ((c == ']' || c == '}') && outside.size() > 1) outside.pop_back();
    if (c == '\n') ++line;
  }
  return {};
}

double number_of(const toml::node& number) {
  if (const auto* whole = number.as_integer()) return static_cast<double>(whole->get());
  return number.as_floating_point()->get();
}

toml::table toml_document(CaseSource& source) {
  if (const auto place = deep_key(source.text())) {
    source.complain_at(*place, fmt::format("a key on this line has more than {} dots", kMostDots),
                       "a key has a few parts: table.key");
    source.finish();
  }
  try {
    return toml::parse(std::string_view(source.text()));
  } catch (const toml::parse_error& e) {
    source.complain_at(place_of(e.source()), fmt::format("this is not TOML: {}", e.description()),
                       "texts stand in quotes, tables in [brackets], one key = value a line");
  }
  source.finish();
  return {};
}

}  // namespace railstrata
