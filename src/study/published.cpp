#include "study/published.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "case/case_source.hpp"
#include "case/text_file.hpp"
#include "case/toml_document.hpp"

namespace railstrata {
namespace {

class Reader {
 public:
  Reader(CaseSource& source, const toml::table& t, std::vector<std::string> known) : source_(source), table_(t) {
    for (const auto& [key, node] : t)
      if (std::find(known.begin(), known.end(), std::string(key.str())) == known.end())
        source_.complain_at(place_of(node), fmt::format("unknown key {}", key.str()),
                            "see data/paper/published.toml for an example");
  }
  std::string text(const char* key, bool needed = false) {
    const toml::node* n = table_.get(key);
    if (n && n->is_string()) return n->as_string()->get();
    if (n || needed)
      source_.complain_at(n ? place_of(*n) : place_of(table_), fmt::format("{} must be a text", key),
                          fmt::format("write {} = \"…\"", key));
    return {};
  }
  double number(const char* key, double otherwise, bool needed = false) {
    const toml::node* n = table_.get(key);
    if (n && n->is_number() && std::isfinite(number_of(*n))) return number_of(*n);
    if (n || needed)
      source_.complain_at(n ? place_of(*n) : place_of(table_), fmt::format("{} must be a finite number", key),
                          fmt::format("write {} = 1.5", key));
    return otherwise;
  }
  bool flag(const char* key) { return table_[key].value_or(false); }
  std::vector<std::string> texts(const char* key) { return texts_of(table_.get(key)); }
  std::map<std::string, std::vector<std::string>> lists(const char* key) {
    std::map<std::string, std::vector<std::string>> out;
    if (const toml::table* t = table_[key].as_table())
      for (const auto& [name, node] : *t) out[std::string(name.str())] = texts_of(&node);
    return out;
  }
  void choice(const char* key, const std::string& value, const std::vector<std::string>& choices) {
    if (std::find(choices.begin(), choices.end(), value) == choices.end())
      source_.complain_at(table_.contains(key) ? place_of(*table_.get(key)) : place_of(table_),
                          fmt::format("{} = \"{}\" is unknown", key, value),
                          fmt::format("one of: {}", fmt::join(choices, ", ")));
  }

 private:
  static std::vector<std::string> texts_of(const toml::node* n) {
    std::vector<std::string> out;
    if (!n || !n->is_array()) return out;
    for (const toml::node& item : *n->as_array()) {
      if (item.is_string())
        out.push_back(item.as_string()->get());
      else if (item.is_number())
        out.push_back(fmt::format("{}", number_of(item)));
    }
    return out;
  }
  CaseSource& source_;
  const toml::table& table_;
};

std::vector<const toml::table*> tables(const toml::table& t, const char* key) {
  std::vector<const toml::table*> out;
  if (const toml::array* list = t[key].as_array())
    for (const toml::node& n : *list)
      if (n.is_table()) out.push_back(n.as_table());
  return out;
}

}  // namespace

Published parse_published(const std::string& text, const std::filesystem::path& file) {
  CaseSource source(file, text);
  const toml::table document = toml_document(source);
  Published out;
  Reader top(source, document, {"source", "column", "number", "claim"});
  out.source = top.text("source");
  for (const toml::table* t : tables(document, "column")) {
    Reader r(source, *t, {"name", "engine", "prefix"});
    const std::string engine = r.text("engine", true);
    r.choice("engine", engine, engine_words());
    out.columns.push_back({r.text("name", true), engine_of(engine).value_or(Engine::fem), r.text("prefix")});
  }
  for (const toml::table* t : tables(document, "number")) {
    Reader r(source, *t,
             {"section", "quantity", "value", "unit", "within", "column", "factor", "given", "against", "engines",
              "bound", "other", "other_is", "only", "note"});
    PublishedNumber n;
    n.section = r.text("section", true);
    n.quantity = r.text("quantity", true);
    n.unit = r.text("unit");
    n.column = r.text("column", true);
    n.given = r.text("given", true);
    n.against = r.text("against");
    n.bound = r.text("bound");
    n.other = r.text("other");
    n.other_is = r.text("other_is");
    n.note = r.text("note");
    n.value = r.number("value", 0, true);
    n.within = r.number("within", 0, n.bound.empty());
    n.factor = r.number("factor", 1);
    n.engines = r.flag("engines");
    n.only = r.texts("only");
    if (!n.bound.empty()) r.choice("bound", n.bound, {"at most", "at least"});
    out.numbers.push_back(std::move(n));
  }
  for (const toml::table* t : tables(document, "claim")) {
    Reader r(
        source, *t,
        {"section", "text", "kind", "column", "along", "each", "unit", "factor", "limit", "given", "groups", "where"});
    PublishedClaim c;
    c.section = r.text("section", true);
    c.text = r.text("text", true);
    c.kind = r.text("kind", true);
    c.column = r.text("column", true);
    c.along = r.text("along");
    c.each = r.text("each");
    c.unit = r.text("unit");
    c.given = r.text("given");
    c.factor = r.number("factor", 1);
    c.limit = r.number("limit", 0);
    c.groups = r.texts("groups");
    c.where = r.lists("where");
    r.choice("kind", c.kind, {"rises", "falls", "falls_then_rises", "above", "below"});
    out.claims.push_back(std::move(c));
  }
  source.finish();
  return out;
}

Published load_published(const std::filesystem::path& file) {
  return parse_published(read_text_file(file, "name it in the study: published = \"published.toml\""), file);
}

}  // namespace railstrata
