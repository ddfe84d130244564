#include "many/result_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "io/summary_json.hpp"

namespace railstrata {
std::vector<ResultColumn> result_columns(bool stresses) {
  std::vector<ResultColumn> out = table_columns();
  std::erase_if(out, [](const ResultColumn& c) { return c.of_passage; });
  if (!stresses) std::erase_if(out, [](const ResultColumn& c) { return c.of_stress; });
  return out;
}

std::vector<ResultColumn> passage_columns() {
  std::vector<ResultColumn> out = table_columns();
  std::erase_if(out, [](const ResultColumn& c) { return !c.of_passage; });
  return out;
}

const std::vector<ResultColumn>& study_columns() {
  using namespace unit;
  const auto own = [](const std::string& symbol, std::string title, Unit unit) {
    const std::string_view in_column = unit.factor == unit.column_factor ? unit.shown : "";
    return ResultColumn{.name = symbol + std::string(unit.column_ending),
                        .factor = unit.column_factor,
                        .title = std::move(title),
                        .unit = in_column,
                        .shown_unit = unit};
  };
  static const std::vector<ResultColumn> columns{
      own("rail_von_mises", "rail von Mises", kMPa),
      own("rail_von_mises_depth", "rail von Mises, depth", kMillimetres),
      own("rail_sigma_1", "rail σ₁", kMPa),
      own("rail_sigma_1_depth", "rail σ₁, depth", kMillimetres),
      own("section_von_mises", "von Mises on the section", kMPa),
      own("section_von_mises_depth", "von Mises on the section, depth", kMillimetres),
      own("section_sigma_1", "σ₁ on the section", kMPa),
      own("section_sigma_1_depth", "σ₁ on the section, depth", kMillimetres),
      {.name = "threads", .path = "/run/threads", .title = "threads"}};
  return columns;
}

namespace {

/// The first of all columns that is it; null: none.
template <class IsIt>
const ResultColumn* first_column(IsIt&& is_it) {
  static const std::vector<ResultColumn> all = [] {
    std::vector<ResultColumn> out = result_columns(true);
    for (const std::vector<ResultColumn>& more : {passage_columns(), study_columns()})
      out.insert(out.end(), more.begin(), more.end());
    return out;
  }();
  const auto found = std::find_if(all.begin(), all.end(), is_it);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

const ResultColumn* find_column(std::string_view name) {
  return first_column([&](const ResultColumn& c) { return c.name == name; });
}
const ResultColumn& column_of(std::string_view symbol) {
  return *first_column([&](const ResultColumn& c) { return c.symbol() == symbol; });
}

std::string column_title(const std::string& name) {
  const ResultColumn* column = find_column(name);
  return column ? titled(column->title, column->unit) : name;
}

double column_value(const ResultColumn& column, const nlohmann::ordered_json& summary) {
  const nlohmann::ordered_json::json_pointer at(column.path);
  if (!summary.contains(at)) return kNotApplicable;
  if (summary[at] == kEndlessLife) return std::numeric_limits<double>::infinity();
  return summary[at].is_number() ? column.factor * summary[at].get<double>() : kNotApplicable;
}

ResultRemarks remarks_of(const nlohmann::ordered_json& summary) {
  if (!summary.is_object()) return {};
  const auto names = [&](const char* list, auto&& wanted) {
    std::string out;
    if (!summary.contains(list) || !summary[list].is_array()) return out;
    for (const auto& entry : summary[list])
      if (wanted(entry)) out += fmt::format("{}{}", out.empty() ? "" : "; ", entry.value("name", "?"));
    return out;
  };
  ResultRemarks out;
  out.patches = summary.contains("patches") ? static_cast<int>(summary["patches"].size()) : 1;
  out.checks = names("checks", [](const auto& check) { return !check.value("ok", false); });
  if (out.checks.empty()) out.checks = "ok";
  out.warnings = names("warnings", [](const auto&) { return true; });
  if (const nlohmann::ordered_json::json_pointer answer("/shakedown/answer"); summary.contains(answer)) {
    out.lasts = summary[answer].value("lasts", "");
    out.decided_by = summary[answer].value("zone", "");
  }
  if (const auto life = summary.find("life"); life != summary.end()) {
    const auto row = std::find_if(result_numbers().begin(), result_numbers().end(),
                                  [](const ResultNumber& n) { return n.group == kLifeGroup; });  // the best estimate
    const nlohmann::ordered_json best = life->value(row->key(), nlohmann::ordered_json());
    out.life = best.is_number() ? "ends" : best == kEndlessLife ? "never" : life->value("text", "");
  }
  return out;
}

std::string patches_remark(const std::vector<ResultColumn>& columns) {
  std::vector<std::string> of_all;
  bool stresses = false;
  for (const ResultColumn& c : columns) {
    if (c.of_all_patches) of_all.push_back(c.name);
    stresses = stresses || c.of_stress;
  }
  return fmt::format(
      "where a wheel touches at several places (column patches): {} of all patches together, every other column of the "
      "contact of the patch with the largest pressure{}",
      fmt::join(of_all, ", "), stresses ? ", stresses below that one" : "");
}

std::string failed_check(const nlohmann::ordered_json& summary) {
  std::string out;
  if (summary.contains("checks") && summary["checks"].is_array())
    for (const auto& c : summary["checks"])
      if (!c.value("ok", false)) out = "check failed: " + c.value("name", "?");
  return out;
}

}  // namespace railstrata
