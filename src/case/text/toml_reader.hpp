#pragma once
// Tables of TOML files other than cases: texts, numbers, flags and lists by their keys, with faults at their places.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/nearest_word.hpp"
#include "text/case_source.hpp"
#include "text/toml_document.hpp"
#include "text/units.hpp"

namespace railstrata {

/// Reads the keys of a table; a key that is not known, or a value of another kind, is an error at its place.
class TomlReader {
 public:
  /// remedy: for a key that is not known; name: of the table in messages, empty: none.
  TomlReader(CaseSource& source, const toml::table& t, const std::vector<std::string>& known, const std::string& remedy,
             const std::string& name = {})
      : source_(source), table_(t) {
    for (const auto& [key, node] : t) {
      const std::string word(key.str());
      if (std::find(known.begin(), known.end(), word) != known.end()) continue;
      const std::string near = nearest_word(word, known);
      source_.complain_at(place_of(key), fmt::format("unknown key {}{}{}", name, name.empty() ? "" : ".", word),
                          fmt::format("{}{}", near.empty() ? "" : fmt::format("did you mean {}? ", near), remedy));
    }
  }
  std::string text(const char* key, bool needed = false) {
    const toml::node* n = table_.get(key);
    if (n && n->is_string()) return n->as_string()->get();
    if (n || needed)
      source_.complain_at(n ? place_of(*n) : place_of(table_), fmt::format("{} must be a text", key),
                          fmt::format("write {} = \"…\"", key));
    return {};
  }
  std::string text_or(const char* key, const std::string& otherwise) {
    return table_.contains(key) ? text(key) : otherwise;
  }
  double number(const char* key, double otherwise, bool needed = false) {
    const toml::node* n = table_.get(key);
    if (n && n->is_number() && std::isfinite(number_of(*n))) return number_of(*n);
    if (n || needed)
      source_.complain_at(n ? place_of(*n) : place_of(table_), fmt::format("{} must be a finite number", key),
                          fmt::format("write {} = 1.5", key));
    return otherwise;
  }
  /// In SI; `otherwise` where the key is not there.
  double quantity(const char* key, const Dimension& dimension, double otherwise, bool needed = false) {
    const toml::node* n = table_.get(key);
    const std::string written = text(key, needed);
    if (!n || !n->is_string()) return otherwise;
    try {
      return parse_quantity(written, dimension);
    } catch (const UnitError& e) {
      source_.complain_at(place_of(*n), fmt::format("{} = \"{}\": {}", key, written, e.what()), e.remedy);
      return otherwise;
    }
  }
  bool flag(const char* key, bool otherwise = false) {
    const toml::node* n = table_.get(key);
    if (n && n->is_boolean()) return n->as_boolean()->get();
    if (n)
      source_.complain_at(place_of(*n), fmt::format("{} must be true or false", key),
                          fmt::format("write {} = true, without quotes", key));
    return otherwise;
  }
  std::vector<std::string> texts(const char* key) {
    std::vector<std::string> out;
    const toml::node* n = table_.get(key);
    if (!n) return out;
    const toml::array* list = n->as_array();
    if (list)
      for (const toml::node& item : *list)
        if (const auto* word = item.as_string()) out.push_back(word->get());
    if (!list || out.size() != list->size() || out.empty())
      source_.complain_at(place_of(*n), fmt::format("{} must be a list of texts", key),
                          fmt::format("write {} = [\"…\"]", key));
    return out;
  }
  void choice(const char* key, const std::string& value, const std::vector<std::string>& choices) {
    if (std::find(choices.begin(), choices.end(), value) == choices.end())
      source_.complain_at(table_.contains(key) ? place_of(*table_.get(key)) : place_of(table_),
                          fmt::format("{} = \"{}\" is unknown", key, value),
                          fmt::format("one of: {}", fmt::join(choices, ", ")));
  }

 private:
  CaseSource& source_;
  const toml::table& table_;
};

/// The tables of an array of tables.
inline std::vector<const toml::table*> tables(CaseSource& source, const toml::table& t, const char* key) {
  std::vector<const toml::table*> out;
  const toml::node* node = t.get(key);
  if (!node) return out;
  const toml::array* list = node->as_array();
  if (list)
    for (const toml::node& n : *list)
      if (n.is_table()) out.push_back(n.as_table());
  if (!list || out.size() != list->size())
    source.complain_at(place_of(*node), fmt::format("{} must be a list of tables", key),
                       fmt::format("write [[{}]] with two brackets", key));
  return out;
}

}  // namespace railstrata
