#include "case/case_tree.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "case/absent_options.hpp"
#include "case/option_table.hpp"
#include "case/toml_document.hpp"
#include "core/nearest_word.hpp"

namespace railstrata {
namespace {

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

std::string_view kind(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (node.is_array_of_tables()) return "a list of tables";
  if (node.is_array()) return "a list";
  if (node.is_string()) return "a text";
  if (node.is_boolean()) return "true or false";
  return node.is_number() ? "a number" : "a date or time";
}

/// Of a list or of a table by depth.
std::string_view example_of(const Option& option) {
  return option.example.empty() ? R"(["0.1 m", "0.3 m"])" : option.example;
}

/// "a depth and a modulus".
std::string columns_text(const Option& option) {
  std::string out;
  for (std::size_t k = 0; k < option.columns.size(); ++k)
    out += fmt::format("{}a {}", k == 0 ? "" : k + 1 == option.columns.size() ? " and " : ", ", option.columns[k].key);
  return out;
}

/// What the value of an option must look like, with an example.
std::string wanted(const Option& option) {
  struct Say {
    const Option& option;
    std::string operator()(const double*) const { return describe(option.dimension); }
    std::string operator()(const std::optional<double>*) const { return describe(option.dimension); }
    std::string operator()(const int*) const { return "a whole number"; }
    std::string operator()(const bool*) const { return "true or false"; }
    std::string operator()(const std::string*) const { return "a text in quotes"; }
    std::string operator()(const ChoiceSlot&) const {
      return fmt::format("one of \"{}\"", fmt::join(words_of(option), "\", \""));
    }
    std::string operator()(const std::vector<double>*) const {
      return fmt::format("a list, e.g. {}", example_of(option));
    }
    std::string operator()(const RowsSlot&) const {
      const char* const what = option.form == RowForm::by_depth ? "a table whose rows have"
                               : option.form == RowForm::named  ? "a list of tables with"
                                                                : "a table with";
      return fmt::format("{} {}, e.g. {}", what, columns_text(option), example_of(option));
    }
  };
  return std::visit(Say{option}, any_slot(option));
}

class TreeReader {
  static constexpr double kThinnestStep = 1e-6;  // m, of depth in a table by depth

 public:
  TreeReader(CaseSource& source, CaseSpec& spec) : source_(source), spec_(spec) {}

  void read(const toml::table& document) {
    for (const auto& [key, node] : document) read_top(std::string(key.str()), key, node);
    finish_derived();
  }

 private:
  struct Derived {
    const OptionTable* table;
    const Option* option;
    std::string key, shown;
    std::size_t index;
    double written;
    bool mass;  ///< for a force
  };

  void read_top(const std::string& name, const toml::key& key, const toml::node& node) {
    remember(name, key, node);
    if (const OptionTable* table = find_table(name))
      return table->repeated ? read_list(*table, node) : read_node(*table, name, node);
    if (!is_group(name)) return unknown_table(name, name);
    const toml::table* group = node.as_table();
    if (!group)
      return source_.complain(name, fmt::format("{} must be a table", name),
                              fmt::format("write [{}.rail] above its keys", name));
    for (const auto& [inner, child] : *group) {
      const std::string full = name + "." + std::string(inner.str());
      remember(full, inner, child);
      if (const OptionTable* table = find_table(full))
        read_node(*table, full, child);
      else
        unknown_table(full, full);
    }
  }

  void read_node(const OptionTable& table, const std::string& name, const toml::node& node) {
    if (const toml::table* t = node.as_table()) return read_table(table, name, 0, *t);
    source_.complain(name, fmt::format("{} = {}: must be a table", name, shown(node)),
                     fmt::format("write [{}] above its keys", name));
  }

  void read_list(const OptionTable& table, const toml::node& node) {
    const toml::array* list = node.as_array();
    const bool fits = list && std::all_of(list->begin(), list->end(), [](const toml::node& n) { return n.is_table(); });
    if (!fits)
      return source_.complain(std::string(table.name), fmt::format("{} must be a list of tables", table.name),
                              fmt::format("write [[{}]] with two brackets", table.name));
    const bool layers = table.name == "layer";
    table.repeated.resize(spec_, list->size());
    for (std::size_t i = 0; i < list->size(); ++i) {
      const std::string name = fmt::format("{}.{}", table.name, i);
      remember_place(name, (*list)[i]);
      const toml::table& entry = *(*list)[i].as_table();
      read_table(table, name, i, entry);
      if (layers) check_modulus(name, entry);
    }
    if (layers) name_layers(*list);
  }

  /// A layer without a name is "layer" if it is alone on its body, else "layer 1", "layer 2", … from the surface down.
  void name_layers(const toml::array& list) {
    for (const BodyId body : {BodyId::rail, BodyId::wheel}) {
      std::set<std::string> taken;
      std::vector<LayerSpec*> unnamed;
      for (std::size_t i = 0; i < list.size(); ++i) {
        if (spec_.layers[i].on != body) continue;
        if (list[i].as_table()->contains("name"))
          taken.insert(spec_.layers[i].name);
        else
          unnamed.push_back(&spec_.layers[i]);
      }
      if (unnamed.size() < 2 && !taken.contains(LayerSpec{}.name)) continue;
      int number = 0;
      for (LayerSpec* layer : unnamed) {
        do {
          layer->name = fmt::format("{} {}", LayerSpec{}.name, ++number);
        } while (taken.contains(layer->name));
      }
    }
  }

  void read_table(const OptionTable& table, const std::string& name, std::size_t index, const toml::table& entries) {
    for (const auto& [key, node] : entries) {
      const std::string word(key.str()), full = fmt::format("{}.{}", name, word);
      const auto option =
          std::find_if(table.options.begin(), table.options.end(), [&](const Option& o) { return o.key == word; });
      if (option == table.options.end()) {
        source_.remember(full, place_of(key.source()));
        unknown_key(table, full, word);
        continue;
      }
      remember(full, key, node);
      if (option->derivation)
        read_derived(table, *option, full, index, node);
      else
        read_value(*option, full, index, node);
    }
    for (const auto& rivals : table.rivals) check_rivals(rivals, name, entries);
  }

  void check_rivals(const std::vector<std::string_view>& rivals, const std::string& name, const toml::table& entries) {
    std::vector<std::string_view> given;
    for (const std::string_view key : rivals)
      if (entries.contains(key)) given.push_back(key);
    if (given.size() > 1)
      source_.complain(fmt::format("{}.{}", name, given.back()),
                       fmt::format("[{}] has {}: a case has one of them", name, fmt::join(given, " and ")),
                       "keep one of them");
  }

  /// A layer's stiffness is its whole point: no silent default.
  void check_modulus(const std::string& name, const toml::table& entry) {
    const bool young = entry.contains("young"), ratio = entry.contains("young_ratio"),
               table = entry.contains("young_table");
    if (young && ratio)
      source_.complain(name + ".young_ratio", fmt::format("{} has both young and young_ratio", name),
                       "keep one of them");
    if ((young || ratio) && table)
      source_.complain(name + ".young_table",
                       fmt::format("{} has both young_table and {}", name, young ? "young" : "young_ratio"),
                       "keep one of them");
    if (table && entry.contains("thickness"))
      source_.complain(name + ".thickness", fmt::format("{} has both young_table and thickness", name),
                       "leave thickness out: the layer ends at the table's last depth");
    if (!young && !ratio && !table)
      source_.complain(name, fmt::format("{} has no modulus", name),
                       "add young = \"420 GPa\", or young_ratio = 2.0 for twice the body's");
  }

  void read_value(const Option& option, const std::string& key, std::size_t index, const toml::node& node) {
    std::visit([&](auto target) { assign(option, key, index, node, target); }, option.slot(spec_, index));
  }

  void read_derived(const OptionTable& table, const Option& option, const std::string& key, std::size_t index,
                    const toml::node& node) {
    Derived derived{&table, &option, key, shown(node), index, 0, false};
    if (option.derivation.takes_mass) derived.mass = is_mass(node);
    const Option as_mass{option.key, option.slot, option.doc, dimension::kMass};
    if (number(derived.mass ? as_mass : option, key, node, derived.written)) derived_.push_back(std::move(derived));
  }

  static bool is_mass(const toml::node& node) {
    const auto written = node.value_exact<std::string>();
    try {
      return written && std::isfinite(parse_quantity(*written, dimension::kMass));
    } catch (const UnitError&) {
      return false;
    }
  }

  void assign(const Option& option, const std::string& key, std::size_t, const toml::node& node, double* target) {
    number(option, key, node, *target);
  }

  void assign(const Option& option, const std::string& key, std::size_t, const toml::node& node,
              std::optional<double>* target) {
    if (double value = 0; number(option, key, node, value)) *target = value;
  }

  void assign(const Option& option, const std::string& key, std::size_t, const toml::node& node, int* target) {
    const auto value = node.value_exact<int64_t>();
    if (!value) return mismatch(option, key, node);
    const auto number = static_cast<double>(*value);
    if (!option.range.holds(number)) return out_of_range(option, key, shown(node), "", number);
    *target = static_cast<int>(*value);
  }

  void assign(const Option& option, const std::string& key, std::size_t, const toml::node& node, bool* target) {
    const auto value = node.value_exact<bool>();
    if (!value) return mismatch(option, key, node);
    *target = *value;
  }

  void assign(const Option& option, const std::string& key, std::size_t, const toml::node& node, std::string* target) {
    const auto value = node.value_exact<std::string>();
    if (!value) return mismatch(option, key, node);
    *target = *value;
  }

  void assign(const Option& option, const std::string& key, std::size_t, const toml::node& node,
              const ChoiceSlot& target) {
    const auto value = node.value_exact<std::string>();
    if (!value) return mismatch(option, key, node);
    for (const Choice& c : option.choices)
      if (c.word == *value) return target.set(c.value);
    const std::string near = nearest_word(*value, words_of(option));
    source_.complain(key, fmt::format("{} = \"{}\": must be {}", key, *value, wanted(option)),
                     near.empty() ? fmt::format("write {} = \"{}\"", option.key, option.choices.front().word)
                                  : fmt::format("did you mean \"{}\"?", near));
  }

  void assign(const Option& option, const std::string& key, std::size_t, const toml::node& node,
              std::vector<double>* target) {
    const toml::array* list = node.as_array();
    if (!list) return mismatch(option, key, node);
    std::vector<double> values;
    for (std::size_t i = 0; i < list->size(); ++i) {
      const std::string item = fmt::format("{}.{}", key, i);
      remember_place(item, (*list)[i]);
      double value = 0;
      if (number(option, item, (*list)[i], value)) values.push_back(value);
    }
    if (list->empty())
      source_.complain(key, fmt::format("{} = []: needs at least one value", key),
                       fmt::format("write {}", wanted(option)));
    *target = values;
  }

  void assign(const Option& option, const std::string& key, std::size_t index, const toml::node& node,
              const RowsSlot& target) {
    if (option.form == RowForm::one_named) return assign_named(option, key, node, target);
    const toml::array* list = node.as_array();
    if (!list) return mismatch(option, key, node);
    if (option.form == RowForm::named) return assign_list(option, key, *list, target);
    RowsSlot::Rows rows;
    bool sound = true;
    for (std::size_t i = 0; i < list->size(); ++i)
      sound &= read_row(option, fmt::format("{}.{}", key, i), (*list)[i], rows.emplace_back());
    if (!sound || !fits(option, key, rows)) return;
    target.set(rows);
    if (option.key == "young_table") take_moduli(key, spec_.layers.at(index));
  }

  void assign_named(const Option& option, const std::string& key, const toml::node& node, const RowsSlot& target) {
    if (!node.is_table()) return mismatch(option, key, node);
    if (RowsSlot::Rows rows(1); read_named(option, key, *node.as_table(), rows.front())) target.set(rows);
  }

  void assign_list(const Option& option, const std::string& key, const toml::array& list, const RowsSlot& target) {
    RowsSlot::Rows rows;
    bool sound = true;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string item = fmt::format("{}.{}", key, i);
      remember_place(item, list[i]);
      const toml::table* table = list[i].as_table();
      if (!table) mismatch(option, item, list[i]);
      sound &= table && read_named(option, item, *table, rows.emplace_back());
    }
    if (list.empty())
      source_.complain(key, fmt::format("{} = []: needs at least one table", key),
                       fmt::format("write {}", wanted(option)));
    if (sound) target.set(rows);
  }

  /// Numbers under the keys of the columns, every one.
  bool read_named(const Option& option, const std::string& item, const toml::table& table,
                  std::vector<double>& numbers) {
    bool sound = true;
    std::vector<std::string> keys;
    numbers.assign(option.columns.size(), 0.0);
    for (std::size_t k = 0; k < option.columns.size(); ++k) {
      const Option& column = option.columns[k];
      const std::string part = fmt::format("{}.{}", item, keys.emplace_back(column.key));
      const toml::node* node = table.get(column.key);
      if (node) remember_place(part, *node);
      if (!node)
        source_.complain(item, fmt::format("{} has no {}", item, column.key), fmt::format("write {}", wanted(option)));
      sound &= node && number(column, part, *node, numbers[k]);
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
    remember_place(item, row);
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
      remember_place(part, (*written)[k]);
      sound &= number(option.columns[k], part, (*written)[k], numbers[k]);
    }
    return sound;
  }

  /// From depth 0 down, at least two rows.
  bool fits(const Option& option, const std::string& key, const RowsSlot::Rows& rows) {
    const auto refuse = [&](const std::string& at, const std::string& what, const std::string& remedy) {
      source_.complain(at, what, remedy);
      return false;
    };
    if (rows.size() < 2)
      return refuse(key, fmt::format("{}: needs at least two rows", key), fmt::format("write {}", wanted(option)));
    if (rows.front()[0] != 0)
      return refuse(key + ".0", fmt::format("{}: the first depth must be 0 mm, {}", key, option.columns[0].doc),
                    fmt::format("begin with the {} at the top", option.columns[1].key));
    for (std::size_t i = 1; i < rows.size(); ++i)
      if (!(rows[i][0] - rows[i - 1][0] >= kThinnestStep))
        return refuse(fmt::format("{}.{}", key, i),
                      fmt::format("{}: depths must increase, by {} at least", key,
                                  format_quantity(kThinnestStep, dimension::kLength)),
                      "sort the rows by depth; for a jump write two layers");
    return true;
  }

  /// A graded layer is as thick as its table says, and as stiff on the mean.
  void take_moduli(const std::string& key, LayerSpec& layer) {
    const std::vector<ModulusPoint>& rows = layer.young_table;
    const OptionTable& table = *find_table("layer");
    const auto thickness =
        std::find_if(table.options.begin(), table.options.end(), [](const Option& o) { return o.key == "thickness"; });
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

  void remember_place(const std::string& item, const toml::node& node) {
    if (const TextPlace place = place_of(node.source()); place.line > 0) source_.remember(item, place);
  }

  bool number(const Option& option, const std::string& key, const toml::node& node, double& out) {
    double value = 0;
    std::string text;
    if (const auto written = node.value_exact<std::string>()) {
      text = *written;
      try {
        value = parse_quantity(text, option.dimension);
      } catch (const UnitError& e) {
        source_.complain(key, fmt::format("{} = \"{}\": {}", key, text, e.what()), e.remedy);
        return false;
      }
    } else if (node.is_number()) {
      value = number_of(node);
      if (!(option.dimension == dimension::kNumber || option.dimension == dimension::kSlope)) {
        source_.complain(key, fmt::format("{} = {}: a bare number has no unit", key, shown(node)),
                         fmt::format("write {}, in quotes", describe(option.dimension)));
        return false;
      }
    } else {
      mismatch(option, key, node);
      return false;
    }
    if (!std::isfinite(value) || !option.range.holds(value)) {
      out_of_range(option, key, shown(node), text, value);
      return false;
    }
    out = value;
    return true;
  }

  void mismatch(const Option& option, const std::string& key, const toml::node& node) {
    source_.complain(key, fmt::format("{} = {}: is {}, must be {}", key, shown(node), kind(node), wanted(option)),
                     fmt::format("write {}", wanted(option)));
  }

  void out_of_range(const Option& option, const std::string& key, const std::string& written,
                    const std::string& quantity, double value) {
    const std::string allowed = describe(option.range, option.dimension);
    source_.complain(key, fmt::format("{} = {}: must be {}", key, written, allowed.empty() ? "finite" : allowed),
                     remedy_beyond(option, quantity, value));
  }

  /// Another unit is offered where the value lies far from the range: who misses it by less means what he wrote.
  static std::string remedy_beyond(const Option& option, const std::string& quantity, double value) {
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

  void unknown_key(const OptionTable& table, const std::string& full, const std::string& key) {
    std::vector<std::string> keys;
    for (const Option& o : table.options) keys.emplace_back(o.key);
    source_.complain(full, fmt::format("unknown key {}", full),
                     fmt::format("{}keys of [{}]: {}", hint_for(key, keys), table.name, fmt::join(keys, ", ")));
  }

  void unknown_table(const std::string& full, const std::string& name) {
    std::vector<std::string> names;
    for (const OptionTable& t : case_tables()) names.emplace_back(t.name);
    source_.complain(full, fmt::format("unknown table or key {}", full),
                     fmt::format("{}tables: {}", hint_for(name, names), fmt::join(names, ", ")));
  }

  /// What to do without a thing that no case has, else the known name that is meant.
  static std::string hint_for(const std::string& name, const std::vector<std::string>& known) {
    if (const std::string_view answer = answer_for_absent(name); !answer.empty()) return fmt::format("{}. ", answer);
    const std::string near = nearest_word(name, known);
    return near.empty() ? "" : fmt::format("did you mean {}? ", near);
  }

  /// Values point at the value, tables and keys set by an override at nothing of the text.
  void remember(const std::string& full, const toml::key& key, const toml::node& node) {
    const TextPlace value = place_of(node.source()), name = place_of(key.source());
    const bool by_name = name.line > 0 && (node.is_table() || value.line == 0);
    if (const TextPlace& at = by_name ? name : value; at.line > 0) source_.remember(full, at);
  }

  static bool is_group(const std::string& name) {
    return std::any_of(case_tables().begin(), case_tables().end(),
                       [&](const OptionTable& t) { return t.name.starts_with(name + "."); });
  }

  /// After everything else, because what they depend on may stand further down; in the tables' order, because forces
  /// over the load depend on the load.
  void finish_derived() {
    for (const OptionTable& table : case_tables())
      for (const Derived& d : derived_)
        if (d.table == &table) finish(d);
  }

  static double rounded(double value) { return std::stod(fmt::format("{:.5g}", value)); }

  /// What may be written where the slot has this range; every derivation is linear.
  Range range_behind(const Derived& d, const Range& slot) const {
    const auto value = [&](double written) { return d.option->derivation.value(spec_, d.index, written); };
    const double at_zero = value(0), slope = value(1) - at_zero;
    const auto written = [&](double end) { return rounded((end - at_zero) / slope); };
    return {std::max(d.option->range.min, written(slot.min)), std::min(d.option->range.max, written(slot.max)),
            slot.open};
  }

  void finish(const Derived& d) {
    const double written = d.mass ? d.written * spec_.vehicle.gravity : d.written;
    if (!d.option->range.holds(written)) return out_of_range(*d.option, d.key, d.shown, "", written);
    const Slot slot = d.option->slot(spec_, d.index);
    const double value = d.option->derivation.value(spec_, d.index, written);
    for (const Option& whole : d.table->options)
      if (!whole.derivation && whole.slot(spec_, d.index) == slot && !whole.range.holds(value))
        source_.complain(
            d.key,
            fmt::format("{} = {}: must be {} here: it makes {} {}, which must be {}", d.key, d.shown,
                        describe(range_behind(d, whole.range), d.option->dimension), whole.key,
                        format_quantity(rounded(value), whole.dimension), describe(whole.range, whole.dimension)),
            std::string(d.option->derivation.remedy));
    if (auto* const* maybe = std::get_if<std::optional<double>*>(&slot))
      **maybe = value;
    else
      *std::get<double*>(slot) = value;
  }

  CaseSource& source_;
  CaseSpec& spec_;
  std::vector<Derived> derived_;
};

[[noreturn]] void refuse_override(const std::string& text, const std::string& why) {
  throw CaseError(
      fmt::format("--set {}: {}", text, why),
      "write --set table.key=value, e.g. --set mesh.element_size=\"2 mm\" or --set layer.0.thickness=\"0.5 mm\"");
}

/// What the parts of a key name: "layer.0.young", "run.positions", and what is inside a list ("run.positions.0").
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

/// What is set takes the place of the file's other ways of saying it; two that are set contradict each other.
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

}  // namespace

CaseSpec read_case_tree(CaseSource& source, const std::vector<std::string>& overrides) {
  toml::table document = toml_document(source);
  for (const std::string& text : overrides) apply_override(document, text, source);
  CaseSpec spec;
  TreeReader(source, spec).read(document);
  return spec;
}

}  // namespace railstrata
