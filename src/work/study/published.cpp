#include "study/published.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "text/case_source.hpp"
#include "text/text_file.hpp"
#include "text/toml_reader.hpp"

namespace railstrata {
namespace {

constexpr const char* kExample = "see data/paper/published.toml for an example";

PublishedClaim read_claim(CaseSource& source, const toml::table& t) {
  TomlReader r(
      source, t,
      {"section", "text", "kind", "column", "along", "each", "unit", "factor", "limit", "given", "groups", "where"},
      kExample);
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
  return c;
}

}  // namespace

Published parse_published(const std::string& text, const std::filesystem::path& file) {
  CaseSource source(file, text);
  const toml::table document = toml_document(source);
  Published out;
  TomlReader top(source, document, {"source", "column", "number", "claim"}, kExample);
  out.source = top.text("source");
  for (const toml::table* t : tables(document, "column")) {
    TomlReader r(source, *t, {"name", "engine", "prefix"}, kExample);
    const std::string engine = r.text("engine", true);
    r.choice("engine", engine, engine_words());
    out.columns.push_back({r.text("name", true), engine_of(engine).value_or(Engine::fem), r.text("prefix")});
  }
  for (const toml::table* t : tables(document, "number")) {
    TomlReader r(source, *t,
                 {"section", "quantity", "value", "unit", "within", "column", "factor", "given", "against", "engines",
                  "bound", "other", "other_is", "only", "note"},
                 kExample);
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
  for (const toml::table* t : tables(document, "claim")) out.claims.push_back(read_claim(source, *t));
  source.finish();
  return out;
}

Published load_published(const std::filesystem::path& file) {
  return parse_published(read_text_file(file, "name it in the study: published = \"published.toml\""), file);
}

}  // namespace railstrata
