#include "ask/case_number.hpp"

#include <fmt/format.h>

#include <limits>
#include <variant>
#include <vector>

#include "core/faults.hpp"
#include "core/nearest_word.hpp"
#include "options/find_key.hpp"

namespace railstrata {
namespace {

[[noreturn]] void refuse_key(const std::string& key) {
  std::vector<std::string> keys;
  for (const OptionTable& table : case_tables())
    for (const Option& option : table.options)
      keys.push_back(fmt::format("{}.{}{}", table.name, table.repeated ? "0." : "", option.key));
  const std::string near = nearest_word(key, keys);
  throw CaseError(fmt::format("{} is no key of a case", key),
                  near.empty() ? "give a key of docs/case-reference.md, as \"material.rail.young\""
                               : fmt::format("did you mean {}?", near));
}

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double number_at(const std::string& key, const Slot& slot) {
  if (const auto* number = std::get_if<double*>(&slot)) return **number;
  if (const auto* number = std::get_if<std::optional<double>*>(&slot)) return (*number)->value_or(kNone);
  if (const auto* number = std::get_if<int*>(&slot)) return **number;
  if (const auto* on = std::get_if<bool*>(&slot)) return **on ? 1 : 0;
  throw CaseError(fmt::format("{} is not a single number", key), "ask for a key that is one");
}

/// The key in whose place a second word for it writes.
std::string first_word(const OptionTable& table, const Option& derived) {
  const Slot place = any_slot(derived);
  for (const Option& option : table.options)
    if (!option.derivation && option.slot && any_slot(option) == place) return std::string(option.key);
  return "another key";
}

}  // namespace

double number_of_case(const CaseSpec& spec, const std::string& key) {
  const auto [table, option, given] = find_key(key);
  if (!option || !option->slot || given.has_value() != static_cast<bool>(table->repeated)) refuse_key(key);
  const std::size_t index = given.value_or(0);
  if (table->repeated && index >= table->repeated.count(spec))
    throw CaseError(fmt::format("{}: the case has {} of them", key, table->repeated.count(spec)),
                    "give the number of one, from 0 on");
  if (option->derivation)
    throw CaseError(fmt::format("{} is a second way of giving another key", key),
                    fmt::format("ask for {}", first_word(*table, *option)));
  if (option->applies && !option->applies(spec, index)) return kNone;
  return number_at(key, option->slot(const_cast<CaseSpec&>(spec), index));  // only read
}

}  // namespace railstrata
