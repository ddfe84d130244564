#include "clock/clock_files.hpp"

#include <cmath>

#include "record/column.hpp"
#include "record/csv.hpp"
#include "record/number_text.hpp"
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
                     const ClockResult& result) {
  static const Columns<Vec2> columns{{"y", unit::kMillimetres, [](const Vec2& p) { return p.y; }},
                                     {"z", unit::kMillimetres, [](const Vec2& p) { return p.z; }}};
  write_csv(file, origin, result.profile, columns);
}

Json history_json(const ClockResult& result) {
  Json rows = Json::array();
  for (const ClockMoment& m : result.history)
    rows.push_back({{"traffic_MGT", 1e-9 * m.kilograms},
                    {"removed_m", m.removed},
                    {"p_max_Pa", m.p_max},
                    {"ductility_used", m.ductility},
                    {"cycles_used", m.cycles},
                    {"fatigue_used", m.fatigue}});
  return {{"followed_MGT", 1e-9 * result.reached}, {"ended", result.ended}, {"notes", result.notes}, {"history", rows}};
}

std::vector<ReportChart> history_charts(const ClockResult& result) {
  ReportChart used{"history-damage",
                   "Damage over the traffic",
                   "Largest shares of the metal that is still there, at the end of each stretch; at 1 it fails.",
                   "traffic [MGT]",
                   "share used",
                   {}};
  ReportChart removed{"history-removed", "Removed by wear and grinding, where most has gone", "",
                      "traffic [MGT]",   titled("depth", unit::kMillimetres.shown),           {}};
  std::vector<double> mgt;
  for (const ClockMoment& m : result.history) mgt.push_back(1e-9 * m.kilograms);
  const auto line = [&](const char* name, double ClockMoment::*value, double factor) {
    ReportSeries out{.name = name, .x = mgt, .y = {}, .markers = true};
    for (const ClockMoment& m : result.history) out.y.push_back(factor * (m.*value));
    return out;
  };
  used.series = {line("ductility", &ClockMoment::ductility, 1), line("closed cycles", &ClockMoment::cycles, 1),
                 line("fatigue", &ClockMoment::fatigue, 1)};
  removed.series = {line("removed", &ClockMoment::removed, unit::kMillimetres.factor)};
  if (!result.history.empty() && std::isfinite(result.history.front().layer_left))
    removed.series.push_back(line("layer left", &ClockMoment::layer_left, unit::kMillimetres.factor));
  return {used, removed};
}

}  // namespace railstrata
