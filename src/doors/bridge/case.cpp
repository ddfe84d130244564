#include <memory>

#include "bridge/records.hpp"
#include "core/parallel.hpp"
#include "io/provenance.hpp"
#include "options/case_schema.hpp"
#include "reader/case_file.hpp"
#include "rules/clashes.hpp"
#include "text/toml_document.hpp"
#include "text/units.hpp"

namespace railstrata::bridge {
namespace {

void answer_case(Call& call, LoadedCase loaded) {
  call.answer = {{"title", loaded.spec.title},
                 {"file", loaded.file.string()},
                 {"overrides", loaded.overrides},
                 {"source", loaded.source_text},
                 {"toml", loaded.resolved_toml},
                 {"notes", notes_for(uses::kAny, loaded)},
                 {"static_notes", notes_at_rest(loaded)},
                 {"not_in_fem", diagnostics(refused_by(uses::kFiniteElements, loaded))}};
  call.make(std::make_shared<LoadedCase>(std::move(loaded)));
}

void load(Call& call) { answer_case(call, load_case(call.text("file"), overrides_of(call.argument("overrides")))); }

void parse(Call& call) {
  answer_case(call, parse_case(call.text("text"), call.text("name"), overrides_of(call.argument("overrides"))));
}

Json value_of(const toml::node& node) {
  Json out;
  if (const toml::table* table = node.as_table()) {
    out = Json::object();
    for (const auto& [key, value] : *table) out[std::string(key.str())] = value_of(value);
  } else if (const toml::array* array = node.as_array()) {
    out = Json::array();
    for (const toml::node& one : *array) out.push_back(value_of(one));
  } else if (node.is_string()) {
    out = node.as_string()->get();
  } else if (node.is_boolean()) {
    out = node.as_boolean()->get();
  } else if (node.is_integer()) {
    out = node.as_integer()->get();
  } else {
    out = number(number_of(node));
  }
  return out;
}

/// Every key of the resolved case.
void values(Call& call) {
  const auto loaded = call.made<LoadedCase>("case");
  CaseSource source(loaded->file, loaded->resolved_toml);
  call.answer["values"] = value_of(toml_document(source));
}

/// m, of a text such as "0.2 mm"; `what` names it in messages.
void length(Call& call) {
  try {
    call.answer["metres"] = parse_quantity(call.text("text"), dimension::kLength);
  } catch (const UnitError& e) {
    throw CaseError(call.text("what") + ": " + e.what(), e.remedy);
  }
}

void schema(Call& call) { call.answer["schema"] = Json::parse(case_json_schema()); }

void version(Call& call) { call.answer = {{"version", build_info().version}, {"text", version_text()}}; }

void threads(Call& call) {
  if (call.whole("count") > 0) set_threads(call.whole("count"));
  call.answer["threads"] = max_threads();
}

}  // namespace

Functions case_functions() {
  return {{"load_case", load}, {"parse_case", parse}, {"case_values", values}, {"length", length},
          {"schema", schema},  {"version", version},  {"threads", threads}};
}

}  // namespace railstrata::bridge
