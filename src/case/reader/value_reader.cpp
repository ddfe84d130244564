#include "reader/value_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "core/nearest_word.hpp"
#include "text/toml_document.hpp"

namespace railstrata {
namespace {

std::string_view kind(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (node.is_array_of_tables()) return "a list of tables";
  if (node.is_array()) return "a list";
  if (node.is_string()) return "a text";
  if (node.is_boolean()) return "true or false";
  return node.is_number() ? "a number" : "a date or time";
}

/// "a depth and a modulus".
std::string columns_text(const Option& option) {
  std::string out;
  for (std::size_t k = 0; k < option.columns.size(); ++k)
    out += fmt::format("{}a {}", k == 0 ? "" : k + 1 == option.columns.size() ? " and " : ", ", option.columns[k].key);
  return out;
}

/// Description of an option's value, with an example.
std::string wanted(const Option& option) {
  struct Say {
    const Option& option;
    std::string operator()(const double*) const { return describe(option.dimension); }
    std::string operator()(const std::optional<double>*) const { return describe(option.dimension); }
    std::string operator()(const int*) const { return "a whole number"; }
    std::string operator()(const bool*) const { return "true or false"; }
    std::string operator()(const std::string*) const { return "a text in quotes"; }
    std::string operator()(const ChoiceSlot&) const {
      return fmt::format("one of \"{}\"", fmt::join(choices_of(option), "\", \""));
    }
    std::string operator()(const std::vector<double>*) const {
      return fmt::format("a list, e.g. {}", example_of(option));
    }
    std::string operator()(const RowsSlot&) const {
      const char* const what = !has_named_columns(option.form) ? "a table whose rows have"
                               : option.form == RowForm::named ? "a list of tables with"
                                                               : "a table with";
      return fmt::format("{} {}, e.g. {}", what, columns_text(option), example_of(option));
    }
  };
  return std::visit(Say{option}, any_slot(option));
}

void refuse_type(CaseSource& source, const WrittenValue& w) {
  source.complain(w.key,
                  fmt::format("{} = {}: is {}, must be {}", w.key, shown(w.node), kind(w.node), wanted(w.option)),
                  fmt::format("write {}", wanted(w.option)));
}

/// Suggests another unit where the value lies far from the range; a smaller miss is taken as meant.
std::string remedy_beyond(const Option& option, const std::string& quantity, double value) {
  constexpr double kClose = 3;
  const bool close = option.range.holds(kClose * value) || option.range.holds(value / kClose);
  const std::string instead =
      quantity.empty() || close
          ? ""
          : suggest_quantity(quantity, option.dimension, [&](double v) { return option.range.holds(v); });
  const std::string otherwise(option.beyond);
  if (instead.empty()) return otherwise.empty() ? "choose a value in this range" : otherwise;
  const std::string question = fmt::format("did you mean \"{}\"?", instead);
  return otherwise.empty() ? question : fmt::format("{} If not: {}", question, otherwise);
}

class ValueReader {
  static constexpr double kThinnestStep = 1e-6;  // m, of depth in a table by depth

 public:
  ValueReader(CaseSource& source, CaseSpec& spec) : source_(source), spec_(spec) {}

  void assign(const WrittenValue& w, double* target) { read_number(source_, w, *target); }

  void assign(const WrittenValue& w, std::optional<double>* target) {
    if (double value = 0; read_number(source_, w, value)) *target = value;
  }

  void assign(const WrittenValue& w, int* target) {
    const auto value = w.node.value_exact<int64_t>();
    if (!value) return refuse_type(source_, w);
    const auto number = static_cast<double>(*value);
    if (!w.option.range.holds(number)) return refuse_range(source_, w.option, w.key, shown(w.node), "", number);
    *target = static_cast<int>(*value);
  }

  template <class FlagOrText>
  void assign(const WrittenValue& w, FlagOrText* target) {
    const auto value = w.node.value_exact<FlagOrText>();
    if (!value) return refuse_type(source_, w);
    *target = *value;
  }

  void assign(const WrittenValue& w, const ChoiceSlot& target) {
    const auto value = w.node.value_exact<std::string>();
    if (!value) return refuse_type(source_, w);
    for (const Choice& c : w.option.choices)
      if (c.word == *value) return target.set(c.value);
    const std::string near = nearest_word(*value, choices_of(w.option));
    source_.complain(w.key, fmt::format("{} = \"{}\": must be {}", w.key, *value, wanted(w.option)),
                     near.empty()
                         ? fmt::format("write {} = \"{}\"", w.option.key, fmt::join(choices_of(w.option), "\" or \""))
                         : fmt::format("did you mean \"{}\"?", near));
  }

  void assign(const WrittenValue& w, std::vector<double>* target) {
    const toml::array* list = w.node.as_array();
    if (!list) return refuse_type(source_, w);
    std::vector<double> values;
    for (std::size_t i = 0; i < list->size(); ++i) {
      const std::string item = fmt::format("{}.{}", w.key, i);
      remember_place(source_, item, (*list)[i]);
      double value = 0;
      if (read_number(source_, {w.option, item, (*list)[i]}, value)) values.push_back(value);
    }
    if (list->empty())
      source_.complain(w.key, fmt::format("{} = []: needs at least one value", w.key),
                       fmt::format("write {}", wanted(w.option)));
    *target = values;
  }

  void assign(const WrittenValue& w, const RowsSlot& target) {
    RowsSlot::Rows rows;
    if (w.option.form == RowForm::one_named) {
      if (read_named(w.option, w.key, w.node, rows.emplace_back())) target.set(rows);
      return;
    }
    const toml::array* list = w.node.as_array();
    if (!list) return refuse_type(source_, w);
    const bool named = w.option.form == RowForm::named;
    bool sound = true;
    for (std::size_t i = 0; i < list->size(); ++i) {
      const std::string item = fmt::format("{}.{}", w.key, i);
      remember_place(source_, item, (*list)[i]);
      std::vector<double>& row = rows.emplace_back();
      sound &= named ? read_named(w.option, item, (*list)[i], row) : read_row(w.option, item, (*list)[i], row);
    }
    if (!sound || (!named && !fits(w.option, w.key, rows))) return;
    target.set(rows);
    if (w.option.key == "young_table") take_moduli(w.key, spec_.layers.at(w.index));
    if (w.option.key == "thickness_table") take_thickness(w.key, spec_.layers.at(w.index));
  }

  /// Numbers under the keys of the columns, every one.
  bool read_named(const Option& option, const std::string& item, const toml::node& written,
                  std::vector<double>& numbers) {
    if (!written.is_table()) {
      refuse_type(source_, {option, item, written});
      return false;
    }
    const toml::table& table = *written.as_table();
    bool sound = true;
    std::vector<std::string> keys;
    numbers.assign(option.columns.size(), 0.0);
    for (std::size_t k = 0; k < option.columns.size(); ++k) {
      const Option& column = option.columns[k];
      const std::string part = fmt::format("{}.{}", item, keys.emplace_back(column.key));
      const toml::node* node = table.get(column.key);
      if (node) remember_place(source_, part, *node);
      if (!node)
        source_.complain(item, fmt::format("{} has no {}", item, column.key), fmt::format("write {}", wanted(option)));
      sound &= node && read_number(source_, {column, part, *node}, numbers[k]);
    }
    for (const auto& [key, node] : table) {
      const std::string word(key.str());
      if (std::find(keys.begin(), keys.end(), word) != keys.end()) continue;
      const std::string near = nearest_word(word, keys), part = fmt::format("{}.{}", item, word);
      source_.remember(part, place_of(key.source()));
      source_.complain(
          part, fmt::format("unknown key {}", part),
          fmt::format("{}write {}", near.empty() ? "" : fmt::format("did you mean {}? ", near), wanted(option)));
      sound = false;
    }
    return sound;
  }

  /// A row of a table by depth.
  bool read_row(const Option& option, const std::string& item, const toml::node& row, std::vector<double>& numbers) {
    const std::size_t width = option.columns.size();
    numbers.assign(width, 0.0);
    const toml::array* written = row.as_array();
    if (!written || written->size() != width) {
      source_.complain(item, fmt::format("{}: must be {}", item, columns_text(option)),
                       fmt::format("write {}", wanted(option)));
      return false;
    }
    bool sound = true;
    for (std::size_t k = 0; k < width; ++k) {
      const std::string part = fmt::format("{}.{}", item, k);
      remember_place(source_, part, (*written)[k]);
      sound &= read_number(source_, {option.columns[k], part, (*written)[k]}, numbers[k]);
    }
    return sound;
  }

  /// Every range ends beyond its beginning, the next one begins beyond its end.
  bool fit_as_ranges(const std::string& key, const RowsSlot::Rows& rows) {
    double last = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (const double at : rows[i]) {
        if (!(at > last)) {
          source_.complain(fmt::format("{}.{}", key, i), fmt::format("{}: places must increase from row to row", key),
                           "write from and to of each, one after the other; join those that meet");
          return false;
        }
        last = at;
      }
    return true;
  }

  /// At least two rows, in order, by depth from 0 down.
  bool fits(const Option& option, const std::string& key, const RowsSlot::Rows& rows) {
    if (option.form == RowForm::ranges) return fit_as_ranges(key, rows);
    const auto refuse = [&](const std::string& at, const std::string& what, const std::string& remedy) {
      source_.complain(at, what, remedy);
      return false;
    };
    if (rows.size() < 2)
      return refuse(key, fmt::format("{}: needs at least two rows", key), fmt::format("write {}", wanted(option)));
    if (option.form == RowForm::by_depth && rows.front()[0] != 0)
      return refuse(key + ".0", fmt::format("{}: the first depth must be 0 mm, {}", key, option.columns[0].doc),
                    fmt::format("begin with the {} at the top", option.columns[1].key));
    for (std::size_t i = 1; i < rows.size(); ++i)
      if (!(rows[i][0] - rows[i - 1][0] >= kThinnestStep))
        return refuse(fmt::format("{}.{}", key, i),
                      fmt::format("{}: the {} must increase from row to row, by {} at least", key,
                                  option.columns[0].key, format_quantity(kThinnestStep, option.columns[0].dimension)),
                      option.form == RowForm::by_depth ? "sort the rows by depth; for a jump write two layers"
                                                       : "sort the rows; for a jump write two rows close together");
    return true;
  }

  static const Option& thickness_option() {
    const OptionTable& table = *find_table("layer");
    return *std::find_if(table.options.begin(), table.options.end(),
                         [](const Option& o) { return o.key == "thickness"; });
  }

  void take_thickness(const std::string& key, LayerSpec& layer) {
    const Option& thickness = thickness_option();
    layer.thickness = largest_value(layer.thickness_table);
    if (!thickness.range.holds(layer.thickness))
      source_.complain(
          key, fmt::format("{}: its largest thickness must be {}", key, describe(thickness.range, thickness.dimension)),
          std::string(thickness.beyond));
  }

  /// A graded layer takes its thickness and its mean stiffness from its table.
  void take_moduli(const std::string& key, LayerSpec& layer) {
    const std::vector<ModulusPoint>& rows = layer.young_table;
    const Option* thickness = &thickness_option();
    if (!thickness->range.holds(rows.back().depth))
      return source_.complain(fmt::format("{}.{}", key, rows.size() - 1),
                              fmt::format("{}: the last depth, the layer's thickness, must be {}", key,
                                          describe(thickness->range, thickness->dimension)),
                              std::string(thickness->beyond));
    double area = 0;
    for (std::size_t i = 1; i < rows.size(); ++i)
      area += 0.5 * (rows[i].young + rows[i - 1].young) * (rows[i].depth - rows[i - 1].depth);
    layer.thickness = rows.back().depth;
    layer.material.young = area / layer.thickness;
  }

 private:
  CaseSource& source_;
  CaseSpec& spec_;
};

}  // namespace

std::string shown(const toml::node& node) {
  std::string text;
  if (const auto* words = node.as_string())
    text = '"' + words->get() + '"';
  else if (const auto* number = node.as_floating_point())
    text = fmt::format("{}", number->get());
  else {
    std::ostringstream out;
    node.visit([&](const auto& n) { out << n; });
    text = out.str();
  }
  if (text.size() > 60) {
    text.resize(57);
    text += "...";
  }
  return text;
}

std::string_view example_of(const Option& option) {
  return option.example.empty() ? R"(["0.1 m", "0.3 m"])" : option.example;
}

void remember_place(CaseSource& source, const std::string& key, const toml::node& node) {
  if (const TextPlace place = place_of(node.source()); place.line > 0) source.remember(key, place);
}

void refuse_range(CaseSource& source, const Option& option, const std::string& key, const std::string& written,
                  const std::string& quantity, double value) {
  const std::string allowed = describe(option.range, option.dimension);
  source.complain(key, fmt::format("{} = {}: must be {}", key, written, allowed.empty() ? "finite" : allowed),
                  remedy_beyond(option, quantity, value));
}

bool read_number(CaseSource& source, const WrittenValue& w, double& out) {
  double value = 0;
  std::string text;
  if (const auto written = w.node.value_exact<std::string>()) {
    text = *written;
    try {
      value = parse_quantity(text, w.option.dimension);
    } catch (const UnitError& e) {
      source.complain(w.key, fmt::format("{} = \"{}\": {}", w.key, text, e.what()),
                      w.option.dimension == dimension::kSlope && !w.option.beyond.empty() ? std::string(w.option.beyond)
                                                                                          : e.remedy);
      return false;
    }
  } else if (w.node.is_number()) {
    value = number_of(w.node);
    if (!(w.option.dimension == dimension::kNumber || w.option.dimension == dimension::kSlope)) {
      source.complain(w.key, fmt::format("{} = {}: a bare number has no unit", w.key, shown(w.node)),
                      fmt::format("write {}, in quotes", describe(w.option.dimension)));
      return false;
    }
  } else {
    refuse_type(source, w);
    return false;
  }
  if (!std::isfinite(value) || !w.option.range.holds(value)) {
    refuse_range(source, w.option, w.key, shown(w.node), text, value);
    return false;
  }
  out = value;
  return true;
}

void read_value(CaseSource& source, CaseSpec& spec, const WrittenValue& w) {
  ValueReader reader(source, spec);
  std::visit([&](auto target) { reader.assign(w, target); }, w.option.slot(spec, w.index));
}

}  // namespace railstrata
