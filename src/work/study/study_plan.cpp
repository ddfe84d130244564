#include "study/study_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <sstream>

#include "core/faults.hpp"
#include "io/output_folder.hpp"
#include "io/provenance.hpp"
#include "many/axis.hpp"

namespace railstrata {
namespace {

/// The last part of a key, or all of it where two keys of the group end alike.
std::string short_name(const std::string& key, const StudyPoint& point) {
  const auto alike = std::count_if(point.begin(), point.end(),
                                   [&](const StudyValue& v) { return last_part(v.key) == last_part(key); });
  return alike > 1 ? key : last_part(key);
}

std::string name_of(const StudyPoint& point) {
  std::string out;
  for (const StudyValue& v : point)
    out += fmt::format("{}{} {}", out.empty() ? "" : ", ", short_name(v.key, point), shown_value(v.text));
  return out.empty() ? "case" : out;
}

/// A folder's name: letters, digits, dot and minus as they are, what stands between as one _.
std::string folder_name(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+';
    if (plain)
      out += c;
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (!out.empty() && (out.back() == '_' || out.back() == '.')) out.pop_back();
  return out;
}

/// The value that a --set gives a key, as a study has values: without quotes.
std::optional<std::string> set_instead(const std::vector<std::string>& overrides, const std::string& key) {
  std::optional<std::string> out;
  for (const std::string& o : overrides)
    if (o.starts_with(key + "=")) out = o.substr(key.size() + 1);
  if (out && out->size() > 1 && out->front() == '"' && out->back() == '"') out = out->substr(1, out->size() - 2);
  return out;
}

/// An error at an override becomes one at the value's place in the study.
void add_placed(const CaseError& e, const LoadedStudy& study, const std::vector<const StudyValue*>& values,
                const std::vector<std::string>& texts, std::vector<Diagnostic>& out) {
  for (Diagnostic d : e.diagnostics) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      const std::string said = "--set " + texts[k];
      if (d.where != said && !d.message.starts_with(said + ":")) continue;
      if (d.message.starts_with(said + ":")) d.message = values[k]->key + d.message.substr(said.size());
      d.where = fmt::format("{}:{}:{}", study.file.string(), values[k]->place.line, values[k]->place.column);
      d.remedy = d.remedy.starts_with("write --set")
                     ? "write the key as \"table.key\", or \"layer.0.key\" for the first layer of the base case"
                     : d.remedy;
    }
    const auto same = std::find_if(out.begin(), out.end(),
                                   [&](const Diagnostic& o) { return o.where == d.where && o.message == d.message; });
    if (same == out.end()) out.push_back(std::move(d));
  }
}

/// Hash of everything that a result depends on: engine, kResultVersion, the resolved case without its title (profile
/// files by their content), and of the half-space engine the cell size.
std::string result_key(const LoadedCase& loaded, Engine engine, const std::string& cell) {
  std::string text = fmt::format("{} {} {}\n", engine_word(engine), kResultVersion, engine == Engine::fem ? "" : cell);
  std::istringstream lines(case_by_content(loaded));
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with("title = ")) text += line + '\n';
  return sha256_of(text);
}

StudyCase by_engine(StudyCase c, Engine engine, const std::string& cell) {
  if (engine == Engine::sections) {
    c.overrides.emplace_back("bem.bodies=\"sections\"");
    c.loaded = with_overrides(c.loaded, {c.overrides.back()});
  }
  c.chosen_as = engine;
  c.engine = engine == Engine::bem && c.loaded.spec.bem.bodies == ContactBodies::sections ? Engine::sections : engine;
  c.key = result_key(c.loaded, c.engine, cell);
  c.own_folder = std::filesystem::path(c.group) / folder_name(c.name) / engine_word(c.engine);
  return c;
}

}  // namespace

std::string last_part(const std::string& key) { return key.substr(key.rfind('.') + 1); }

std::vector<StudyCase> plan_study(const LoadedStudy& study, const std::vector<std::string>& overrides) {
  std::vector<StudyCase> out;
  std::vector<Diagnostic> faults;
  for (const StudyGroup& g : study.spec.groups) {
    for (const StudyPoint& point : g.points) {
      StudyCase c;
      c.group = g.name;
      c.name = name_of(point);
      std::vector<const StudyValue*> values;
      for (const StudyPoint* part : {&g.set, &point})
        for (const StudyValue& v : *part) {
          values.push_back(&v);
          c.overrides.push_back(v.key + "=" + v.toml);
        }
      const std::vector<std::string> texts = c.overrides;
      c.overrides.insert(c.overrides.end(), overrides.begin(), overrides.end());
      c.overrides.push_back(fmt::format("case.title=\"{}: {}\"", g.name, c.name));
      for (const StudyPoint* part : {&point, &g.tags})
        for (const StudyValue& v : *part) c.values.emplace_back(v.key, set_instead(overrides, v.key).value_or(v.text));
      try {
        c.loaded = load_case(g.base, c.overrides);
      } catch (const CaseError& e) {
        add_placed(e, study, values, texts, faults);
        continue;
      }
      for (const Engine e : g.engines) out.push_back(by_engine(c, e, study.spec.cell));
    }
  }
  if (!faults.empty()) throw CaseError(std::move(faults));
  std::map<std::string, std::filesystem::path> owner;
  std::map<std::filesystem::path, std::string> taken;
  for (StudyCase& c : out) {
    if (const auto [at, is_new] = taken.emplace(c.own_folder, c.key);
        !is_new && at->second != c.key)  // "1 mm" and "1_mm"
      c.own_folder =
          c.own_folder.parent_path().string() + "-" + c.key.substr(0, 8) + "/" + std::string(engine_word(c.engine));
    const auto [known, is_new] = owner.emplace(c.key, c.own_folder);
    c.first = is_new;
    c.folder = known->second;
  }
  return out;
}

std::vector<bool> chosen(const LoadedStudy& study, const std::vector<StudyCase>& cases, std::optional<Engine> engine,
                         const std::vector<std::string>& groups, const Shard& shard) {
  for (const std::string& wanted : groups)
    if (std::none_of(study.spec.groups.begin(), study.spec.groups.end(),
                     [&](const StudyGroup& g) { return g.name == wanted; })) {
      std::vector<std::string> names;
      for (const StudyGroup& g : study.spec.groups) names.push_back(g.name);
      throw CaseError(fmt::format("--group {}: the study has no such group", wanted),
                      fmt::format("groups: {}", fmt::join(names, ", ")));
    }
  std::vector<bool> out;
  std::set<std::string> keys;  // a case may be wanted under the name of a later twin
  for (const StudyCase& c : cases)
    if ((!engine || c.chosen_as == *engine) &&
        (groups.empty() || std::find(groups.begin(), groups.end(), c.group) != groups.end()))
      keys.insert(c.key);
  int n = 0;
  for (const StudyCase& c : cases)
    out.push_back(c.first && keys.contains(c.key) && n++ % shard.count == shard.index - 1);
  return out;
}

std::vector<bool> only(const std::vector<StudyCase>& cases, int index, const std::vector<bool>& among) {
  if (index < 1 || index > static_cast<int>(cases.size()))
    throw CaseError(fmt::format("--only {}: the study has {} cases", index, cases.size()),
                    "railstrata study FILE --list gives their indices");
  const std::string& key = cases[static_cast<std::size_t>(index) - 1].key;
  std::vector<bool> out;
  for (std::size_t k = 0; k < cases.size(); ++k) out.push_back(among[k] && cases[k].key == key);
  if (std::find(out.begin(), out.end(), true) == out.end())
    throw CaseError(fmt::format("--only {}: --engine, --group or --shard leave this case out", index),
                    "give --only without them; railstrata study FILE --list gives the indices");
  return out;
}

std::vector<std::string> varied_and_set(const LoadedStudy& study, const std::vector<std::string>& overrides) {
  std::vector<std::string> out;
  for (const StudyGroup& g : study.spec.groups)
    for (const StudyPoint& point : g.points)
      for (const StudyValue& v : point)
        if (set_instead(overrides, v.key) && std::find(out.begin(), out.end(), v.key) == out.end())
          out.push_back(v.key);
  return out;
}

Shard parse_shard(const std::string& text) {
  Shard s;
  const char *at = text.data(), *end = at + text.size();
  const auto index = std::from_chars(at, end, s.index);
  const bool slash = index.ec == std::errc{} && index.ptr != end && *index.ptr == '/';
  const auto count =
      slash ? std::from_chars(index.ptr + 1, end, s.count) : std::from_chars_result{end, std::errc::invalid_argument};
  if (count.ec != std::errc{} || count.ptr != end || s.count < 1 || s.index < 1 || s.index > s.count)
    throw CaseError(fmt::format("--shard {}: is not i/n with 1 ≤ i ≤ n", text),
                    "write --shard 2/8 for the second of eight parts");
  return s;
}

}  // namespace railstrata
