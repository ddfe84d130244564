// What reads the table of clashes, and ranges that are narrower for a use.
#include "rules/support.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/height_field.hpp"
#include "model/rolling_start.hpp"
#include "options/option_table.hpp"
#include "rules/irregularity_rules.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {
namespace {

/// Of `run.device = "gpu"` the key and the value; of a key alone no value.
std::string_view key_part(std::string_view pattern) { return pattern.substr(0, pattern.find(" = ")); }
std::string_view value_part(std::string_view pattern) {
  const std::size_t at = pattern.find(" = ");
  return at == std::string_view::npos ? std::string_view() : pattern.substr(at + 3);
}

std::vector<std::string_view> alternatives(std::string_view keys) {
  std::vector<std::string_view> out;
  for (std::size_t at = 0; at != std::string_view::npos;) {
    const std::size_t end = keys.find(" | ", at);
    out.push_back(keys.substr(at, end == std::string_view::npos ? end : end - at));
    at = end == std::string_view::npos ? end : end + 3;
  }
  return out;
}

/// The first key of a feature, as it stands for it where the case does not have it.
std::string first_key(const Feature& f) { return std::string(key_part(alternatives(f.key).front())); }

/// The keys by which a case has features.
class KeysOfCase {
 public:
  KeysOfCase(const CaseSpec& spec, const CaseSource* text) : spec_(spec), text_(text) {}

  /// Of a use one without text: it is always there.
  Keys of(const Feature& f) {
    if (f.use) return {{}};
    if (f.keys) return f.keys(spec_, text_);
    if (f.has) return f.has(spec_) ? Keys{first_key(f)} : Keys{};
    Keys out;
    for (const std::string_view pattern : alternatives(f.key)) add(pattern, out);
    return out;
  }

 private:
  void add(std::string_view pattern, Keys& out) {
    const std::string_view key = key_part(pattern);
    if (key.starts_with("*."))
      for (const char* table : {"material.rail", "material.wheel", "layer"}) add_option(table, key.substr(2), {}, out);
    else if (const OptionTable* table = find_table(key))
      add_table(*table, out);
    else
      add_option(key.substr(0, key.rfind('.')), key.substr(key.rfind('.') + 1), value_part(pattern), out);
  }

  void add_table(const OptionTable& table, Keys& out) {
    if (table.repeated) {
      if (table.repeated.count(spec_) > 0) out.emplace_back(table.name);
      return;
    }
    for (const Option& option : table.options)
      if (const std::string key = fmt::format("{}.{}", table.name, option.key); text_ && text_->has(key))
        out.push_back(key);
  }

  void add_option(std::string_view name, std::string_view key, std::string_view value, Keys& out) {
    const OptionTable& table = *find_table(name);
    const auto option =
        std::find_if(table.options.begin(), table.options.end(), [&](const Option& o) { return o.key == key; });
    const std::size_t count = table.repeated ? table.repeated.count(spec_) : 1;
    for (std::size_t i = 0; i < count; ++i) {
      const std::string entry = table.repeated ? fmt::format("{}.{}", name, i) : std::string(name);
      if (given(entry, *option, i, value)) out.push_back(written(table, entry, *option, i));
    }
  }

  bool given(const std::string& entry, const Option& option, std::size_t index, std::string_view value) {
    if (option.derivation) return text_ && text_->has(fmt::format("{}.{}", entry, option.key));
    static CaseSpec usual = one_of_each();
    const std::string has = toml_value(option, spec_, index);
    return value.empty() ? has != toml_value(option, usual, 0) : has == value;
  }

  /// The key that the text gives this option by, which may be a derived one: drive.tractive_force.
  std::string written(const OptionTable& table, const std::string& entry, const Option& option, std::size_t index) {
    const std::string own = fmt::format("{}.{}", entry, option.key);
    if (text_ && !text_->has(own))
      for (const Option& other : table.options)
        if (const std::string key = fmt::format("{}.{}", entry, other.key);
            other.derivation && other.slot(spec_, index) == option.slot(spec_, index) && text_->has(key))
          return key;
    return own;
  }

  CaseSpec spec_;  ///< a copy: slots of options are places to write to
  const CaseSource* text_;
};

/// Whether the rules of `of` hold for a use.
bool holds(const Use& use, const Use& of, const CaseSpec& spec) {
  return use.is(of) || (of.comes && use.is(*of.part_of) && of.comes(spec));
}

/// In words for a message, where the case has it by `key`.
std::string shown(const Feature& f, const std::string& key) {
  if (f.use) return std::string(f.name);
  const std::string_view value = value_part(alternatives(f.key).front());
  const std::string full = value.empty() ? key : fmt::format("{} = {}", key, value);
  return f.name.empty() ? full : fmt::format("{} ({})", f.name, full);
}

std::string message_of(const Clash& c, const std::string& a, const std::string& b) {
  const auto words = [&] {
    switch (c.rule) {
      case ClashRule::needs:
        return "needs";
      case ClashRule::idle_without:
        return "has no effect without";
      case ClashRule::excludes:
        return c.b.use ? "is not supported by" : "cannot be combined with";
      default:
        return c.b.use ? "has no effect on" : "has no effect with";
    }
  };
  return fmt::format("{} {} {}{}{}{}", shown(c.a, a), words(), shown(c.b, b), c.in ? " in " : "",
                     c.in ? c.in->name : "", *c.why ? fmt::format(": {}", c.why) : "");
}

bool lacks(ClashRule rule) { return rule == ClashRule::needs || rule == ClashRule::idle_without; }
bool refuses(ClashRule rule) { return rule == ClashRule::excludes || rule == ClashRule::needs; }
bool notes(ClashRule rule) { return rule == ClashRule::idle_with || rule == ClashRule::idle_without; }

bool of_layers(const Clash& c) { return c.a.key.starts_with("layer.") && c.b.key.starts_with("layer."); }
/// "layer.0." of "layer.0.to".
std::string entry_of(const std::string& key) { return key.substr(0, key.rfind('.') + 1); }

/// A row that holds in a case.
struct Found {
  const Clash* row;
  std::string key, message;
};

/// Rows for a use, or for any (null), whose rule is one of those that are asked for.
std::vector<Found> found(const CaseSpec& spec, const CaseSource* text, const Use* use, bool (*asked)(ClashRule)) {
  std::vector<Found> out;
  KeysOfCase keys(spec, text);
  for (const Clash& c : clash_table()) {
    const Use* const of = c.of();
    if (!asked(c.rule) || (of != nullptr) != (use != nullptr) || (of && !holds(*use, *of, spec))) continue;
    Keys a = c.a.use ? Keys{first_key(c.b)} : keys.of(c.a);
    if (!c.a.use) std::erase(a, first_key(c.b));  // of a whole table the key that it needs
    if (a.empty()) continue;
    const Keys b = keys.of(c.b);
    for (const std::string& key : a) {
      const auto other = std::find_if(
          b.begin(), b.end(), [&](const std::string& one) { return !of_layers(c) || entry_of(one) == entry_of(key); });
      if ((other == b.end()) == lacks(c.rule))
        out.push_back({&c, key, message_of(c, key, other == b.end() ? first_key(c.b) : *other)});
    }
  }
  return out;
}

/// Heights along the rail: elements fine enough for their waves, and a rail that is smooth during the run-up.
void check_heights(const CaseSpec& spec, std::vector<Diagnostic>& out) {
  for (std::size_t i = 0; i < spec.irregularities.size(); ++i) {
    const Irregularity& is = spec.irregularities[i];
    const std::string key = fmt::format("irregularity.{}", i);
    if (const auto fault = too_coarse(spec, i, spec.mesh.element_size, "elements", "mesh.element_size"))
      out.push_back(*fault);
    const double run_up = run_up_of(spec, 0);
    if (spec.run.rolling && is.on == BodyId::rail && extent_of(is).from < run_up)
      out.push_back(
          {key,
           fmt::format("{} begins before the end of run.run_up ({})", key, format_quantity(run_up, dimension::kLength)),
           "put it farther on (at, from), or shorten run.run_up"});
  }
}

}  // namespace

void check_clashes(const CaseSpec& spec, CaseSource& source) {
  std::vector<Found> all = found(spec, &source, nullptr, refuses);
  std::erase_if(all, [&](const Found& f) { return !source.sound({f.key, first_key(f.row->b)}); });
  for (const Found& f : all) source.complain(f.key, f.message, f.row->remedy);
}

std::vector<Diagnostic> refused_by(const Use& use, const CaseSpec& spec) {
  std::vector<Diagnostic> out;
  for (Found& f : found(spec, nullptr, &use, refuses))
    out.push_back({std::move(f.key), std::move(f.message), f.row->remedy});
  if (use.is(uses::kFiniteElements)) check_heights(spec, out);
  return out;
}

void require_support(const Use& use, const CaseSpec& spec) {
  if (std::vector<Diagnostic> all = refused_by(use, spec); !all.empty()) throw CaseError(std::move(all));
}

std::vector<IdleSetting> idle_settings(const CaseSpec& spec, const CaseSource* source) {
  std::vector<IdleSetting> out;
  Keys seen;
  for (const Found& f : found(spec, source, nullptr, notes)) {
    if (std::find(seen.begin(), seen.end(), f.key) != seen.end()) continue;
    seen.push_back(f.key);
    out.push_back({f.row->rule == ClashRule::idle_with ? &f.row->b : nullptr,
                   *f.row->remedy ? fmt::format("{}; {}", f.message, f.row->remedy) : f.message});
  }
  return out;
}

std::vector<std::string> idle_in(const Use& use, const CaseSpec& spec) {
  std::vector<std::string> out;
  for (Found& f : found(spec, nullptr, &use, notes)) out.push_back(std::move(f.message));
  return out;
}

bool overlooked(const Feature& feature, const Use* by) {
  const std::span<const Clash> table = clash_table();
  return std::any_of(table.begin(), table.end(), [&](const Clash& c) {
    return !refuses(c.rule) && c.b.use && (!by || by->is(*c.b.use)) && c.a.key == feature.key && c.a.has == feature.has;
  });
}

std::map<std::string, std::string> excluded_keys(const Use& use, const CaseSpec& spec) {
  std::map<std::string, std::string> out;
  KeysOfCase keys(spec, nullptr);
  const auto add = [&](const Clash& c, const Feature& f, const std::string& other) {
    if (!f.name.empty()) return;  // some of its values alone
    for (const std::string_view pattern : alternatives(f.key)) {
      if (!value_part(pattern).empty()) continue;
      std::string key(pattern);
      if (of_layers(c)) key = entry_of(other) + key.substr(key.find('.') + 1);
      out.try_emplace(key, &f == &c.a ? message_of(c, key, other) : message_of(c, other, key));
    }
  };
  for (const Clash& c : clash_table()) {
    const Use* const of = c.of();
    if (c.a.use || c.rule == ClashRule::overlooked || (of && !holds(use, *of, spec))) continue;
    const Keys b = keys.of(c.b);
    if (lacks(c.rule)) {
      if (b.empty()) add(c, c.a, first_key(c.b));
      continue;
    }
    for (const std::string& other : b) add(c, c.a, other);
    if (c.rule == ClashRule::excludes && !c.b.use)
      for (const std::string& other : keys.of(c.a)) add(c, c.b, other);
  }
  return out;
}

}  // namespace railstrata
