#include "clock/clock_files.hpp"

#include "record/column.hpp"
#include "record/csv.hpp"
#include "record/json.hpp"
#include "record/unit.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;

/// A column, and what it is.
struct MomentColumn {
  Column<ClockMoment> column;
  const char* what;
};

const std::vector<MomentColumn>& moments() {
  using M = ClockMoment;
  using namespace unit;
  static const std::vector<MomentColumn> columns{
      {{"traffic", kMGT, [](const M& m) { return m.kilograms; }},
       "gross traffic since the beginning, at the end of a stretch"},
      {{"removed", kMillimetres, [](const M& m) { return m.removed; }},
       "taken off by wear and grinding, where most is gone"},
      {{"removed_y", kMillimetres, [](const M& m) { return m.removed_y; }}, "the place of that"},
      {{"gauge_widening", kMillimetres, [](const M& m) { return m.gauge_widening; }},
       "of the track by worn gauge faces, both rails alike"},
      {{"p_max", kMPa, [](const M& m) { return m.p_max; }},
       "largest pressure of all loads, under which the stretch was followed"},
      {{"layer_left", kMillimetres, [](const M& m) { return m.layer_left; }},
       "of the uppermost layer, where least is left"},
      {{"ductility_used", kNone, [](const M& m) { return m.ductility; }},
       "largest share of the ductility that is used, 0.1 mm below the surface or deeper"},
      {{"ductility_y", kMillimetres, [](const M& m) { return m.ductility_y; }}, "the place of that"},
      {{"ductility_depth", kMillimetres, [](const M& m) { return m.ductility_depth; }},
       "its depth below the surface of that time"},
      {{"exhausted_depth", kMillimetres, [](const M& m) { return m.exhausted; }},
       "so deep is the ductility of all metal used from the surface on, where that is deepest"},
      {{"cycles_used", kNone, [](const M& m) { return m.cycles; }}, "largest share used by closed cycles of strain"},
      {{"fatigue_used", kNone, [](const M& m) { return m.fatigue; }}, "largest share used by stress"},
      {{"net_strain", kNone, [](const M& m) { return m.net; }}, "that a wheel leaves, the largest"},
      {{"contact_change", kNone, [](const M& m) { return m.contact_change; }},
       "of the contacts from the beginning to the end of the stretch, over what ends one (20 % of the pressure, 1 mm)"},
      {{"unsettled", kNone, [](const M& m) { return m.unsettled; }},
       "share of the strain rates that steps have not brought to rest, the largest"},
      {{"changes", kNone, [](const M& m) { return static_cast<double>(m.changes); }},
       "of the metal that were computed"},
      {{"crack", kMillimetres, [](const M& m) { return m.crack; }},
       "depth of the crack below the surface of that time; empty: none has begun"},
      {{"crack_growth", kMillimetresPerMGT, [](const M& m) { return m.crack_growth; }},
       "of its depth by the traffic alone, without what wear takes off"}};
  return columns;
}

const Columns<ClockMoment>& moment_columns() {
  static const Columns<ClockMoment> columns = [] {
    Columns<ClockMoment> out;
    for (const MomentColumn& c : moments()) out.push_back(c.column);
    return out;
  }();
  return columns;
}

}  // namespace

void write_history(const std::filesystem::path& file, const std::vector<std::string>& origin,
                   const ClockResult& result) {
  std::vector<std::string> head = origin;
  for (const MomentColumn& c : moments()) head.push_back(c.column.column_name() + ": " + c.what);
  write_csv(file, head, result.history, moment_columns());
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
