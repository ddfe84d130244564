#include "options/case_schema.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/certainty.hpp"
#include "friction/friction_conditions.hpp"
#include "options/option_table.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;

Json number_schema(const Option& option) {
  Json s{{"type", "number"}};
  if (std::isfinite(option.range.min)) s[option.range.open ? "exclusiveMinimum" : "minimum"] = option.range.min;
  if (std::isfinite(option.range.max)) s["maximum"] = option.range.max;
  return s;
}

Json quantity_schema(const Option& option) {
  Json text{{"type", "string"}, {"pattern", "^\\s*[-+]?[0-9.]"}};
  if (option.dimension == dimension::kNumber || option.dimension == dimension::kSlope)
    return {{"anyOf", {number_schema(option), text}}};
  return text;
}

struct TypeSchema {
  const Option& option;
  Json operator()(const double*) const { return quantity_schema(option); }
  Json operator()(const std::optional<double>*) const { return quantity_schema(option); }
  Json operator()(const int*) const {
    Json s = number_schema(option);
    s["type"] = "integer";
    return s;
  }
  Json operator()(const bool*) const { return {{"type", "boolean"}}; }
  Json operator()(const std::string*) const { return {{"type", "string"}}; }
  Json operator()(const ChoiceSlot&) const { return {{"type", "string"}, {"enum", choices_of(option)}}; }
  Json operator()(const RowsSlot&) const {
    if (option.form == RowForm::one_named) return named_schema();
    if (option.form == RowForm::named) return {{"type", "array"}, {"items", named_schema()}};
    const std::size_t width = option.columns.size();
    const bool ranges = option.form == RowForm::ranges, texts = ranges || option.form == RowForm::by_depth;
    const Json item = texts ? Json{{"type", "string"}} : Json{{"type", {"string", "number"}}};
    return {{"type", "array"},
            {"minItems", ranges ? 0 : 2},
            {"items", {{"type", "array"}, {"minItems", width}, {"maxItems", width}, {"items", item}}}};
  }
  Json operator()(const std::vector<double>*) const {
    return {{"type", "array"}, {"minItems", 1}, {"items", quantity_schema(option)}};
  }
  Json named_schema() const {
    Json s{{"type", "object"}, {"additionalProperties", false}};
    for (const Option& column : option.columns) {
      s["properties"][std::string(column.key)] = quantity_schema(column);
      s["required"].push_back(column.key);
    }
    return s;
  }
};

std::string allowed(const Option& option) {
  return option.choices.empty() ? describe(option.range, option.dimension)
                                : fmt::format("`{}`", fmt::join(choices_of(option), "`, `"));
}

/// A layer's modulus has no default: it must be given.
std::string default_text(const OptionTable& table, const Option& option, CaseSpec& spec) {
  return option.derivation || (table.repeated && option.key.starts_with("young")) ? "" : toml_value(option, spec, 0);
}

Json option_schema(const OptionTable& table, const Option& option, CaseSpec& spec) {
  Json s = std::visit(TypeSchema{option}, option.slot(spec, 0));
  const std::string range = option.choices.empty() ? allowed(option) : "";
  const std::string value = default_text(table, option, spec);
  s["description"] =
      fmt::format("{}{}. Default: {}", option.doc, range.empty() ? "" : "; " + range, value.empty() ? "none" : value);
  return s;
}

Json table_schema(const OptionTable& table, CaseSpec& spec) {
  Json s{{"type", "object"}, {"description", table.doc}, {"additionalProperties", false}};
  for (const Option& option : table.options)
    s["properties"][std::string(option.key)] = option_schema(table, option, spec);
  if (table.repeated) return {{"type", "array"}, {"description", table.doc}, {"items", s}};
  return s;
}

constexpr const char* kAboutTransient =
    "\nEvery key from `at_distance` on is a column: a list with one value per row, linear between rows; two rows at "
    "the same\nplace make a jump. For kind = \"rolling\" a row is placed by `at_distance` or `at_time`, and the first "
    "is at 0. A quantity\nwithout a column keeps its value from [drive]. A shift starts at rest under the first row's "
    "load and goes from row to row;\na direction without a column does not move. `history_file` has these columns, "
    "named with units (`distance [mm]` or\n`distance_mm`), one line per row, separated by commas, semicolons or tabs; "
    "with semicolons or tabs, decimal commas are\nallowed (`2,5; 102`). Method and results: "
    "[docs/bem.md](bem.md#transients). Signs:\n[conventions](conventions.md#axes-and-signs).\n";

std::string about_conditions() {
  std::string out =
      "\n| `condition` | coefficient at rest (range) | slip | film | certainty |\n|---|---|---|---|---|\n";
  for (const FrictionCondition& c : friction_conditions()) {
    const std::string falls = c.law.falls() ? fmt::format("falls to {:.2g}, half at {:.3g} m/s",
                                                          c.law.kinetic_share * c.coefficient, c.law.half_velocity)
                                            : "",
                      film = c.film.thickness > 0
                                 ? fmt::format(
                                       "{:.4g} MPa/um{}", 1e-12 / c.film.flexibility(),
                                       c.film.yields()
                                           ? fmt::format(", yields at {:g} MPa{}", 1e-6 * c.film.yield_shear,
                                                         c.film.hardening == 0
                                                             ? ""
                                                             : fmt::format(", {:+g} MPa/mm", 1e-9 * c.film.hardening))
                                           : "")
                                 : "";
    out += fmt::format("| `{}` | {:g}{} | {} | {} | {}: {} |\n", c.name, c.coefficient,
                       c.low < c.high ? fmt::format(" ({:g} to {:g})", c.low, c.high) : "", falls, film,
                       certainty_text(c.certainty), c.source);
  }
  return out;
}

/// Text below a table, on how values of more than one number are written.
std::string more_about(const OptionTable& table) {
  if (table.name == "geometry")
    return "\n`rail_profile` and `wheel_profile` also take an arc: `\"arc:R=200 mm\"` is convex with this radius, "
           "`R=-450 mm` hollow.\n`\"flat\"` is a plane. Both are 60 mm wide unless `W=` gives another width: "
           "`\"flat:W=10 mm\"`,\n`\"arc:R=300 mm, W=10 mm\"`. Profile files: "
           "[data/profiles](../data/profiles/README.md).\n";
  if (table.name == "vehicle")
    return "\nThe static load of the wheel on the rail is G = (wheel_mass + sprung_mass) g. `wheel_load` and "
           "`axle_load` set\n`sprung_mass` so that G equals the load; in a rolling finite element case that mass is "
           "carried by the suspension.\nLoads are written as forces (`\"110 kN\"`) or masses (`\"11.2 t\"`). Give at "
           "most one of `sprung_mass`, `wheel_load`,\n`axle_load` and `approach`. With `approach` the load is a "
           "result, and the traction coefficients of [drive] refer to\nthat load.\n";
  if (table.name == "drive")
    return "\nAlong the rail give at most one of `traction_coefficient`, `tractive_force` and `creepage`; across it at "
           "most one of\n`lateral_traction_coefficient`, `lateral_force` and `lateral_creepage`. What is not given "
           "follows from the geometry:\nthe lateral creepage from the yaw, the spin from the contact angle and the "
           "curve. A key given with `--set` replaces the\nfile's other keys of the same group. Finite elements accept "
           "creepages up to ±0.1; a given spin needs the half-space\nengine (`railstrata bem`). Signs: "
           "[conventions](conventions.md#axes-and-signs).\n";
  if (table.name == "friction") return about_conditions();
  if (table.name == "transient") return kAboutTransient;
  if (table.name == "collective")
    return "\nThe columns of the file are the keys of [[load]], named with units (`wheel_load [kN]` or "
           "`wheel_load_kN`), one line per\nrow; an empty cell means the value of the case. Results: "
           "[docs/damage.md](damage.md#load-collectives).\n";
  if (table.name == "layer")
    return "\n`young_table` gives Young's modulus as a function of depth, row by row from the layer's top, linear "
           "between rows:\n\n```toml\n[[layer]]\nname = \"graded\"\nyoung_table = [[\"0 mm\", \"240 GPa\"], [\"1 mm\", "
           "\"225 GPa\"], [\"3 mm\", \"210 GPa\"]]\n```\n\nThe first depth is 0 mm, the last one the layer's "
           "thickness; for a jump of the modulus write two layers.\n";
  return "";
}

}  // namespace

std::string case_json_schema() {
  CaseSpec spec = one_of_each();
  Json root{{"$schema", "http://json-schema.org/draft-07/schema#"},
            {"title", "RailStrata case"},
            {"type", "object"},
            {"additionalProperties", false}};
  for (const OptionTable& table : case_tables()) {
    const std::string name(table.name);
    const auto dot = name.find('.');
    if (dot == std::string::npos) {
      root["properties"][name] = table_schema(table, spec);
    } else {
      Json& group = root["properties"][name.substr(0, dot)];
      group["type"] = "object";
      group["additionalProperties"] = false;
      group["properties"][name.substr(dot + 1)] = table_schema(table, spec);
    }
  }
  return root.dump(2) + "\n";
}

std::string case_reference_markdown() {
  CaseSpec spec = one_of_each();
  std::string out =
      "# Case file reference\n\n"
      "<!-- Written by `railstrata info --schema --markdown` from src/case/options/option_table.cpp; a test holds this "
      "page "
      "against "
      "the program. -->\n\n"
      "A case is a TOML file. Every key has a default, so a case gives only what differs. "
      "A value with a dimension is a text\n"
      "with its unit (`\"210 GPa\"`, `\"0.2 mm\"`, `\"100 km/h\"`, `\"10.4 kN s/m\"`); inclinations are written "
      "`\"1:40\"`,\n"
      "`\"1/40\"`, `\"25 mrad\"` or as a bare tangent; plain numbers may be given in per cent (`\"20 %\"`).\n\n"
      "`--set table.key=value` overrides a key on the command line, `--set layer.0.key=value` one of the first layer; "
      "the\n"
      "index after the last adds a layer, `--set layer=[{...}]` gives all of them.\n";
  for (const OptionTable& table : case_tables()) {
    out +=
        fmt::format("\n## {}{}{}\n\n{}.\n{}\n| key | default | allowed | meaning |\n|---|---|---|---|\n",
                    table.repeated ? "[[" : "[", table.name, table.repeated ? "]]" : "]", table.doc, more_about(table));
    for (const Option& option : table.options) {
      const std::string value = default_text(table, option, spec);
      const std::string example = option.example.empty() ? "" : fmt::format(": `{}`", option.example);
      out += fmt::format("| `{}` | {} | {} | {}{} |\n", option.key, value.empty() ? value : "`" + value + "`",
                         allowed(option), option.doc, example);
    }
  }
  return out;
}

}  // namespace railstrata
