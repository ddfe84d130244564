#include "bridge/records.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "core/text.hpp"
#include "many/axis.hpp"
#include "options/option_table.hpp"
#include "record/json.hpp"

namespace railstrata::bridge {
namespace {

std::string text_inside(const std::string& key, const Option* option, const Json& value);

/// The option of a row's k-th number or of the number of this name; null: another thing than a row.
const Option* column(const Option* option, std::size_t k, const std::string& name) {
  if (!option || option->columns.empty()) return option;
  for (std::size_t c = 0; c < option->columns.size(); ++c)
    if (name.empty() ? c == k : option->columns[c].key == name) return &option->columns[c];
  return nullptr;
}

std::string list_text(const std::string& key, const Option* option, const Json& list) {
  std::vector<std::string> out;
  for (std::size_t k = 0; k < list.size(); ++k)
    out.push_back(
        text_inside(fmt::format("{}.{}", key, k), list[k].is_structured() ? option : column(option, k, {}), list[k]));
  return fmt::format("[{}]", fmt::join(out, ", "));
}

std::string table_text(const std::string& key, const Option* option, const Json& table) {
  std::vector<std::string> out;
  for (const auto& [name, value] : table.items()) {
    const std::string inside = fmt::format("{}.{}", key, name);
    out.push_back(fmt::format("{} = {}", name,
                              text_inside(inside, option ? column(option, 0, name) : option_of_key(inside), value)));
  }
  return fmt::format("{{{}}}", fmt::join(out, ", "));
}

bool has_unit(const Option* option) { return option && !si_unit(option->dimension).empty(); }

std::string text_inside(const std::string& key, const Option* option, const Json& value) {
  if (value.is_string()) return toml_quoted(value.get<std::string>());
  if (value.is_array()) return list_text(key, option, value);
  if (value.is_object()) return table_text(key, option, value);
  if (value.is_number() && has_unit(option))
    return toml_quoted(format_quantity(value.get<double>(), option->dimension));
  return json_text(value);
}

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// A force that is written as a mass.
Json weight(const std::string& text) {
  try {
    return finite(kGravity * parse_quantity(text, dimension::kMass));
  } catch (const UnitError&) {
    return nullptr;
  }
}

}  // namespace

std::string value_text(const std::string& key, const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  const Option* option = option_of_key(axis_key(key));
  if (value.is_number() && has_unit(option)) return format_quantity(value.get<double>(), option->dimension);
  return text_inside(key, option, value);
}

std::vector<std::string> overrides_of(const Json& changes) {
  std::vector<std::string> out;
  for (const Json& one : changes) {
    if (one.is_string())
      out.push_back(one.get<std::string>());
    else
      out.push_back(
          fmt::format("{}={}", one.at(0).get<std::string>(), value_text(one.at(0).get<std::string>(), one.at(1))));
  }
  return out;
}

Json si_value(const std::string& key, const std::string& text) {
  const std::string words(trimmed(text, " \t\"'"));
  const Option* option = option_of_key(key);
  if (!option || !option->slot) return text;
  const Slot slot = any_slot(*option);
  if (std::holds_alternative<double*>(slot) || std::holds_alternative<std::optional<double>*>(slot)) try {
      return finite(parse_quantity(words, option->dimension));
    } catch (const UnitError&) {
      return option->takes_mass ? weight(words) : Json(nullptr);
    }
  const Json read = Json::parse(words, nullptr, false);
  const bool plain = std::holds_alternative<int*>(slot) ? read.is_number() : read.is_boolean();
  return plain ? read : Json(text);
}

}  // namespace railstrata::bridge
