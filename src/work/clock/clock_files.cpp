#include "clock/clock_files.hpp"

#include "record/column.hpp"
#include "record/csv.hpp"
#include "record/json.hpp"
#include "record/unit.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;

const Columns<ClockMoment>& moment_columns() {
  using M = ClockMoment;
  using namespace unit;
  static const Columns<M> columns{{"traffic", kMGT, [](const M& m) { return m.kilograms; }},
                                  {"removed", kMillimetres, [](const M& m) { return m.removed; }},
                                  {"removed_y", kMillimetres, [](const M& m) { return m.removed_y; }},
                                  {"gauge_widening", kMillimetres, [](const M& m) { return m.gauge_widening; }},
                                  {"p_max", kMPa, [](const M& m) { return m.p_max; }},
                                  {"layer_left", kMillimetres, [](const M& m) { return m.layer_left; }},
                                  {"ductility_used", kNone, [](const M& m) { return m.ductility; }},
                                  {"ductility_y", kMillimetres, [](const M& m) { return m.ductility_y; }},
                                  {"ductility_depth", kMillimetres, [](const M& m) { return m.ductility_depth; }},
                                  {"exhausted_depth", kMillimetres, [](const M& m) { return m.exhausted; }},
                                  {"cycles_used", kNone, [](const M& m) { return m.cycles; }},
                                  {"fatigue_used", kNone, [](const M& m) { return m.fatigue; }},
                                  {"net_strain", kNone, [](const M& m) { return m.net; }},
                                  {"unsettled", kNone, [](const M& m) { return m.unsettled; }},
                                  {"changes", kNone, [](const M& m) { return static_cast<double>(m.changes); }}};
  return columns;
}

}  // namespace

void write_history(const std::filesystem::path& file, const std::vector<std::string>& origin,
                   const ClockResult& result) {
  write_csv(file, origin, result.history, moment_columns());
}

void write_worn_rail(const std::filesystem::path& file, const std::vector<std::string>& origin,
                     const std::vector<Vec2>& profile) {
  static const Columns<Vec2> columns{{"y", unit::kMillimetres, [](const Vec2& p) { return p.y; }},
                                     {"z", unit::kMillimetres, [](const Vec2& p) { return p.z; }}};
  write_csv(file, origin, profile, columns);
}

Json history_json(const ClockResult& result) {
  Json rows = Json::array();
  for (const ClockMoment& m : result.history) rows.push_back(json_record(m, moment_columns()));
  return {{"followed_MGT", 1e-9 * result.reached}, {"ended", result.ended}, {"notes", result.notes}, {"history", rows}};
}

}  // namespace railstrata
