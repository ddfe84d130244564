#include "record/escaped_text.hpp"

#include <charconv>

namespace railstrata {
namespace {

/// "-5 mm", "+0.3", "-1e-3", "-1:40": nothing that is computed.
bool is_quantity(const std::string& text) {
  const char *begin = text.data() + 1, *end = text.data() + text.size();
  double value = 0;
  const auto [next, error] = std::from_chars(begin, end, value);
  return error == std::errc{} && std::string(next, end).find_first_of("=+-*/^|!&(@\"';,\t\r\n") == std::string::npos;
}

}  // namespace

std::string without_formula(const std::string& text) {
  const char first = text.empty() ? ' ' : text.front();
  const bool signs = first == '+' || first == '-';
  if (first == '=' || first == '@' || first == '\t' || first == '\r' || (signs && !is_quantity(text)))
    return "'" + text;
  return text;
}

std::string markup_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

std::string shell_word(const std::string& word) {
  constexpr const char* kSafe = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-./+=:,@%";
  if (!word.empty() && word.find_first_not_of(kSafe) == std::string::npos) return word;
  std::string out = "'";
  for (char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace railstrata
