#pragma once
// Tables of TOML files other than cases: texts, numbers, flags and lists by their keys, with faults at their places.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "text/case_source.hpp"
#include "text/toml_document.hpp"

namespace railstrata {

/// Reads the keys of a table; a key that is not known, or a value of another kind, is an error at its place.
class TomlReader {
 public:
  /// example: the remedy for a key that is not known.
  TomlReader(CaseSource& source, const toml::table& t, std::vector<std::string> known, const char* example)
      : source_(source), table_(t) {
    for (const auto& [key, node] : t)
      if (std::find(known.begin(), known.end(), std::string(key.str())) == known.end())
        source_.complain_at(place_of(node), fmt::format("unknown key {}", key.str()), example);
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
  bool flag(const char* key, bool otherwise = false) {
    const toml::node* n = table_.get(key);
    if (n && n->is_boolean()) return n->as_boolean()->get();
    if (n)
      source_.complain_at(place_of(*n), fmt::format("{} must be true or false", key),
                          fmt::format("write {} = true, without quotes", key));
    return otherwise;
  }
  std::vector<std::string> texts(const char* key) { return texts_of(table_.get(key)); }
  std::map<std::string, std::vector<std::string>> lists(const char* key) {
    std::map<std::string, std::vector<std::string>> out;
    if (const toml::table* t = table_[key].as_table())
      for (const auto& [name, node] : *t) out[std::string(name.str())] = texts_of(&node);
    return out;
  }
  void choice(const char* key, const std::string& value, const std::vector<std::string>& choices) {
    if (std::find(choices.begin(), choices.end(), value) == choices.end())
      source_.complain_at(table_.contains(key) ? place_of(*table_.get(key)) : place_of(table_),
                          fmt::format("{} = \"{}\" is unknown", key, value),
                          fmt::format("one of: {}", fmt::join(choices, ", ")));
  }

 private:
  static std::vector<std::string> texts_of(const toml::node* n) {
    std::vector<std::string> out;
    if (!n || !n->is_array()) return out;
    for (const toml::node& item : *n->as_array()) {
      if (item.is_string())
        out.push_back(item.as_string()->get());
      else if (item.is_number())
        out.push_back(fmt::format("{}", number_of(item)));
    }
    return out;
  }
  CaseSource& source_;
  const toml::table& table_;
};

/// The tables of an array of tables.
inline std::vector<const toml::table*> tables(const toml::table& t, const char* key) {
  std::vector<const toml::table*> out;
  if (const toml::array* list = t[key].as_array())
    for (const toml::node& n : *list)
      if (n.is_table()) out.push_back(n.as_table());
  return out;
}

}  // namespace railstrata
