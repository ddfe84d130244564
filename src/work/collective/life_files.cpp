#include "collective/life_files.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "many/case_row.hpp"
#include "record/csv.hpp"
#include "record/output_file.hpp"
#include "record/unit.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;

/// Of lives in wheels or km: what was followed is known in MGT alone.
double followed_otherwise(const LifeRow& r) { return std::isinf(r.followed) ? r.followed : kNotApplicable; }

Json length_cell(double si) { return std::isfinite(si) ? Json(unit::kMillimetres.factor * si) : Json(nullptr); }

std::vector<TextColumn<LifeRow>> life_columns() {
  using R = LifeRow;
  std::vector<TextColumn<R>> out{{"body", [](const R& r) { return r.body; }},
                                 {"zone", [](const R& r) { return r.zone; }},
                                 {"place", [](const R& r) { return r.place; }},
                                 {"mechanism", [](const R& r) { return r.mechanism; }}};
  constexpr std::pair<const char*, double LifeRange::*> kVariants[] = {
      {"", &LifeRange::best}, {"_low", &LifeRange::low}, {"_high", &LifeRange::high}};
  for (const auto& [name, value] : kVariants)
    out.push_back(
        {fmt::format("life{}_MGT", name), [value = value](const R& r) { return life_cell(r.mgt.*value, r.followed); }});
  for (const auto& [name, value] : kVariants)
    out.push_back({fmt::format("wheels{}", name),
                   [value = value](const R& r) { return life_cell(r.wheels.*value, followed_otherwise(r)); }});
  for (const auto& [name, value] : kVariants)
    out.push_back({fmt::format("distance{}_km", name), [value = value](const R& r) {
                     return life_cell(1e-3 * (r.distance.*value), followed_otherwise(r));
                   }});
  out.push_back({"depth_mm", [](const R& r) { return length_cell(r.depth); }});
  out.push_back({"y_mm", [](const R& r) { return length_cell(r.y); }});
  out.push_back({"rests_on", [](const R& r) { return r.rests_on; }});
  return out;
}

LifeRange scaled(const LifeRange& r, double factor) { return {factor * r.low, factor * r.best, factor * r.high}; }

ReportSeries line(const std::string& name, const std::vector<double>& mgt, const std::vector<double>& depth) {
  ReportSeries out{.name = name, .x = mgt, .y = {}, .markers = false};
  for (const double d : depth) out.y.push_back(unit::kMillimetres.factor * d);
  return out;
}

}  // namespace

Json life_cell(double value, double followed) {
  if (std::isnan(value)) return nullptr;
  if (!std::isinf(value)) return value;
  if (std::isinf(followed)) return "never";
  return std::isnan(followed) ? Json(nullptr) : Json(fmt::format("> {:.3g}", followed));
}

void write_lives(const std::filesystem::path& file, const std::vector<std::string>& origin, const Lives& lives) {
  write_whole_file(file, csv_remarks(origin) + csv_lines(life_columns(), lives.rows));
}

Json lives_json(const Lives& lives) { return json_rows(life_columns(), lives.rows); }

ReportTable lives_table(const Lives& lives) {
  using R = LifeRow;
  ReportTable out{.id = "lives",
                  .title = "How long each zone lasts",
                  .note =
                      "Best value and range: for the rail in million gross tonnes and wheels over it, for the wheel in "
                      "turns and distance. Failure modes do not add up: the shortest life counts. Not known: the last "
                      "column names the missing key.",
                  .columns = {},
                  .rows = {}};
  add_rows(
      out, lives.rows,
      {{"body", [](const R& r) { return r.body; }},
       {"zone", [](const R& r) { return r.zone; }},
       {"place", [](const R& r) { return r.place; }},
       {"ends by", [](const R& r) { return r.mechanism; }},
       {"life [MGT]",
        [](const R& r) { return r.body == "rail" ? Json(range_text(r.mgt, r.followed)) : Json(nullptr); }},
       {"wheels",
        [](const R& r) {
          return std::isinf(r.followed) || std::isfinite(r.wheels.best) ? Json(range_text(r.wheels)) : Json(nullptr);
        }},
       {"distance [1000 km]",
        [](const R& r) { return r.distance.known() ? Json(range_text(scaled(r.distance, 1e-6))) : Json(nullptr); }},
       {titled("depth", unit::kMillimetres.shown), [](const R& r) { return length_cell(r.depth); }},
       {titled("y", unit::kMillimetres.shown), [](const R& r) { return length_cell(r.y); }},
       {"rests on", [](const R& r) { return r.rests_on; }}});
  return out;
}

std::optional<ReportChart> life_chart(const Lives& lives) {
  const LifeCurve& c = lives.curve;
  if (c.mgt.empty() || !std::isfinite(c.mgt.back())) return std::nullopt;
  ReportChart out{"life",
                  "Damage and removal where the metal fails first",
                  fmt::format("At y = {:.1f} mm; depth from the new surface. Removed: by wear and grinding. Fails: "
                              "when each point fails while wear brings it nearer to the surface; the first failure is "
                              "the life. Unworn: the same without removal.",
                              unit::kMillimetres.factor * c.y),
                  "traffic [MGT]",
                  titled("depth", unit::kMillimetres.shown),
                  {}};
  out.series.push_back(line("removed", c.mgt, c.removed));
  if (!c.failed.empty()) out.series.push_back(line("fails", c.failed_mgt, c.failed));
  if (!c.damaged.empty()) out.series.push_back(line("unworn", c.damaged_mgt, c.damaged));
  if (std::isfinite(c.layer))
    out.series.push_back(line("bottom of the layer", {c.mgt.front(), c.mgt.back()}, {c.layer, c.layer}));
  return out;
}

ReportAnswer life_answer(const Lives& lives) {
  if (lives.rows.empty()) return {};
  const LifeRow* row = shortest(lives.rows);
  return {row && std::isfinite(row->mgt.best) ? "open" : "plain", "Life", life_text(lives.rows)};
}

}  // namespace railstrata
