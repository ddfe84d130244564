#include "reader/case_tree.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/faults.hpp"
#include "core/nearest_word.hpp"
#include "friction/friction_conditions.hpp"
#include "options/absent_options.hpp"
#include "reader/overrides.hpp"
#include "reader/value_reader.hpp"

namespace railstrata {
namespace {

class TreeReader {
 public:
  TreeReader(CaseSource& source, CaseSpec& spec) : source_(source), spec_(spec) {}

  void read(const toml::table& document) {
    take_condition(document);
    take_track(document);
    take_sleepers(document);
    for (const auto& [key, node] : document) read_top(std::string(key.str()), key, node);
    finish_derived();
    const std::vector<TablePoint>& across = spec_.friction.lateral_table;
    if (!across.empty() && !source_.has("drive.friction_coefficient"))
      spec_.drive.friction_coefficient = largest_value(across);
  }

 private:
  /// The numbers of friction.condition are the defaults of the keys beside it.
  void take_condition(const toml::table& document) {
    const auto name = document["friction"]["condition"].value<std::string>();
    if (!name) return;
    try {
      const FrictionCondition& c = friction_condition(*name);
      spec_.drive.friction_coefficient = c.coefficient;
      FrictionSpec& f = spec_.friction;
      f.law = c.law.form;
      if (c.law.falls() && document["friction"]["law"].value<std::string>() != "coulomb") {
        f.kinetic_coefficient = c.law.kinetic_share * c.coefficient;
        f.half_velocity = c.law.half_velocity;
        f.memory_distance = c.law.memory_distance;
      }
      ThirdBodySpec& t = spec_.third_body;
      if (!(c.film.thickness > 0)) return;
      t.thickness = c.film.thickness;
      t.shear_modulus = c.film.shear_modulus;
      if (c.film.yields()) t.yield_shear = c.film.yield_shear;
      t.hardening = c.film.hardening;
      if (c.film.residual > 0) t.residual_shear = c.film.residual;
    } catch (const CaseError& e) {
      remember_place(source_, "friction.condition", *document["friction"]["condition"].node());
      source_.complain("friction.condition", e.diagnostics.front().message, e.diagnostics.front().remedy);
    }
  }

  /// The numbers of a track are the defaults of the keys beside it.
  void take_track(const toml::table& document) {
    GeometrySpec& g = spec_.geometry;
    const auto given = [&](const char* key) { return document["geometry"][key].value<std::string>(); };
    const TrackNumbers& numbers =
        track_preset_of(track_kind_named(given("track").value_or("")), given("wheel_profile").value_or(g.wheel_profile),
                        given("rail_profile").value_or(g.rail_profile));
    static_cast<TrackNumbers&>(g) = numbers;
  }

  /// The numbers of a set of sleepers likewise.
  void take_sleepers(const toml::table& document) {
    const SleeperTrack* named = named_track(document["track"]["preset"].value_or<std::string>(""));
    if (named) spec_.track.support = *named;
  }

  /// The numbers of a kind of vehicle likewise.
  void take_types(const toml::array& bogies) {
    for (std::size_t i = 0; i < bogies.size(); ++i)
      for (const BogieType& type : bogie_types())
        if ((*bogies[i].as_table())["type"].value<std::string>() == type.name)
          static_cast<BogieNumbers&>(spec_.collective.curve.bogies[i]) = type.numbers;
  }

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
    const toml::table* group = node.as_table();
    if (!is_group(name)) return group && all_retired(name, *group) ? void() : unknown_table(name, name);
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
    if (table.name == "bogie") take_types(*list);
    for (std::size_t i = 0; i < list->size(); ++i) {
      const std::string name = fmt::format("{}.{}", table.name, i);
      remember_place(source_, name, (*list)[i]);
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
    for (const bool first : {true, false}) read_keys(table, name, index, entries, first);
    for (const auto& rivals : table.rivals) check_rivals(rivals, name, entries);
  }

  void read_keys(const OptionTable& table, const std::string& name, std::size_t index, const toml::table& entries,
                 bool first) {
    for (const auto& [key, node] : entries) {
      const std::string word(key.str()), full = fmt::format("{}.{}", name, word);
      const auto option =
          std::find_if(table.options.begin(), table.options.end(), [&](const Option& o) { return o.key == word; });
      if ((option != table.options.end() && option->first) != first) continue;
      if (option == table.options.end()) {
        if (read_over(table.name, full, key, node)) continue;
        source_.remember(full, place_of(key.source()));
        unknown_key(table, full, word);
        continue;
      }
      remember(full, key, node);
      if (option->derivation || option->takes_mass)
        read_derived(table, *option, full, index, node);
      else
        read_value(source_, spec_, {*option, full, node, index});
    }
  }

  /// Whether it is a key that is gone: with the value that holds now nothing, else an error.
  bool read_over(std::string_view table, const std::string& full, const toml::key& key, const toml::node& node) {
    const RetiredKey* gone = retired_key(table, key.str());
    if (gone && shown(node) != gone->value) {
      remember(full, key, node);
      source_.complain(full, fmt::format("{} = {}: this key is gone", full, shown(node)), std::string(gone->remedy));
    }
    return gone != nullptr;
  }

  /// Whether a table that is gone has keys of its own alone.
  bool all_retired(const std::string& name, const toml::table& entries) {
    return !entries.empty() && std::all_of(entries.begin(), entries.end(), [&](const auto& entry) {
      return read_over(name, fmt::format("{}.{}", name, entry.first.str()), entry.first, entry.second);
    });
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
    if (!young && !ratio && !table)
      source_.complain(name, fmt::format("{} has no modulus", name),
                       "add young = \"420 GPa\", or young_ratio = 2.0 for twice the body's");
  }

  void read_derived(const OptionTable& table, const Option& option, const std::string& key, std::size_t index,
                    const toml::node& node) {
    Derived derived{&table, &option, key, shown(node), index, 0, false};
    if (option.takes_mass) derived.mass = is_mass(node);
    const Option as_mass{.key = option.key, .slot = option.slot, .doc = option.doc, .dimension = dimension::kMass};
    if (read_number(source_, {derived.mass ? as_mass : option, key, node}, derived.written))
      derived_.push_back(std::move(derived));
  }

  static bool is_mass(const toml::node& node) {
    const auto written = node.value_exact<std::string>();
    try {
      return written && std::isfinite(parse_quantity(*written, dimension::kMass));
    } catch (const UnitError&) {
      return false;
    }
  }

  void unknown_key(const OptionTable& table, const std::string& full, const std::string& key) {
    std::vector<std::string> keys;
    for (const Option& o : table.options) keys.emplace_back(o.key);
    source_.complain(full, fmt::format("unknown key {}", full),
                     fmt::format("{}{}keys of [{}]: {}", hint_for(key, keys), elsewhere(key, table.name), table.name,
                                 fmt::join(keys, ", ")));
  }

  void unknown_table(const std::string& full, const std::string& name) {
    std::vector<std::string> names;
    for (const OptionTable& t : case_tables()) names.emplace_back(t.name);
    source_.complain(full, fmt::format("unknown table or key {}", full),
                     fmt::format("{}{}tables: {}", hint_for(name, names), elsewhere(name, ""), fmt::join(names, ", ")));
  }

  /// Where another table has the key: speed of [vehicle] is drive.speed, coefficient of [friction]
  /// drive.friction_coefficient.
  static std::string elsewhere(const std::string& key, std::string_view table) {
    for (const std::string& word : {key, fmt::format("{}_{}", table, key)})
      for (const OptionTable& t : case_tables())
        for (const Option& o : t.options)
          if (o.key == word) return fmt::format("[{}] has {}. ", t.name, word);
    return "";
  }

  /// Advice for a known unsupported name, else the most similar known name.
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

  /// After everything else, because what they depend on may stand further down; in the order of the tables and their
  /// rows, because forces over the load depend on the load, a wheel's creepage on the rail's speed.
  void finish_derived() {
    for (const OptionTable& table : case_tables())
      for (const Option& option : table.options)
        for (const Derived& d : derived_)
          if (d.table == &table && d.option == &option) finish(d);
  }

  static double rounded(double value) { return std::stod(fmt::format("{:.5g}", value)); }

  /// Range of the written value for this range of the slot; every derivation is linear.
  Range range_behind(const Derived& d, const Range& slot) const {
    const auto value = [&](double written) { return d.option->derivation.value(spec_, d.index, written); };
    const double at_zero = value(0), slope = value(1) - at_zero;
    const auto written = [&](double end) { return rounded((end - at_zero) / slope); };
    return {std::max(d.option->range.min, written(slot.min)), std::min(d.option->range.max, written(slot.max)),
            slot.open};
  }

  void finish(const Derived& d) {
    const double written = d.mass ? d.written * kGravity : d.written;
    if (!d.option->range.holds(written)) return refuse_range(source_, *d.option, d.key, d.shown, "", written);
    const Slot slot = d.option->slot(spec_, d.index);
    const Derivation& derive = d.option->derivation;
    const double value = derive ? derive.value(spec_, d.index, written) : written;
    for (const Option& whole : d.table->options)
      if (derive && !whole.derivation && whole.slot(spec_, d.index) == slot && !whole.range.holds(value))
        source_.complain(
            d.key,
            fmt::format("{} = {}: must be {} here: it makes {} {}, which must be {}", d.key, d.shown,
                        describe(range_behind(d, whole.range), d.option->dimension), whole.key,
                        format_quantity(rounded(value), whole.dimension), describe(whole.range, whole.dimension)),
            std::string(derive.remedy));
    if (auto* const* maybe = std::get_if<std::optional<double>*>(&slot))
      **maybe = value;
    else
      *std::get<double*>(slot) = value;
  }

  CaseSource& source_;
  CaseSpec& spec_;
  std::vector<Derived> derived_;
};

}  // namespace

CaseSpec read_case_tree(CaseSource& source, const std::vector<std::string>& overrides) {
  toml::table document = toml_document(source);
  for (const std::string& text : overrides) apply_override(document, text, source);
  CaseSpec spec;
  TreeReader(source, spec).read(document);
  return spec;
}

}  // namespace railstrata
