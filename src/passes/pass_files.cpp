#include "passes/pass_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

#include "core/faults.hpp"
#include "core/si_prefix.hpp"
#include "io/csv.hpp"
#include "io/damage_files.hpp"
#include "io/json_text.hpp"
#include "io/output_file.hpp"
#include "passes/pass_json.hpp"
#include "passes/pass_way_files.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Columns of passes.csv that both methods have; the strains of classify() have no unit, so that they are read back as
/// they were.
constexpr std::array kPassColumns{"pass",
                                  "accumulated_strain",
                                  "net_strain",
                                  "net_y_mm",
                                  "net_depth_mm",
                                  "sigma_x_min_MPa",
                                  "sigma_x_depth_mm",
                                  "sigma_y_min_MPa",
                                  "sigma_y_depth_mm",
                                  "forward_um",
                                  "lateral_um",
                                  "sinking_um",
                                  "force_N",
                                  "balance",
                                  "iterations",
                                  "error"};
/// Those of the stationary method besides.
constexpr std::array kFurtherColumns{"lateral_mm", "traction", "force_share", "cycle_accumulated", "cycle_net"};

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

std::vector<std::string> pass_columns() { return {kPassColumns.begin(), kPassColumns.end()}; }

std::vector<double> pass_values(const PassRow& r) {
  return {static_cast<double>(r.pass),
          r.largest.accumulated,
          r.largest.net,
          kToMilli * r.net_y,
          kToMilli * r.net_depth,
          kToMega * r.stress[0],
          kToMilli * r.stress_depth[0],
          kToMega * r.stress[1],
          kToMilli * r.stress_depth[1],
          kToMicro * r.forward,
          kToMicro * r.lateral,
          kToMicro * r.sinking,
          r.force,
          r.balance,
          static_cast<double>(r.iterations),
          r.error};
}

std::vector<std::string> stationary_columns() {
  std::vector<std::string> names = pass_columns();
  names.insert(names.end(), kFurtherColumns.begin(), kFurtherColumns.end());
  return names;
}

std::vector<double> stationary_values(const PassRow& r, const std::optional<PassStrain>& cycle) {
  const PassStrain known = cycle.value_or(PassStrain{kNone, kNone});
  std::vector<double> row = pass_values(r);
  row.insert(row.end(), {kToMilli * r.place, r.traction, r.force_share, known.accumulated, known.net});
  return row;
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

void write_pass_points(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                       const std::vector<PassPoint>& points, PointColumns which) {
  std::vector<CsvColumn> columns;
  for (const char* name : {"y_mm", "depth_mm", "zone"}) columns.push_back({name, {}});
  if (which == PointColumns::of_passes)
    for (const char* name : {"accumulated_strain", "net_strain", "class"}) columns.push_back({name, {}});
  for (const char* name :
       {"sigma_xx_MPa", "sigma_yy_MPa", "sigma_zz_MPa", "tau_xy_MPa", "tau_yz_MPa", "tau_xz_MPa", "plastic_xx",
        "plastic_yy", "plastic_zz", "plastic_xy", "plastic_yz", "plastic_xz", "plastic_p"})
    columns.push_back({name, {}});
  const bool of_elements = std::any_of(points.begin(), points.end(), [](const PassPoint& p) { return p.row >= 0; });
  if (of_elements)
    for (const char* name : {"row", "column"}) columns.push_back({name, {}});
  for (const PassPoint& p : points) {
    std::vector<double> row{kToMilli * p.y, kToMilli * p.depth, static_cast<double>(p.zone)};
    if (which == PointColumns::of_passes)
      row.insert(row.end(), {p.strain.accumulated, p.strain.net, static_cast<double>(p.kind)});
    for (const double s : p.stress) row.push_back(kToMega * s);
    for (const double e : p.plastic) row.push_back(e);
    row.push_back(p.accumulated);
    if (of_elements) row.insert(row.end(), {static_cast<double>(p.row), static_cast<double>(p.column)});
    for (std::size_t c = 0; c < row.size(); ++c) columns[c].values.push_back(row[c]);
  }
  write_csv(file, provenance, columns);
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
      "3 transient. plastic_xy ...: tensor shears; plastic_p: accumulated over all passes.");
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
