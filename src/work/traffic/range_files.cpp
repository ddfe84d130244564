#include "traffic/range_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "collective/life_files.hpp"
#include "many/case_row.hpp"
#include "record/csv.hpp"
#include "record/output_file.hpp"
#include "record/unit.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;

/// "rail_at_the_surface_fatigue_MGT"
std::string column_of(const LifeRow& row) {
  std::string out = fmt::format("{}_{}_{}_MGT", row.zone, row.place, row.mechanism);
  std::replace(out.begin(), out.end(), ' ', '_');
  return out;
}

Json cell_of(const LifeRow* row) { return row ? life_cell(row->mgt.best, row->followed) : Json(nullptr); }

std::vector<TextColumn<RangeRun>> run_columns(const std::vector<LifeRow>& rows) {
  using R = RangeRun;
  std::vector<TextColumn<R>> out{{"changed", [](const R& r) { return r.input; }},
                                 {"value", [](const R& r) { return r.value; }},
                                 {"first_damage_MGT", [](const R& r) { return cell_of(first_damage(r.result.lives)); }},
                                 {"first_damage_by", [](const R& r) {
                                    const LifeRow* first = first_damage(r.result.lives);
                                    return first && std::isfinite(first->mgt.best)
                                               ? Json(fmt::format("{}, {}", first->mechanism, first->place))
                                               : Json(nullptr);
                                  }}};
  for (const LifeRow& row : rows)
    if (row.known())
      out.push_back({column_of(row), [row](const R& r) { return cell_of(same_row(r.result.lives, row)); }});
  out.push_back({"removed_mm", [](const R& r) {
                   return r.result.history.empty() ? Json(nullptr)
                                                   : Json(unit::kMillimetres.factor * r.result.history.back().removed);
                 }});
  out.push_back({"followed_MGT", [](const R& r) { return unit::kMGT.factor * r.result.reached; }});
  out.push_back({"ended", [](const R& r) { return r.result.ended; }});
  out.push_back({"fault", [](const R& r) { return r.fault; }});
  return out;
}

Json life_of(const InputEffect& e, std::size_t end) {
  return e.known[end] ? life_cell(e.life[end].mgt, e.life[end].followed) : Json(nullptr);
}

}  // namespace

void write_range(const std::filesystem::path& file, const std::vector<std::string>& origin, const TrafficRange& range) {
  write_whole_file(file, csv_remarks(origin) + csv_lines(run_columns(range.lives), range.runs));
}

Json range_json(const TrafficRange& range) {
  const std::vector<TextColumn<InputEffect>> columns{
      {"input", [](const InputEffect& e) { return e.input; }},
      {"key", [](const InputEffect& e) { return e.key; }},
      {"low", [](const InputEffect& e) { return e.value[0]; }},
      {"high", [](const InputEffect& e) { return e.value[1]; }},
      {"life_at_low_MGT", [](const InputEffect& e) { return life_of(e, 0); }},
      {"life_at_high_MGT", [](const InputEffect& e) { return life_of(e, 1); }},
      {"share", [](const InputEffect& e) { return e.share; }}};
  return {{"first_damage",
           {{"low_MGT", life_cell(range.first.low, range.followed)},
            {"best_MGT", life_cell(range.first.best, range.followed)},
            {"high_MGT", life_cell(range.first.high, range.followed)}}},
          {"decides", deciding_text(range)},
          {"inputs", json_rows(columns, range.effects)},
          {"runs", json_rows(run_columns(range.lives), range.runs)}};
}

}  // namespace railstrata
