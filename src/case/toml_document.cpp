#include "case/toml_document.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace railstrata {
namespace {

void refuse_deep_keys(CaseSource& source) {
  std::string_view rest = source.text();
  for (int line = 1; !rest.empty(); ++line) {
    const std::string_view text = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(text.size() + 1, rest.size()));
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos || text[first] == '#' || std::count(text.begin(), text.end(), '.') <= kMostDots)
      continue;
    source.complain_at({line, 1}, fmt::format("this line has more than {} dots", kMostDots),
                       "a key has a few parts: table.key; break a long list into lines");
    source.finish();
  }
}

}  // namespace

double number_of(const toml::node& number) {
  if (const auto* whole = number.as_integer()) return static_cast<double>(whole->get());
  return number.as_floating_point()->get();
}

toml::table toml_document(CaseSource& source) {
  refuse_deep_keys(source);
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
