#pragma once
// TOML as the readers of cases, studies and validation sets take it: within bounds, with places, with the whole values
// of its numbers.
#include <toml++/toml.h>
#include <optional>
#include <string>
#include <string_view>

#include "text/case_source.hpp"

namespace railstrata {

inline TextPlace place_of(const toml::source_region& region) {
  return {static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}
inline TextPlace place_of(const toml::node& node) { return place_of(node.source()); }
inline TextPlace place_of(const toml::key& key) { return place_of(key.source()); }

/// Dots of a key: it has two or three. toml++ limits nested brackets, to 256, and not dotted keys.
inline constexpr std::ptrdiff_t kMostDots = 100;

/// Where a text has the first key of more dots than that, those of the keys around it in brackets included. Dots of
/// texts, comments and of the numbers of a list do not add up.
std::optional<TextPlace> deep_key(std::string_view text);

/// The value of a node that is a number, of whole numbers the nearest double (toml++ itself gives nothing for those
/// that no double holds).
double number_of(const toml::node& number);

/// The text of the source as a document. Throws CaseError where it is not TOML, or has a key with more dots than any
/// needs: tables nested so deeply are beyond the stack.
toml::table toml_document(CaseSource& source);

}  // namespace railstrata
