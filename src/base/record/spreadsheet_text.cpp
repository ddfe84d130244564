#include "record/spreadsheet_text.hpp"

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

}  // namespace railstrata
