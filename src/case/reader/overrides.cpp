#include "reader/overrides.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

#include "reader/value_reader.hpp"

namespace railstrata {
namespace {

[[noreturn]] void refuse_override(const std::string& text, const std::string& why) {
  throw CaseError(
      fmt::format("--set {}: {}", text, why),
      "write --set table.key=value, e.g. --set mesh.element_size=\"2 mm\" or --set layer.0.thickness=\"0.5 mm\"");
}

/// The option that the parts of a key name: "layer.0.young", "run.positions", and what is inside a list
/// ("run.positions.0").
struct NamedOption {
  const Option* option = nullptr;  ///< null: no option
  std::size_t parts = 0;           ///< of the key up to the option
};
NamedOption named_option(const std::vector<std::string>& parts) {
  for (const std::size_t of_name : {std::size_t{1}, std::size_t{2}}) {
    if (parts.size() <= of_name) break;
    const OptionTable* table = find_table(of_name == 1 ? parts[0] : parts[0] + "." + parts[1]);
    const std::size_t at = of_name + (table && table->repeated ? 1 : 0);
    if (!table || at >= parts.size()) continue;
    for (const Option& option : table->options)
      if (option.key == parts[at]) return {&option, at + 1};
  }
  return {};
}

bool is_text(const Option& option) {
  const Slot slot = any_slot(option);
  return std::holds_alternative<std::string*>(slot) || std::holds_alternative<ChoiceSlot>(slot);
}

/// A key that goes on inside an option: a list is set as a whole, everything else has no inside.
[[noreturn]] void refuse_inside(const Option& option, const std::vector<std::string>& parts, std::size_t count,
                                const std::string& text) {
  const std::string key = fmt::format("{}", fmt::join(parts.begin(), parts.begin() + static_cast<long>(count), "."));
  const Slot slot = any_slot(option);
  const bool table = std::holds_alternative<RowsSlot>(slot);
  if (!table && !std::holds_alternative<std::vector<double>*>(slot))
    refuse_override(text, fmt::format("{} is not a table", key));
  throw CaseError(fmt::format("--set {}: {} is one list, its values have no keys of their own", text, key),
                  fmt::format("give the whole list, e.g. --set {}='{}'", key, example_of(option)));
}

/// TOML where it is TOML, else a text: quotes may be left out. Of an option that is a text the words are the text, also
/// where they would be a number (60E1).
toml::table parse_override_value(const std::string& text, const std::string& value, bool words) {
  try {
    toml::table table = toml::parse("value = " + value);
    if (words && table.size() == 1 && !table.get("value")->is_string())
      return toml::parse("value = " + toml_quoted(value));
    if (table.size() == 1) return table;
  } catch (const toml::parse_error&) {
    try {
      return toml::parse("value = " + toml_quoted(value));
    } catch (const toml::parse_error&) {
    }
  }
  refuse_override(text, "is not one value in UTF-8");
}

bool is_repeated(const std::string& name) {
  const OptionTable* table = find_table(name);
  return table && table->repeated;
}

/// The entry of a list of tables that an override names; one more than there are adds it.
toml::table& entry_of(toml::array& list, const std::string& name, const std::string& word, const std::string& text,
                      CaseSource& source) {
  constexpr std::size_t kMostDigits = 5;
  const bool digits =
      !word.empty() && word.size() <= kMostDigits && word.find_first_not_of("0123456789") == std::string::npos;
  const std::size_t index = digits ? std::stoul(word) : list.size() + 1;
  const bool may_grow = is_repeated(name);
  if (may_grow && index == list.size()) {
    list.push_back(toml::table{});
    source.remember_origin(fmt::format("{}.{}", name, index), "--set " + text);
  }
  if (index < list.size() && list[index].is_table()) return *list[index].as_table();
  refuse_override(text,
                  fmt::format("{} has {} entr{}, counted from 0{}", name, list.size(), list.size() == 1 ? "y" : "ies",
                              may_grow ? fmt::format("; {}.{} adds one", name, list.size()) : ""));
}

/// The table named by the parts before the last, made where it is missing.
toml::table& descend(toml::table& document, const std::vector<std::string>& parts, const std::string& text,
                     CaseSource& source) {
  toml::table* table = &document;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    if (!table->contains(parts[i])) {
      if (i == 0 && is_repeated(parts[i]))
        table->insert(parts[i], toml::array{});
      else
        table->insert(parts[i], toml::table{});
    }
    toml::node& node = *table->get(parts[i]);
    if (toml::array* list = node.as_array()) {
      table = &entry_of(*list, parts[i], i + 2 < parts.size() ? parts[i + 1] : "", text, source);
      ++i;
    } else if (node.is_table()) {
      table = node.as_table();
    } else {
      refuse_override(text, fmt::format("{} is not a table", parts[i]));
    }
  }
  return *table;
}

/// An override removes the file's other keys for the same quantity; two overrides of one quantity contradict each
/// other.
void remove_rivals(toml::table& table, const std::vector<std::string>& parts, const CaseSource& source) {
  const std::string& key = parts.back();
  const std::string name = fmt::format("{}", fmt::join(parts.begin(), parts.end() - 1, "."));
  const OptionTable* options = find_table(is_repeated(parts.front()) ? parts.front() : name);
  if (!options) return;
  for (const auto& rivals : options->rivals) {
    if (std::find(rivals.begin(), rivals.end(), key) == rivals.end()) continue;
    for (const std::string_view rival : rivals)
      if (rival != key && !source.has_origin(fmt::format("{}.{}", name, rival))) table.erase(rival);
  }
}

}  // namespace

void apply_override(toml::table& document, const std::string& text, CaseSource& source) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0) refuse_override(text, "is not key=value");
  const std::string key = text.substr(0, equals), written = text.substr(equals + 1);
  if (std::count(key.begin(), key.end(), '.') > kMostDots || deep_key("value = " + written))
    refuse_override(text.substr(0, 60) + "...", fmt::format("has a key of more than {} parts", kMostDots));
  std::vector<std::string> parts;
  std::istringstream stream(key);
  for (std::string part; std::getline(stream, part, '.');) parts.push_back(part);
  const NamedOption named = named_option(parts);
  if (named.option && named.parts < parts.size()) refuse_inside(*named.option, parts, named.parts, text);
  toml::table value = parse_override_value(text, written, named.option && is_text(*named.option));
  const bool whole_list = parts.size() == 1 && is_repeated(parts[0]);
  if (parts.size() < 2 && !whole_list) refuse_override(text, "names no table");
  toml::table& table = descend(document, parts, text, source);
  value.get("value")->visit([&](auto& node) { table.insert_or_assign(toml::key(parts.back()), node); });
  remove_rivals(table, parts, source);
  source.remember_origin(key, "--set " + text);
}

}  // namespace railstrata
