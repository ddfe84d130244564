#include "report/result_reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "judge/check_limits.hpp"
#include "judge/judgement.hpp"
#include "passes/rolled_pass.hpp"
#include "record/json.hpp"
#include "result/result_table.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;

std::string_view engine_word_of(AvailableIn engine) {
  return engine == AvailableIn::both_engines ? "" : engine == AvailableIn::finite_elements ? "fem" : "bem";
}

constexpr std::string_view kKindWords[] = {"run", "engines", "warning", "note"};  // of CheckKind

// ---- for programs
Json unit_json(const Unit& unit) { return {{"si", unit.si()}, {"shown", unit.shown}, {"factor", unit.factor}}; }

/// Null: every digit is one of the result.
Json round_off_json(const RoundOff& r) {
  if (!(r.share > 0)) return nullptr;
  Json of = Json::array();
  for (const std::string_view path : {r.of, r.times})
    if (!path.empty()) of.push_back(path.substr(1));
  return {{"share", r.share}, {"of", of}};
}

Json number_json(const ResultNumber& n) {
  const ResultNumber* error = find_error_bar(n);
  return {{"path", n.path().substr(1)},
          {"name", n.name},
          {"label", n.label},
          {"unit", unit_json(n.unit)},
          {"digits", n.digits},
          {"shown", n.shown},
          {"comparable", n.comparable},
          {"column", n.column ? Json(n.column_name()) : Json(nullptr)},
          {"engine", n.engine == AvailableIn::both_engines ? Json(nullptr) : Json(engine_word_of(n.engine))},
          {"doc", n.doc},
          {"round_off", round_off_json(n.round_off)},
          {"error_bar", error ? Json(error->path().substr(1)) : Json(nullptr)},
          {"of_all_patches", n.of_all_patches}};
}

template <class Row>
Json named(const std::vector<Row>& rows) {
  Json out = Json::array();
  for (const Row& r : rows) out.push_back({{"key", r.key}, {"name", r.name}});
  return out;
}

Json check_json(const CheckRow& c) {
  return {{"key", c.key},
          {"kind", kKindWords[static_cast<std::size_t>(c.kind)]},
          {"name", c.name},
          {"what", c.advice.empty() ? std::string(c.what) : fmt::format("{}: {}", c.what, c.advice)},
          {"unit", unit_json(c.unit)},
          {"fem_limit", json_number(c.fem_limit)},
          {"bem_limit", json_number(c.bem_limit)},
          {"limit_from", c.case_option.empty() ? Json(nullptr) : Json(c.case_option)}};
}

// ---- for people
std::string ticked(const std::string& text) { return text.empty() ? text : "`" + text + "`"; }

/// Text of a table's cell: a bar would end it.
std::string cell(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '|') out += '\\';
    out += c;
  }
  return out;
}

std::string numbers_markdown(std::string_view group) {
  std::string out = "\n| key | unit | column of tables | engine | name | meaning |\n|---|---|---|---|---|---|\n";
  for (const ResultNumber& n : result_numbers())
    if (n.group == group)
      out += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", n.key(), n.unit.si(),
                         n.column ? ticked(n.column_name()) : "", engine_word_of(n.engine), cell(n.name), cell(n.doc));
  return out;
}

std::string stress_markdown() {
  std::string out =
      "\n## stress\n\n`stress.<body>.<zone>.<measure>` for the bodies `rail` and `wheel`; null for a zone that the "
      "case does not have. Maxima\nbelow the surface are interpolated by parabolas between the points where the engine "
      "computes stresses: of finite\nelements their centres and, at borders of a material, points recovered from "
      "them.\n\n| zone | meaning |\n|---|---|\n";
  for (const StressZone& zone : stress_zones()) out += fmt::format("| `{}` | {} |\n", zone.key, zone.doc);
  out += "\n| measure | meaning |\n|---|---|\n";
  for (const StressMeasure& m : stress_measures())
    out += fmt::format("| `{}` | largest {} {} |\n", m.key, m.name,
                       m.key == "sigma1_max" ? "(principal stress)" : "stress");
  out += "\n| key | unit | meaning |\n|---|---|---|\n";
  for (const StressNumber& n : stress_numbers())
    out += fmt::format("| `{}{}` | {} | {} |\n", n.key, n.unit.key_ending, n.unit.si(), n.doc);
  out += "\n| column of tables | stands in summary.json as |\n|---|---|\n";
  for (const ResultColumn& c : table_columns()) {
    std::string path = c.path.substr(1);
    std::replace(path.begin(), path.end(), '/', '.');
    if (c.of_stress) out += fmt::format("| `{}` | `{}` |\n", c.name, path);
  }
  return out;
}

std::string residual_markdown() {
  std::string out =
      "\n## residual.json\n\nResidual state of the rail after a run with `run.plasticity`; its section is "
      "`residual.csv`. `none` is null, or gives\nthe reason why there is no residual state and is then the only "
      "key.\n\n| key | unit | meaning |\n|---|---|---|\n";
  for (const ResidualNumber& n : residual_numbers())
    out += fmt::format("| `{}` | {} | {} |\n", n.key(), n.unit.si(), cell(n.doc));
  return out;
}

std::string limit_cell(const CheckRow& c, double limit) {
  return std::isfinite(limit) ? limit_text(c.unit, limit) : std::string(c.case_option);
}

/// The rows of one kind under a heading; `cells` gives all but the first cell of a row.
template <class Cells>
std::string check_rows(CheckKind kind, std::string_view text, Cells&& cells) {
  std::string out(text);
  for (const CheckRow& c : kCheckRows)
    if (c.kind == kind) out += fmt::format("| `{}` | {} |\n", c.key, cells(c));
  return out;
}

constexpr std::string_view kRoundOff =
    "\nScreen and page show 0 for remainders of solvers and round-off: forces below 1e-7 of the normal force, "
    "tractions,\nmoments, displacements and work likewise, creepages below 1e-10, spin below 1e-8 1/m, and the value "
    "of a check below\n1e-6 of its limit. Files keep every digit; `info --schema --results` gives the rule of each "
    "number "
    "(`round_off`).\n";

constexpr std::string_view kSeveralPatches =
    "\nWhere the wheel touches at several places (half-spaces), `contact` describes the patch with the largest "
    "pressure, except\nthat `F_x_N`, `F_y_N` and `F_z_N` are totals. `patches` lists every patch, that one first: the "
    "keys of `contact`, and\n`y_m`, `rail_y_m`, `wheel_y_m` of its place in the model's and in each "
    "profile's own frame. Stresses are\nthose below the first. The same holds for the columns of tables; their column "
    "`patches` is the number of patches.\n";

std::string checks_markdown() {
  return check_rows(CheckKind::run,
                    "\n## checks\n\nEach has `name`, `ok`, `value` and `limit`; it passes where the value is at most "
                    "the limit. If one fails, the exit code\nis 1 (also if one of the page fails, below). An empty "
                    "limit: the engine does not make this check.\n\n| name | finite elements | half-space | called | "
                    "value |\n|---|---|---|---|---|\n",
                    [](const CheckRow& c) {
                      return fmt::format("{} | {} | {} | {}", limit_cell(c, c.fem_limit),
                                         std::isfinite(c.bem_limit) ? limit_text(c.unit, c.bem_limit) : "", c.name,
                                         c.what);
                    }) +
         check_rows(CheckKind::engines,
                    "\n## Finite elements against half-space\n\nOn the page of `report` and of a study: |a/b - 1| for "
                    "the finite element result a and the half-space result b of the\nsame case.\n\n| name | limit | "
                    "called | value |\n|---|---|---|---|\n",
                    [](const CheckRow& c) {
                      return fmt::format("{} | {} | {}", limit_cell(c, c.fem_limit), c.name, c.what);
                    }) +
         check_rows(CheckKind::warning,
                    "\n## warnings\n\nEach has `name`, `value`, `limit` and `text`: the result is numerically sound "
                    "but not plausible. Warnings do not change\nthe exit code.\n\n| name | above | called | text "
                    "|\n|---|---|---|---|\n",
                    [](const CheckRow& c) {
                      return fmt::format("{} | {} | {}: {}", limit_cell(c, c.fem_limit), c.name, c.what, c.advice);
                    });
}

constexpr std::string_view kPlasticPlace =
    "\nOnly for a run with `run.plasticity`. x, y and depth locate the element with the largest accumulated plastic "
    "strain;\n`body` is its body, and `zone` its layer, or the body if it is in none; null: nothing has yielded.\n";

}  // namespace

std::string results_reference_markdown() {
  std::string out =
      "# Results reference\n\n<!-- Written by `railstrata info --schema --results --markdown` from "
      "src/results/result/result_table.cpp and src/results/judge/check_limits.hpp; a test holds this page against the "
      "program. -->\n\n`summary.json` of a result folder holds these numbers in SI units, with the same keys from both "
      "engines; a number that\ndoes not apply is null. The key ends with the unit. Tables (`sweep.csv`, `study.csv`) "
      "hold the numbers that have a\ncolumn, in the unit at the end of its name. Engine: `fem` or `bem` where only one "
      "of them computes the number.\n\n`title` is the title of the case; `state` names the state of a transient; in "
      "`run`, `engine` is `fem` or `bem`\nand `commit` is the commit of the program.\n" +
      std::string(kRoundOff) + numbers_markdown("");
  for (const std::string_view group :
       {"contact", "damage", "shakedown/factors", "layers", "passage", "plastic", "energy", "run"}) {
    out += fmt::format("\n## {}\n", group) + numbers_markdown(group);
    if (group == "contact") out += std::string(kSeveralPatches) + stress_markdown();
    if (group == "plastic") out += std::string(kPlasticPlace);
  }
  return out + residual_markdown() + checks_markdown();
}

Json results_reference_json() {
  Json out;
  out["numbers"] = Json::array();
  for (const ResultNumber& n : result_numbers()) out["numbers"].push_back(number_json(n));
  out["zones"] = named(stress_zones());
  out["measures"] = named(stress_measures());
  out["checks"] = Json::array();
  for (const CheckRow& c : kCheckRows) out["checks"].push_back(check_json(c));
  out["residual"] = Json::array();
  for (const ResidualNumber& n : residual_numbers())
    out["residual"].push_back({{"key", n.key()}, {"unit", unit_json(n.unit)}, {"doc", n.doc}});
  out["verdicts"] = Json::array();
  for (const VerdictRow& v : kVerdicts)
    out["verdicts"].push_back({{"words", v.text}, {"means", v.means}, {"lasts", v.lasts}});
  return out;
}

}  // namespace railstrata
