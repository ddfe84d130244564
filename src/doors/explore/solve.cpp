#include "explore/solve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <exception>
#include <iterator>
#include <new>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

#include <nlohmann/json.hpp>

#include "ask/judge.hpp"
#include "core/faults.hpp"
#include "io/summary_json.hpp"
#include "judge/bem_summary.hpp"
#include "judge/check_limits.hpp"
#include "material/elastic.hpp"
#include "model/model.hpp"
#include "options/option_table.hpp"
#include "reader/case_file.hpp"
#include "record/json.hpp"
#include "result/result_table.hpp"
#include "result/stress_sections.hpp"
#include "rules/clashes.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;

struct Request {
  std::string text, file = "case.toml";
  std::vector<std::string> overrides, values, want;
  double cell = BemOptions{}.cell;
  bool wants(std::string_view what) const { return std::find(want.begin(), want.end(), what) != want.end(); }
  /// Two requests of one contact differ in nothing of this.
  bool same_contact(const Request& other) const {
    return text == other.text && file == other.file && overrides == other.overrides && cell == other.cell;
  }
};

Request request_of(const std::string& text) {
  const Json json = Json::parse(text);
  Request out;
  out.text = json.at("case").get<std::string>();
  out.file = json.value("file", out.file);
  out.overrides = json.value("set", out.overrides);
  out.values = json.value("values", out.values);
  out.want = json.value("want", out.want);
  out.cell = json.value("cell", out.cell);
  return out;
}

/// Arrays are appended to the numbers; the head has their positions.
template <class Range, class Value>
Json array_of(const Range& range, std::vector<float>& numbers, Value&& value) {
  const std::size_t first = numbers.size();
  for (const auto& item : range) numbers.push_back(static_cast<float>(value(item)));
  return {{"first", first}, {"count", numbers.size() - first}};
}
Json array_of(const std::vector<double>& values, std::vector<float>& numbers) {
  return array_of(values, numbers, [](double v) { return v; });
}

Json patch_json(const BemPatch& patch, std::vector<float>& numbers) {
  const ContactField& f = patch.together ? *patch.together : patch.field;
  Json out{{"stations", f.stations}, {"columns", f.columns}, {"slip_is_distance", f.slip_is_distance}};
  const std::pair<const char*, const std::vector<double>&> fields[] = {
      {"x", f.x},     {"y", f.y}, {"p", f.p},           {"q_x", f.q_x},
      {"q_y", f.q_y}, {"z", f.z}, {"slip_x", f.slip_x}, {"slip_y", f.slip_y}};
  for (const auto& [name, values] : fields) out[name] = array_of(values, numbers);
  out["state"] = array_of(f.state, numbers, [](ContactState s) { return static_cast<int>(s); });
  const CentreLine line = centre_line(patch.field);
  out["centre_y"] = line.y;
  out["centre_x"] = array_of(line.x, numbers);
  out["centre_p"] = array_of(line.p, numbers);
  out["centre_q_x"] = array_of(line.q_x, numbers);
  return out;
}

Json section_json(const StressSection& s, std::vector<float>& numbers) {
  Json out{{"at", s.at}};
  out["along"] = array_of(s.along, numbers);
  out["depth"] = array_of(s.depth, numbers);
  out["von_mises"] = array_of(s.stress, numbers, [](const Sym3& t) { return von_mises(t); });
  out["sigma_1"] = array_of(s.stress, numbers, [](const Sym3& t) { return principal_stresses(t).x; });
  out["tau_xz"] = array_of(s.stress, numbers, [](const Sym3& t) { return t.xz; });
  return out;
}

Json layers_json(const CaseSpec& spec) {
  Json out = Json::array();
  for (const LayerSpec& layer : spec.layers)
    out.push_back({{"name", layer.name},
                   {"on", body_word(layer.on)},
                   {"thickness", layer.thickness},
                   {"graded", layer.graded()}});
  return out;
}

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

/// {key: value}, SI, of keys that hold a number; null: the case has none, or there is no such key.
Json case_values(const CaseSpec& spec, const std::vector<std::string>& keys) {
  Json out = Json::object();
  for (const std::string& key : keys) {
    const std::optional<double> value = value_of(spec, key);
    out[key] = value ? Json(*value) : Json(nullptr);
  }
  return out;
}

/// Failed checks and warnings as text.
Json doubts_json(const Summary& s) {
  Json out = Json::array();
  for (const Check& c : s.checks) {
    const auto [name, unit] = check_words(c.name);
    if (!c.ok)
      out.push_back(fmt::format("a check fails: {}: {}, limit {}", name,
                                with_unit(unit, shown_beside_limit(c.value, c.limit), 3), limit_text(unit, c.limit)));
  }
  for (const Warning& w : s.warnings) {
    const CheckRow* row = find_check(w.name);
    const auto [name, unit] = check_words(w.name);
    out.push_back(fmt::format("{}: {}, above {}: {}", name, with_unit(unit, w.value, 3), limit_text(unit, w.limit),
                              row && !row->own_text ? fmt::format("{}: {}", row->what, row->advice) : w.text));
  }
  return out;
}

Json faults_json(const CaseError& error) {
  Json out = Json::array();
  for (const Diagnostic& d : error.diagnostics)
    out.push_back({{"where", d.where}, {"message", d.message}, {"remedy", d.remedy}});
  return out;
}

/// Material and layer data that the influence operators depend on, besides the grid.
std::vector<double> stiffness_of(const CaseSpec& spec) {
  std::vector<double> out{spec.rail_material.young, spec.rail_material.poisson, spec.wheel_material.young,
                          spec.wheel_material.poisson};
  for (const LayerSpec& layer : spec.layers) {
    const double numbers[] = {layer.on == BodyId::rail ? 0.0 : 1.0, layer.thickness, layer.material.young,
                              layer.material.poisson};
    out.insert(out.end(), std::begin(numbers), std::end(numbers));
    for (const ModulusPoint& point : layer.young_table) {
      out.push_back(point.depth);
      out.push_back(point.young);
    }
  }
  return out;
}

}  // namespace

/// The last contact, and what of it was computed since.
struct Explorer::State {
  std::optional<InfluenceCache> cache;
  std::vector<double> cached;  ///< stiffness of what the cache is for
  int uses = 0;                ///< of the cache
  std::optional<Request> of;
  LoadedCase loaded;
  Placement placement;
  Answer asked;
  std::optional<StressSections> sections;

  /// Operators of other layers are not needed again after a slider has moved. A cache that is begun anew keeps the
  /// memory bounded.
  InfluenceCache& cache_for(const CaseSpec& spec) {
    constexpr int kUses = 16;
    if (std::vector<double> stiffness = stiffness_of(spec); !cache || stiffness != cached || ++uses > kUses) {
      cache.emplace();
      cached = std::move(stiffness);
      uses = 0;
    }
    return *cache;
  }

  void solve(const Request& request) {
    of.reset();
    sections.reset();
    loaded = parse_case(request.text, request.file, request.overrides);
    require_support(uses::kExplorer, loaded);
    placement = place(loaded.spec, loaded.folder());
    BemOptions options;
    options.cell = request.cell;
    options.cache = &cache_for(loaded.spec);
    asked = solve_contact(loaded.spec, placement, {.bem = options});
    of = request;
  }

  /// As the files of `railstrata bem`: below the pressure's largest value.
  void add_section() {
    const BemResult& r = asked.result;
    const double deepest = depths_of_interest(r.rail, asked.summary.contact).deepest;
    if (!sections) sections = rail_sections(r, asked.summary.contact.patch.p_max_x, centre_line(r.field).y, deepest);
  }

  void complete(const Request& request) {
    if (!of || !of->same_contact(request)) solve(request);
    Wanted wanted = kContactAlone;
    wanted.rail = wanted.wheel = request.wants("stress");
    wanted.shakedown = request.wants("shakedown");
    judge(loaded.spec, wanted, asked);
    if (request.wants("section")) add_section();
  }

  Json head(const Request& request, std::vector<float>& numbers) {
    Json out{{"ok", true}};
    out["summary"] = summary_json(asked.summary);
    out["values"] = case_values(loaded.spec, request.values);
    out["layers"] = layers_json(loaded.spec);
    out["strengths"] = strength_to_judge(loaded.spec);
    out["doubts"] = doubts_json(asked.summary);
    out["excluded"] = excluded_keys(uses::kExplorer, loaded.spec);
    out["notes"] = notes_for(uses::kExplorer, loaded);
    for (const auto& further : {placement.doubts, placement.notes, asked.result.notes})
      for (const std::string& note : further) out["notes"].push_back(note);
    if (request.wants("case")) out["case"] = loaded.resolved_toml;
    if (request.wants("patch")) out["patch"] = patch_json(asked.result, numbers);
    if (request.wants("section") && sections) {
      out["section"] = section_json(sections->longitudinal, numbers);
      out["cross"] = section_json(sections->cross, numbers);
    }
    return out;
  }

  /// Faults of the solution get their places in the case.
  void complete_with_places(const Request& request) {
    try {
      complete(request);
    } catch (const CaseError& e) {
      const bool read = loaded.source_text == request.text && loaded.overrides == request.overrides;
      of.reset();
      throw read ? in_case_file(loaded, e) : e;
    }
  }

  ExplorerAnswer answer(const std::string& text) {
    const auto begin = std::chrono::steady_clock::now();
    ExplorerAnswer out;
    Json json{{"ok", false}};
    try {
      const Request request = request_of(text);
      complete_with_places(request);
      json = head(request, out.numbers);
      const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
      json["milliseconds"] = time.count();
    } catch (const CaseError& e) {
      json["faults"] = faults_json(e);
    } catch (const EnvironmentError& e) {
      json["faults"] = faults_json(CaseError(e.what(), e.remedy));
    } catch (const std::bad_alloc&) {
      json["faults"] = faults_json(CaseError("there is not enough memory", "take larger cells"));
    } catch (const std::exception& e) {
      json["faults"] = faults_json(CaseError(e.what()));
    }
    if (!json["ok"].get<bool>()) of.reset();
    out.head = json_text(json);
    return out;
  }
};

Explorer::Explorer() : state_(std::make_unique<State>()) {}
Explorer::~Explorer() = default;

ExplorerAnswer Explorer::answer(const std::string& request) noexcept { return state_->answer(request); }

}  // namespace railstrata
