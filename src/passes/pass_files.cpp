#include "passes/pass_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

#include "core/faults.hpp"
#include "io/damage_files.hpp"
#include "passes/pass_json.hpp"
#include "passes/pass_way_files.hpp"
#include "record/csv.hpp"
#include "record/json.hpp"
#include "record/output_file.hpp"
#include "record/unit.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A row of passes.csv by the stationary method; cycle: of one that the pass completes.
struct StationaryRow {
  const PassRow& pass;
  PassStrain cycle;
};

Columns<StationaryRow> row_columns() {
  using S = StationaryRow;
  Columns<S> out = of_part<S>(pass_columns(), [](const S& s) -> const PassRow& { return s.pass; });
  append(out, {{"lateral", unit::kMillimetres, [](const S& s) { return s.pass.place; }},
               {"traction", unit::kNone, [](const S& s) { return s.pass.traction; }},
               {"force_share", unit::kNone, [](const S& s) { return s.pass.force_share; }},
               {"cycle_accumulated", unit::kNone, [](const S& s) { return s.cycle.accumulated; }},
               {"cycle_net", unit::kNone, [](const S& s) { return s.cycle.net; }}});
  return out;
}

constexpr int kBegun = 7;  // numbers of PassSeries::begun

std::vector<std::string> state_names(const SteadyGrid& grid) {
  std::vector<std::string> names{"passes"};
  for (std::size_t n = 0; n < kPointPasses; ++n)
    for (const char* what : {"accumulated", "net"}) names.push_back(fmt::format("{}_{}", what, n));
  for (int n = 0; n < kBegun; ++n) names.push_back(fmt::format("begun_{}", n));
  for (int n = 0; n < kStreamlineHistory; ++n) names.push_back(fmt::format("history_{}", n));
  for (int n = 0; n < 6 * grid.active_stations(); ++n) names.push_back(fmt::format("strain_{}", n));
  return names;
}

PassPoint point_of(const RailPasses& rail, const PassSeries& series, PassClass whole, const PassResult& last, int r,
                   int j) {
  const std::size_t n = rail.grid.point(r, j);
  return {rail.grid.y(j),
          rail.grid.depth(r),
          rail.zone[static_cast<std::size_t>(r)],
          {last.accumulated[n], last.net[n]},
          class_of_point(series.points[n], whole),
          last.residual_stress[n],
          last.plastic_strain[n],
          series.state.history[n * kStreamlineHistory + 6]};
}

double largest_strain(const PassResult& result) {
  double out = 0;
  for (const auto& e : result.plastic_strain) out = std::max(out, std::sqrt(double_contraction(e.data(), e.data())));
  return out;
}

std::vector<ZoneTop> zones_of(const RailPasses& rail) {
  std::vector<ZoneTop> out;
  double top = 0;
  for (std::size_t r = 0; r < rail.zone.size(); ++r) {
    if (r == 0 || rail.zone[r] != rail.zone[r - 1]) out.push_back({rail.zone[r], top});
    top += rail.grid.thickness[r];
  }
  return out;
}

Json grid_json(const SteadyGrid& g) {
  return {{"stations", g.nx},
          {"columns", g.ny},
          {"rows", g.rows()},
          {"dx_m", g.dx},
          {"dy_m", g.dy},
          {"row_m", g.thickness.front()},
          {"deepest_m", g.depth(g.rows() - 1)}};
}

}  // namespace

Columns<PassRow> pass_columns() {
  using R = PassRow;
  return {{"pass", unit::kCount, &R::pass},
          {"accumulated_strain", unit::kNone, [](const R& r) { return r.largest.accumulated; }},
          {"net_strain", unit::kNone, [](const R& r) { return r.largest.net; }},
          {"net_y", unit::kMillimetres, &R::net_y},
          {"net_depth", unit::kMillimetres, &R::net_depth},
          {"sigma_x_min", unit::kMPa, [](const R& r) { return r.stress[0]; }},
          {"sigma_x_depth", unit::kMillimetres, [](const R& r) { return r.stress_depth[0]; }},
          {"sigma_y_min", unit::kMPa, [](const R& r) { return r.stress[1]; }},
          {"sigma_y_depth", unit::kMillimetres, [](const R& r) { return r.stress_depth[1]; }},
          {"forward", unit::kMicrometres, &R::forward},
          {"lateral", unit::kMicrometres, &R::lateral},
          {"sinking", unit::kMicrometres, &R::sinking},
          {"force", unit::kNewtons, &R::force},
          {"balance", unit::kNone, &R::balance},
          {"iterations", unit::kCount, &R::iterations},
          {"error", unit::kNone, &R::error}};
}

std::vector<std::string> stationary_columns() { return names_of(row_columns()); }

std::vector<double> stationary_values(const PassRow& pass, const std::optional<PassStrain>& cycle) {
  return table_row(row_columns(), {pass, cycle.value_or(PassStrain{kNone, kNone})});
}

void write_pass_rows(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                     const std::vector<std::string>& names, const std::vector<std::vector<double>>& table) {
  std::vector<CsvColumn> columns;
  for (const std::string& name : names) {
    const std::size_t c = columns.size();
    columns.push_back({name, {}});
    for (const std::vector<double>& row : table) columns.back().values.push_back(row[c]);
  }
  write_csv(file, provenance, columns);
}

void write_pass_table(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                      const PassSeries& series) {
  write_pass_rows(file, provenance, stationary_columns(), series.table);
}

void write_pass_state(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                      const SteadyGrid& grid, const PassSeries& series) {
  std::vector<CsvColumn> columns;
  for (std::string& name : state_names(grid)) columns.push_back({std::move(name), {}});
  const std::size_t active = static_cast<std::size_t>(grid.active_stations());
  for (std::size_t n = 0; n < grid.points(); ++n) {
    std::size_t c = 0;
    const auto put = [&](double value) { columns[c++].values.push_back(value); };
    put(series.state.passes);
    for (std::size_t k = 0; k < kPointPasses; ++k) {
      const bool known = k < series.points[n].size();
      put(known ? series.points[n][k].accumulated : kNone);
      put(known ? series.points[n][k].net : kNone);
    }
    for (std::size_t k = 0; k < kBegun; ++k) put(n < series.begun.size() ? series.begun[n][k] : 0);
    for (std::size_t k = 0; k < kStreamlineHistory; ++k) put(series.state.history[n * kStreamlineHistory + k]);
    for (std::size_t k = 0; k < 6; ++k)
      for (std::size_t i = 0; i < active; ++i) put(series.state.residual_strain[(k * grid.points() + n) * active + i]);
  }
  write_csv(file, provenance, columns);
}

PassSeries read_pass_series(const std::filesystem::path& state, const std::filesystem::path& table,
                            const SteadyGrid& grid) {
  const CsvTable values = read_csv(state), rows = read_csv(table);
  const std::vector<std::string> names = state_names(grid);
  bool same = values.rows() == grid.points() && values.columns.size() == names.size();
  for (std::size_t c = 0; same && c < names.size(); ++c) same = values.columns[c].name == names[c];
  if (!same || rows.columns.size() != stationary_columns().size())
    throw CaseError("the state is of another grid", "give --cell as in the beginning, or begin anew with --force",
                    state.string());
  const double passes = values.columns[0].values[0];
  if (!(passes >= 0 && passes <= static_cast<double>(rows.rows())))
    throw CaseError("fewer passes than the state has seen", "begin anew with --force", table.string());
  PassSeries series;
  series.state.passes = static_cast<int>(passes);
  for (int n = 0; n < series.state.passes; ++n) {
    series.table.emplace_back();
    for (const CsvColumn& column : rows.columns) series.table.back().push_back(column.values[n]);
    const auto at = [&](const char* name) { return rows.column(name)[static_cast<std::size_t>(n)]; };
    series.strains.push_back({at("accumulated_strain"), at("net_strain")});
    if (!std::isnan(at("cycle_net"))) series.cycles.push_back({at("cycle_accumulated"), at("cycle_net")});
  }
  const std::size_t active = static_cast<std::size_t>(grid.active_stations());
  series.state.history.resize(grid.points() * kStreamlineHistory);
  series.state.residual_strain.resize(6 * grid.points() * active);
  series.points.resize(grid.points());
  series.begun.resize(grid.points());
  for (std::size_t n = 0; n < grid.points(); ++n) {
    std::size_t c = 1;
    const auto take = [&] { return values.columns[c++].values[n]; };
    for (std::size_t k = 0; k < kPointPasses; ++k) {
      const double accumulated = take(), net = take();
      if (!std::isnan(net)) series.points[n].push_back({accumulated, net});
    }
    for (std::size_t k = 0; k < kBegun; ++k) series.begun[n][k] = take();
    for (std::size_t k = 0; k < kStreamlineHistory; ++k) series.state.history[n * kStreamlineHistory + k] = take();
    for (std::size_t k = 0; k < 6; ++k)
      for (std::size_t i = 0; i < active; ++i)
        series.state.residual_strain[(k * grid.points() + n) * active + i] = take();
  }
  const auto finite = [](const auto& numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](double v) { return std::isfinite(v); });
  };
  if (!finite(series.state.history) || !finite(series.state.residual_strain))
    throw CaseError("a value is not a finite number", "begin anew with --force", state.string());
  return series;
}

PointLists point_lists(PointColumns which) {
  using P = PassPoint;
  PointLists out{{{"zone", unit::kCount, &P::zone}},
                 {},
                 tensor_columns<P>("sigma", unit::kMPa, &P::stress),
                 tensor_columns<P>("plastic", unit::kNone, &P::plastic),
                 {{"plastic_strain_accumulated", unit::kNone, &P::accumulated}}};
  if (which == PointColumns::of_passes)
    out.of_pass = {{"accumulated_strain", unit::kNone, [](const P& p) { return p.strain.accumulated; }},
                   {"net_strain", unit::kNone, [](const P& p) { return p.strain.net; }},
                   {"class", unit::kCount, [](const P& p) { return static_cast<double>(p.kind); }}};
  return out;
}

void write_pass_points(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                       const std::vector<PassPoint>& points, PointColumns which) {
  using P = PassPoint;
  const PointLists lists = point_lists(which);
  Columns<P> columns{{"y", unit::kMillimetres, &P::y}, {"depth", unit::kMillimetres, &P::depth}};
  for (const Columns<P>& more : {lists.zone, lists.of_pass, lists.stress, lists.plastic, lists.accumulated})
    append(columns, more);
  if (std::any_of(points.begin(), points.end(), [](const P& p) { return p.row >= 0; }))
    append(columns, {{"row", unit::kCount, &P::row}, {"column", unit::kCount, &P::column}});
  write_csv(file, provenance, points, columns);
}

std::vector<PassPoint> section_points(const RailPasses& rail, const PassSeries& series, const PassResult& last) {
  const PassClass whole = verdict_of(series).kind;
  std::vector<PassPoint> out;
  for (int r = 0; r < rail.grid.rows(); ++r)
    for (int j = 0; j < rail.grid.ny; ++j) out.push_back(point_of(rail, series, whole, last, r, j));
  return out;
}

void write_residual(const std::filesystem::path& folder, const std::vector<std::string>& provenance,
                    const RailPasses& rail, const PassSeries& series, const PassResult& last) {
  std::vector<std::string> remarks = provenance;
  remarks.push_back(
      "After the last pass. y: contact frame. class: 0 elastic shakedown, 1 plastic shakedown, 2 ratchetting, "
      "3 transient. plastic_xy ...: tensor shears; plastic_strain_accumulated: accumulated over all passes.");
  const SteadyGrid& g = rail.grid;
  const std::vector<PassPoint> section = section_points(rail, series, last);
  const auto most = std::max_element(section.begin(), section.end(), [](const PassPoint& a, const PassPoint& b) {
    return a.accumulated < b.accumulated;
  });
  const int column = most > section.begin() ? static_cast<int>(most - section.begin()) % g.ny : g.ny / 2;
  std::vector<PassPoint> profile;
  for (int r = 0; r < g.rows(); ++r) profile.push_back(section[g.point(r, column)]);
  write_pass_points(folder / "residual.csv", remarks, section);
  remarks.push_back("The column of the section with the largest plastic strain.");
  write_pass_points(folder / "profile.csv", remarks, profile);
}

void write_pass_summary(const std::filesystem::path& file, const CaseSpec& spec, const RailPasses& rail,
                        const PassSeries& series, const PassResult& result, const PassWay& way,
                        const PassAnswer& answer) {
  const PassVerdict verdict = verdict_of(series);
  Json out{{"title", spec.title}, {"method", "stationary"}, {"passes", series.state.passes}};
  out["verdict"] = answer.verdict;
  out["law"] = answer.law;
  out["class"] = words(verdict.kind);
  out["passes_per_cycle"] = series.cycle;
  out["net_strain_per_pass"] = verdict.rate;
  out["trend"] = verdict.trend;
  out["last_pass"] = last_pass_json(stationary_columns(), series.table.back());
  if (answer.ductility)
    out["ductility"] = ductility_json(*answer.ductility, largest_strain(result), series.cycles, series.cycle);
  Summary summary;
  summary.shakedown = answer.shakedown;
  if (Json factors = shakedown_json(summary); !factors.is_null()) out["shakedown"] = std::move(factors);
  out["points"] = points_json(series.points, verdict.kind);
  out["zones"] = zones_json(spec, zones_of(rail));
  out["loops"] = loops_json(loops_of(rail, way));
  out["grid"] = grid_json(rail.grid);
  out["assumptions"] = {"pressure and friction are those of the elastic bodies",
                        "straight endless rail, layers without sideways ends on a half-space", "small strains",
                        "one patch, the same in every pass", "the wheel stays elastic"};
  out["notes"] = rail.notes;
  write_whole_file(file, json_text(out, 2) + "\n");
}

}  // namespace railstrata
