#include "options/option_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "options/option_slots.hpp"
#include "record/unit.hpp"

namespace railstrata {
namespace {

using namespace dimension;

Slot title(CaseSpec& spec, std::size_t) { return &spec.title; }

std::string quantity(double value, const Dimension& dimension) {
  const std::string text = format_quantity(value, dimension);
  if (!(dimension == kNumber || dimension == kSlope)) return '"' + text + '"';
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string_view word_of(const Option& option, const ChoiceSlot& slot) {
  const auto found =
      std::find_if(option.choices.begin(), option.choices.end(), [&](const Choice& c) { return c.value == *slot; });
  assert(found != option.choices.end());
  return found->word;
}

}  // namespace

const std::vector<OptionTable>& case_tables() {
  static const std::vector<OptionTable> tables{
      {"case", "Title of the case", {option_slot::option("title", title, "One line shown in reports")}},
      geometry_table(),
      rail_material_table(),
      wheel_material_table(),
      layer_table(),
      stretch_table(),
      irregularity_table(),
      vehicle_table(),
      track_table(),
      drive_table(),
      friction_table(),
      third_body_table(),
      mesh_table(),
      run_table(),
      bem_table(),
      transient_table(),
      curve_table(),
      bogie_table(),
      load_table(),
      collective_table(),
      life_table(),
      grinding_table(),
      passes_table(),
      crack_table(),
      output_table()};
  return tables;
}

const OptionTable* find_table(std::string_view name) {
  for (const OptionTable& t : case_tables())
    if (t.name == name) return &t;
  return nullptr;
}

CaseSpec one_of_each() {
  CaseSpec spec;
  for (const OptionTable& table : case_tables())
    if (table.repeated) table.repeated.resize(spec, 1);
  return spec;
}

Slot any_slot(const Option& option) {
  static CaseSpec spec = one_of_each();
  return option.slot(spec, 0);
}

std::vector<std::string> choices_of(const Option& option) {
  std::vector<std::string> out;
  for (const Choice& c : option.choices) out.emplace_back(c.word);
  return out;
}

std::string toml_quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      (out += '\\') += c;
    else if (byte < 0x20 || byte == 0x7F)
      out += fmt::format("\\u{:04X}", byte);
    else
      out += c;
  }
  return out + '"';
}

std::string toml_value(const Option& option, CaseSpec& spec, std::size_t index) {
  struct Writer {
    const Option& option;
    std::string operator()(const double* v) const { return quantity(*v, option.dimension); }
    std::string operator()(const std::optional<double>* v) const {
      return *v ? quantity(**v, option.dimension) : std::string();
    }
    std::string operator()(const int* v) const { return fmt::format("{}", *v); }
    std::string operator()(const bool* v) const { return *v ? "true" : "false"; }
    std::string operator()(const std::string* v) const { return toml_quoted(*v); }
    std::string operator()(const ChoiceSlot& v) const { return toml_quoted(word_of(option, v)); }
    std::string operator()(const std::vector<double>* v) const {
      std::string out;
      if (v->empty()) return out;
      for (double x : *v) out += (out.empty() ? "" : ", ") + quantity(x, option.dimension);
      return "[" + out + "]";
    }
    std::string operator()(const RowsSlot& v) const {
      const bool named = has_named_columns(option.form);
      std::string out;
      for (const std::vector<double>& numbers : *v) {
        std::string row;
        for (std::size_t k = 0; k < numbers.size(); ++k)
          row += fmt::format("{}{}{}", k == 0 ? "" : ", ", named ? fmt::format("{} = ", option.columns.at(k).key) : "",
                             quantity(numbers[k], option.columns.at(k).dimension));
        out += fmt::format(fmt::runtime(named ? "{}{{ {} }}" : "{}[{}]"), out.empty() ? "" : ", ", row);
      }
      return out.empty() || option.form == RowForm::one_named ? out : "[" + out + "]";
    }
  };
  return std::visit(Writer{option}, option.slot(spec, index));
}

std::string describe(const Range& range, const Dimension& dimension) {
  const bool low = std::isfinite(range.min), high = std::isfinite(range.max);
  const auto show = [&](double v) { return format_quantity(v, dimension); };
  if (low && range.open)
    return fmt::format("above {}{}", show(range.min), high ? fmt::format(" and at most {}", show(range.max)) : "");
  if (low && high) return fmt::format("between {} and {}", show(range.min), show(range.max));
  if (low) return fmt::format("at least {}", show(range.min));
  return high ? fmt::format("at most {}", show(range.max)) : "";
}

}  // namespace railstrata
