#include "study/study_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "core/nearest_word.hpp"
#include "many/axis.hpp"
#include "many/result_columns.hpp"
#include "options/option_table.hpp"
#include "tables/contact_input.hpp"
#include "text/text_file.hpp"
#include "text/toml_reader.hpp"

namespace railstrata {
namespace {

/// On one line, as an override takes it.
std::string toml_text(const toml::node& node) {
  if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
  if (const auto* words = node.as_string()) return toml_quoted(words->get());
  if (const auto* list = node.as_array()) {
    std::vector<std::string> items;
    for (const toml::node& item : *list) items.push_back(toml_text(item));
    return fmt::format("[{}]", fmt::join(items, ", "));
  }
  std::ostringstream out;
  node.visit([&](const auto& n) { out << n; });
  return out.str();
}

std::string plain_text(const toml::node& node) { return node.is_string() ? node.as_string()->get() : toml_text(node); }

class StudyReader {
 public:
  StudyReader(CaseSource& source, StudySpec& spec) : source_(source), spec_(spec) {}

  void read(const toml::table& document) {
    keys_of(document, "", {"study", "group", "figure"});
    if (const toml::table* study = table_at(document, "study", "[study]"))
      read_study(*study);
    else if (!document.contains("study"))
      source_.complain_at({1, 1}, "there is no [study]", "begin with [study] and base = \"case.toml\" below it");
    for (const toml::table* t : tables(source_, document, "group")) read_group(*t);
    for (const toml::table* t : tables(source_, document, "figure")) read_figure(*t);
    if (spec_.groups.empty() && !document.contains("group"))
      source_.complain_at({1, 1}, "the study has no [[group]] of cases",
                          "write [[group]], name = \"layers\", and below it [group.vary] with \"layer.0.thickness\" = "
                          "[\"1 mm\", \"2 mm\"]");
  }

 private:
  void read_study(const toml::table& t) {
    TomlReader r = keys_of(t, "study", {"title", "base", "engines", "cell", "set"}, "published");
    if (const auto published = t.find("published"); published != t.end())
      source_.complain_at(place_of(published->first), "a study is no longer compared with published numbers",
                          "take the key out; `railstrata validate` compares: a set whose series has recorded = "
                          "\"study.csv\" (docs/validate.md)");
    spec_.title = r.text_or("title", source_.file().stem().string());
    spec_.cell = r.text("cell");
    if (const double cell = spec_.cell.empty() ? 1 : r.quantity("cell", dimension::kLength, 1);
        !(cell > 0 && std::isfinite(cell)))
      source_.complain_at(place_of(*t.get("cell")), fmt::format("cell = \"{}\": must be above 0 mm", spec_.cell),
                          "write a length, e.g. \"0.5 mm\"");
    base_ = file(t, r, "base");
    engines_ = engines_of(t, r, engines_);
    set_ = values_at(t, "set");
  }

  void read_group(const toml::table& t) {
    TomlReader r = keys_of(t, "group", {"name", "title", "base", "engines", "set", "tags", "vary", "zip", "case"});
    StudyGroup g;
    g.name = r.text("name");
    g.title = r.text_or("title", g.name);
    const bool plain = !g.name.empty() &&
                       g.name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.") ==
                           std::string::npos &&
                       g.name[0] != '.' && g.name[0] != '-';
    if (!plain)
      source_.complain_at(
          t.contains("name") ? place_of(*t.get("name")) : place_of(t),
          fmt::format("group.name = \"{}\": must be a word of letters, digits, _ - and .: folders bear it", g.name),
          "write name = \"layers\"");
    else if (const std::string end = std::filesystem::path(g.name).extension().string();
             end == ".csv" || end == ".html" || end == ".json" || end == ".toml")
      source_.complain_at(place_of(*t.get("name")),
                          fmt::format("group.name = \"{}\": a file of the study may have this name", g.name),
                          "leave the ending out: folders bear the name");
    else if (!names_.insert(g.name).second)
      source_.complain_at(place_of(*t.get("name")), fmt::format("there are two groups named \"{}\"", g.name),
                          "give each group its own name");
    g.base = t.contains("base") ? file(t, r, "base") : base_;
    if (g.base.empty() && !t.contains("base"))
      source_.complain_at(place_of(t), fmt::format("group \"{}\" has no base case", g.name),
                          "write base = \"case.toml\" in it or in [study]");
    g.engines = engines_of(t, r, engines_);
    g.set = set_;
    for (const StudyValue& v : values_at(t, "set")) put(g.set, v);
    g.tags = values_at(t, "tags");
    g.points = points_of(t);
    spec_.groups.push_back(std::move(g));
  }

  void read_figure(const toml::table& t) {
    TomlReader r =
        keys_of(t, "figure",
                {"id", "title", "note", "kind", "value", "each", "series", "x", "y", "groups", "engines", "where"});
    StudyFigure f;
    f.id = r.text_or("id", fmt::format("figure-{}", spec_.figures.size() + 1));
    f.title = r.text_or("title", f.id);
    f.note = r.text("note");
    f.kind = r.text("kind");
    r.choice("kind", f.kind, {"centre_line", "trend", "map", "verdict", "grid"});
    if (f.kind != "verdict") f.value = r.text_or("value", f.kind == "trend" || f.kind == "grid" ? "p_max_MPa" : "");
    if (f.kind == "centre_line") r.choice("value", f.value, {"p", "q"});
    if (f.kind == "map") r.choice("value", f.value, {"state", "von_mises", "sigma_1"});
    if (f.kind == "trend" || f.kind == "grid") check_column(t, f);
    f.each = r.text("each");
    f.series = r.text("series");
    f.x = r.text("x");
    f.y = r.text("y");
    if ((f.kind == "verdict" || f.kind == "grid") && (f.x.empty() || f.y.empty()))
      source_.complain_at(place_of(t),
                          fmt::format("figure \"{}\" shows {} over two keys and has no {}", f.id,
                                      f.kind == "verdict" ? "verdicts" : "a value", f.x.empty() ? "x" : "y"),
                          "name both: x = \"layer.0.thickness\", y = \"layer.0.young_ratio\"");
    if (f.kind == "trend" && f.x.empty())
      source_.complain_at(place_of(t), fmt::format("figure \"{}\" is a trend and has no x", f.id),
                          "name the key along its axis: x = \"layer.0.thickness\"");
    if (f.kind == "trend" && takes_no_number(f.x))
      source_.complain_at(place_of(*t.get("x")),
                          fmt::format("figure \"{}\" is a trend over {}, which takes no number", f.id, f.x),
                          "make it the series of the trend, or draw kind = \"grid\" over two keys");
    f.groups = r.texts("groups");
    for (const std::string& g : f.groups)
      if (!names_.contains(g))
        source_.complain_at(place_of(*t.get("groups")), fmt::format("figure \"{}\": there is no group \"{}\"", f.id, g),
                            fmt::format("groups: {}", fmt::join(names_, ", ")));
    if (f.groups.empty()) f.groups.assign(names_.begin(), names_.end());
    f.engines = engines_of(t, r, engines_);
    for (const auto& key : keyed_lists(t, "where")) {
      std::vector<std::string>& texts = f.where[key.front().key];
      texts.clear();
      for (const StudyValue& v : key) texts.push_back(v.text);
    }
    spec_.figures.push_back(std::move(f));
  }

  void check_column(const toml::table& t, const StudyFigure& f) {
    if (find_column(f.value)) return;
    std::vector<std::string> names;
    for (const auto& columns : {result_columns(true), study_columns()})
      for (const ResultColumn& c : columns) names.push_back(c.name);
    const std::string near = nearest_word(f.value, names);
    source_.complain_at(
        place_of(t.contains("value") ? *t.get("value") : t),
        fmt::format("figure \"{}\": a study's table has no column \"{}\"", f.id, f.value),
        near.empty() ? "docs/results-reference.md lists the columns" : fmt::format("did you mean \"{}\"?", near));
  }

  // ---- cases of a group
  std::vector<StudyPoint> points_of(const toml::table& t) {
    std::vector<StudyPoint> out(1);
    std::set<std::string> seen;
    const auto once = [&](const StudyValue& v) {
      if (!seen.insert(v.key).second)
        source_.complain_at(v.place, fmt::format("{} is varied twice in this group", v.key),
                            "name a key once, in vary, zip or case");
    };
    for (const auto& key : keyed_lists(t, "vary")) {
      once(key.front());
      std::vector<StudyPoint> one;
      for (const StudyValue& v : key) one.push_back({v});
      out = product(out, one, t);
    }
    const std::vector<std::vector<StudyValue>> zipped = keyed_lists(t, "zip");
    if (!zipped.empty()) {
      std::vector<StudyPoint> rows(zipped.front().size());
      for (const auto& key : zipped) {
        once(key.front());
        if (key.size() != rows.size()) {
          source_.complain_at(
              key.front().place,
              fmt::format("{} has {} values and {} has {}: what is zipped goes together, value by value",
                          key.front().key, key.size(), zipped.front().front().key, rows.size()),
              "give every key of [group.zip] equally many values, or put it into [group.vary]");
          continue;
        }
        for (std::size_t i = 0; i < rows.size(); ++i) rows[i].push_back(key[i]);
      }
      out = product(out, rows, t);
    }
    std::vector<StudyPoint> listed;
    for (const toml::table* row : tables(source_, t, "case")) {
      listed.emplace_back();
      flatten(*row, "", listed.back());
      if (listed.back().empty())
        source_.complain_at(place_of(*row), "this case of the list sets nothing",
                            "write [[group.case]] and key = value below it");
    }
    return listed.empty() ? out : product(out, listed, t);
  }

  std::vector<StudyPoint> product(const std::vector<StudyPoint>& a, const std::vector<StudyPoint>& b,
                                  const toml::table& group) {
    std::vector<StudyPoint> out;
    if (a.size() * b.size() > kMostCases) {
      source_.complain_at(place_of(group), fmt::format("this group has more than {} cases", kMostCases),
                          "vary fewer keys at once, or give fewer values");
      return {};  // nothing more to complain of
    }
    for (const StudyPoint& left : a)
      for (const StudyPoint& right : b) {
        out.push_back(left);
        out.back().insert(out.back().end(), right.begin(), right.end());
      }
    return out;
  }

  static void put(StudyPoint& values, const StudyValue& v) {
    const auto same = std::find_if(values.begin(), values.end(), [&](const StudyValue& w) { return w.key == v.key; });
    if (same == values.end())
      values.push_back(v);
    else
      *same = v;
  }

  // ---- pieces of the text
  /// "layer.0.thickness" in quotes is one key, layer.0.thickness without is a table in a table: the same to the reader.
  template <class Leaf>
  void each_key(const toml::table& t, const std::string& prefix, Leaf&& leaf) {
    std::vector<std::pair<const toml::key*, const toml::node*>> ordered;
    for (const auto& [key, node] : t) ordered.emplace_back(&key, &node);
    const auto at = [](const auto& e) {
      return std::pair(e.first->source().begin.line, e.first->source().begin.column);
    };
    std::stable_sort(ordered.begin(), ordered.end(), [&](const auto& a, const auto& b) { return at(a) < at(b); });
    for (const auto& [key, node] : ordered) {
      const std::string full = prefix.empty() ? std::string(key->str()) : prefix + "." + std::string(key->str());
      if (const toml::table* inner = node->as_table())
        each_key(*inner, full, leaf);
      else
        leaf(full, *key, *node);
    }
  }

  void flatten(const toml::table& t, const std::string& prefix, StudyPoint& out) {
    each_key(t, prefix, [&](const std::string& word, const toml::key& key, const toml::node& node) {
      const std::string full = axis_key(word);
      if (check_key(full, key)) out.push_back({full, plain_text(node), toml_text(node), place_of(node)});
    });
  }

  bool check_key(const std::string& full, const toml::key& key) {
    if (full.find('.') != std::string::npos) return true;
    source_.complain_at(place_of(key), fmt::format("{} names no table of the case", full),
                        "write \"table.key\", e.g. \"drive.speed\" or \"layer.0.thickness\"");
    return false;
  }

  StudyPoint values_at(const toml::table& t, const char* name) {
    StudyPoint out;
    if (const toml::table* inner = table_at(t, name, fmt::format("[group.{}]", name))) flatten(*inner, "", out);
    return out;
  }

  std::vector<std::vector<StudyValue>> keyed_lists(const toml::table& t, const char* name) {
    std::vector<std::vector<StudyValue>> out;
    const toml::table* inner = table_at(t, name, fmt::format("[group.{}]", name));
    if (!inner) return out;
    each_key(*inner, "", [&](const std::string& word, const toml::key& key, const toml::node& node) {
      const std::string full = axis_key(word);
      if (!check_key(full, key)) return;
      std::vector<StudyValue> values = values_of(full, node);
      if (values.empty())
        return source_.complain_at(place_of(node),
                                   fmt::format("{} under {}: must be a list of at least one value", full, name),
                                   fmt::format("write \"{}\" = [{}], or put a single value into [group.set]", full,
                                               node.is_array() ? "value, value" : toml_text(node)));
      for (std::size_t i = 0; i < values.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          if (values[i].toml == values[j].toml)
            source_.complain_at(values[i].place, fmt::format("{} has the value {} twice", full, values[i].toml),
                                "leave one out");
      out.push_back(std::move(values));
    });
    return out;
  }

  /// The values of a list, or of a range given as a text (many/axis.hpp).
  std::vector<StudyValue> values_of(const std::string& key, const toml::node& node) {
    std::vector<StudyValue> out;
    if (const toml::array* list = node.as_array())
      for (const toml::node& item : *list) out.push_back({key, plain_text(item), toml_text(item), place_of(item)});
    if (!node.is_string()) return out;
    try {
      const Axis axis = make_axis(key, {plain_text(node)});
      if (axis.values.size() > 1)
        for (const std::string& value : axis.values) out.push_back({key, value, value, place_of(node)});
    } catch (const CaseError& e) {
      source_.complain_at(place_of(node), e.diagnostics.front().message, e.diagnostics.front().remedy);
    }
    return out;
  }

  /// gone: a key that was one once, and of which the caller complains.
  TomlReader keys_of(const toml::table& t, const std::string& name, std::vector<std::string> keys,
                     const std::string& gone = {}) {
    const std::string all = fmt::format(
        "{}: {}", name.empty() ? "tables of a study" : fmt::format("keys of [{}]", name), fmt::join(keys, ", "));
    if (!gone.empty()) keys.push_back(gone);
    return {source_, t, keys, all, name};
  }

  const toml::table* table_at(const toml::table& t, const char* key, const std::string& remedy) {
    const toml::node* node = t.get(key);
    if (!node) return nullptr;
    if (!node->is_table())
      source_.complain_at(place_of(*node), fmt::format("{} must be a table", key),
                          fmt::format("write {} above its keys", remedy));
    return node->as_table();
  }

  std::vector<Engine> engines_of(const toml::table& t, TomlReader& r, const std::vector<Engine>& otherwise) {
    if (!t.contains("engines")) return otherwise;
    std::vector<Engine> out;
    for (const std::string& word : r.texts("engines"))
      if (const auto engine = engine_of(word))
        out.push_back(*engine);
      else
        source_.complain_at(
            place_of(*t.get("engines")), fmt::format("engines: there is no engine \"{}\"", word),
            fmt::format("write engines = [\"{}\"], or some of them", fmt::join(engine_words(), "\", \"")));
    return out;
  }

  /// Relative to the study's folder.
  std::filesystem::path file(const toml::table& t, TomlReader& r, const char* key) {
    const std::string name = r.text(key);
    const toml::node* node = t.get(key);
    if (!node || !node->is_string()) return {};
    if (name.empty()) {
      source_.complain_at(place_of(*node), fmt::format("{} = \"\": names no file", key),
                          "name one relative to the study's folder, or leave the key out");
      return {};
    }
    std::filesystem::path path = source_.file().parent_path() / name;
    std::error_code error;  // a name too long, a folder that may not be read: no file to us
    if (std::filesystem::is_directory(path, error)) path /= "case.toml";
    const std::optional<ContactInputName> input = contact_input_name(path);
    if (name.find('\0') == std::string::npos && std::filesystem::is_regular_file(input ? input->file : path, error))
      return path;
    source_.complain_at(place_of(*node), fmt::format("{} = \"{}\": there is no file {}", key, name, path.string()),
                        "name it relative to the study's folder");
    return {};
  }

  CaseSource& source_;
  StudySpec& spec_;
  std::filesystem::path base_;
  std::vector<Engine> engines_{Engine::fem, Engine::bem};
  StudyPoint set_;
  std::set<std::string> names_;
};

}  // namespace

LoadedStudy parse_study(const std::string& text, const std::filesystem::path& file) {
  LoadedStudy loaded{{}, file, text};
  CaseSource source(file, text);
  const toml::table document = toml_document(source);
  StudyReader(source, loaded.spec).read(document);
  source.finish();
  return loaded;
}

LoadedStudy load_study(const std::filesystem::path& file) {
  return parse_study(read_text_file(file, "shipped studies stand in cases/, e.g. cases/paper/study.toml"), file);
}

}  // namespace railstrata
