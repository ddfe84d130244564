#include "explore/case_values.hpp"

#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <variant>

#include "options/option_table.hpp"

namespace railstrata {
namespace {

std::optional<double> number_in(const Slot& slot) {
  if (const auto* number = std::get_if<double*>(&slot)) return **number;
  if (const auto* maybe = std::get_if<std::optional<double>*>(&slot)) return **maybe;
  return std::nullopt;
}

/// The value as a case file would have it; every derivation is linear.
double written(const Option& option, const CaseSpec& spec, std::size_t index, double value) {
  if (!option.derivation) return value;
  const double at_zero = option.derivation.value(spec, index, 0),
               slope = option.derivation.value(spec, index, 1) - at_zero;
  return (value - at_zero) / slope;
}

std::optional<double> value_of(CaseSpec spec, std::string_view key) {
  const std::size_t last = key.rfind('.');
  if (last == std::string_view::npos) return std::nullopt;
  std::string_view name = key.substr(0, last);
  std::size_t index = 0;
  const OptionTable* table = find_table(name);
  if (const std::size_t dot = name.rfind('.'); !table && dot != std::string_view::npos) {
    const std::string_view digits = name.substr(dot + 1);
    if (std::from_chars(digits.data(), digits.data() + digits.size(), index).ptr != digits.data() + digits.size())
      return std::nullopt;
    table = find_table(name.substr(0, dot));
    if (!table || !table->repeated) return std::nullopt;
  }
  if (!table || (table->repeated && index >= table->repeated.count(spec))) return std::nullopt;
  for (const Option& option : table->options)
    if (option.key == key.substr(last + 1))
      if (const std::optional<double> value = number_in(option.slot(spec, index)))
        return written(option, spec, index, *value);
  return std::nullopt;
}

}  // namespace

nlohmann::ordered_json case_values(const CaseSpec& spec, const std::vector<std::string>& keys) {
  nlohmann::ordered_json out = nlohmann::ordered_json::object();
  for (const std::string& key : keys) {
    const std::optional<double> value = value_of(spec, key);
    out[key] = value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
  }
  return out;
}

}  // namespace railstrata
