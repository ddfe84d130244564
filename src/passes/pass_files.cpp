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
#include "model/zone.hpp"

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
constexpr std::size_t kAccumulated = 1, kNet = 2, kCycleAccumulated = 19, kCycleNet = 20;

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

namespace {

std::vector<std::string> stationary_columns() {
  std::vector<std::string> names = pass_columns();
  names.insert(names.end(), kFurtherColumns.begin(), kFurtherColumns.end());
  return names;
}

std::vector<double> row_of(const PassRow& r) {
  std::vector<double> row = pass_values(r);
  row.insert(row.end(), {kToMilli * r.place, r.traction, r.force_share, kNone, kNone});
  return row;
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

}  // namespace

void add_pass(const PassRow& pass, const PassResult& result, PassSeries& series) {
  const std::size_t points = result.accumulated.size();
  series.table.push_back(row_of(pass));
  series.points.resize(points);
  series.begun.resize(points);
  const bool whole = pass.pass % series.cycle == 0;
  PassStrain largest;
  for (std::size_t n = 0; n < points; ++n) {
    std::array<double, kBegun>& begun = series.begun[n];
    const std::array<double, 6>& strain = result.plastic_strain[n];
    begun[6] += result.accumulated[n];
    if (!whole) continue;
    double change[6];
    for (std::size_t c = 0; c < 6; ++c) change[c] = strain[c] - begun[c];
    std::vector<PassStrain>& point = series.points[n];
    remember_pass({begun[6], std::sqrt(double_contraction(change, change))}, point);
    largest.accumulated = std::max(largest.accumulated, point.back().accumulated);
    largest.net = std::max(largest.net, point.back().net);
    std::copy(strain.begin(), strain.end(), begun.begin());
    begun[6] = 0;
  }
  if (!whole) return;
  series.table.back()[kCycleAccumulated] = largest.accumulated;
  series.table.back()[kCycleNet] = largest.net;
}

std::vector<PassStrain> cycles_of(const PassSeries& series) {
  std::vector<PassStrain> cycles;
  for (const std::vector<double>& row : series.table)
    if (!std::isnan(row[kCycleNet])) cycles.push_back({row[kCycleAccumulated], row[kCycleNet]});
  return cycles;
}

PassVerdict verdict_of(const PassSeries& series) {
  PassVerdict verdict = classify(cycles_of(series));
  verdict.rate /= series.cycle;
  return verdict;
}

PassStanding standing_of(const PassSeries& series, const PassRow& last) {
  return standing_of(verdict_of(series), series.table, last);
}

PassStanding standing_of(const PassVerdict& verdict, const std::vector<std::vector<double>>& table,
                         const PassRow& last) {
  PassStanding out{verdict, last};
  for (const std::vector<double>& row : table) {
    out.ever_yielded = out.ever_yielded || row[kAccumulated] > 0;
    if (row[kAccumulated] >= kNoFlow) out.first_quiet = static_cast<int>(row[0]) + 1;
  }
  return out;
}

void remember_pass(const PassStrain& strain, std::vector<PassStrain>& passes) {
  if (passes.size() == kPointPasses) passes.erase(passes.begin());
  passes.push_back(strain);
}

std::vector<PassStrain> strains_of(const std::vector<std::vector<double>>& table) {
  std::vector<PassStrain> passes;
  for (const std::vector<double>& row : table) passes.push_back({row[kAccumulated], row[kNet]});
  return passes;
}

PassVerdict verdict_of(const std::vector<std::vector<double>>& table) { return classify(strains_of(table)); }

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

namespace {

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

}  // namespace

void write_residual(const std::filesystem::path& folder, const std::vector<std::string>& provenance,
                    const RailPasses& rail, const PassSeries& series, const PassResult& last) {
  std::vector<std::string> remarks = provenance;
  remarks.push_back(
      "After the last pass. y: contact frame. class: 0 elastic shakedown, 1 plastic shakedown, 2 ratchetting, "
      "3 transient. plastic_xy ...: tensor shears; plastic_p: accumulated over all passes.");
  const SteadyGrid& g = rail.grid;
  const PassClass whole = verdict_of(series).kind;
  std::vector<PassPoint> section, profile;
  for (int r = 0; r < g.rows(); ++r)
    for (int j = 0; j < g.ny; ++j) section.push_back(point_of(rail, series, whole, last, r, j));
  std::size_t most = 0;
  for (std::size_t n = 0; n < g.points(); ++n) {
    const auto p = [&](std::size_t at) { return series.state.history[at * kStreamlineHistory + 6]; };
    if (p(n) > p(most)) most = n;
  }
  const int column = most > 0 ? static_cast<int>(most) % g.ny : g.ny / 2;
  for (int r = 0; r < g.rows(); ++r) profile.push_back(point_of(rail, series, whole, last, r, column));
  write_pass_points(folder / "residual.csv", remarks, section);
  remarks.push_back("The column of the section with the largest plastic strain.");
  write_pass_points(folder / "profile.csv", remarks, profile);
}

namespace {

Json points_by_class(const std::vector<std::vector<PassStrain>>& points, PassClass whole) {
  Json out;
  for (const PassClass kind :
       {PassClass::elastic_shakedown, PassClass::plastic_shakedown, PassClass::ratchetting, PassClass::transient})
    out[words(kind)] =
        std::count_if(points.begin(), points.end(), [&](const auto& p) { return class_of_point(p, whole) == kind; });
  return out;
}

}  // namespace

Json ductility_json(double ductility, double reached, const std::vector<PassStrain>& cycles, int cycle) {
  constexpr double kNormOfEquivalent = 1.2247448713915890;  // |E^p| = √(3/2) equivalent strain
  const DuctilityReach reach = passes_to_ductility(kNormOfEquivalent * ductility, reached, cycles);
  const auto passes = [&](double count) { return std::isfinite(count) ? Json(cycle * count) : Json(nullptr); };
  return {{"strain", ductility},
          {"reached", reached / kNormOfEquivalent},
          {"passes", passes(reach.passes)},
          {"earliest", passes(reach.earliest)},
          {"latest", passes(reach.latest)}};
}

Json pass_verdict(const std::string& title, const std::vector<std::string>& columns,
                  const std::vector<std::vector<double>>& table, const std::vector<std::vector<PassStrain>>& points) {
  const PassVerdict verdict = verdict_of(table);
  Json out{{"title", title}, {"passes", table.size()}};
  out["class"] = words(verdict.kind);
  out["net_strain_per_pass"] = verdict.rate;
  out["trend"] = verdict.trend;
  for (std::size_t c = 1; c < columns.size(); ++c) out["last_pass"][columns[c]] = table.back()[c];
  out["points"] = points_by_class(points, verdict.kind);
  return out;
}

namespace {

double largest_strain(const PassResult& result) {
  double out = 0;
  for (const auto& e : result.plastic_strain) out = std::max(out, std::sqrt(double_contraction(e.data(), e.data())));
  return out;
}

Json way_json(const SteadyGrid& g, const PassWay& way) {
  Json out = Json::array();
  for (const WayPoint& w : way.points)
    out.push_back({{"name", w.name},
                   {"y_m", g.y(static_cast<int>(w.point) % g.ny)},
                   {"depth_m", g.depth(static_cast<int>(w.point) / g.ny)}});
  return out;
}

Json zones_json(const CaseSpec& spec, const RailPasses& rail) {
  Json out = Json::array();
  double top = 0;
  for (int r = 0; r < rail.grid.rows(); ++r) {
    const int zone = rail.zone[static_cast<std::size_t>(r)];
    if (r == 0 || zone != rail.zone[static_cast<std::size_t>(r) - 1])
      out.push_back({{"name", zone_name(spec, BodyId::rail, zone)}, {"zone", zone}, {"top_m", top}});
    top += rail.grid.thickness[static_cast<std::size_t>(r)];
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

void write_pass_summary(const std::filesystem::path& file, const CaseSpec& spec, const RailPasses& rail,
                        const PassSeries& series, const PassResult& result, const PassWay& way,
                        const PassAnswer& answer) {
  const PassVerdict verdict = verdict_of(series);
  const std::vector<double>& last = series.table.back();
  Json out{{"title", spec.title}, {"method", "stationary"}, {"passes", series.state.passes}};
  out["verdict"] = answer.verdict;
  out["law"] = answer.law;
  out["class"] = words(verdict.kind);
  out["passes_per_cycle"] = series.cycle;
  out["net_strain_per_pass"] = verdict.rate;
  out["trend"] = verdict.trend;
  const std::vector<std::string> columns = stationary_columns();
  for (std::size_t c = 1; c < columns.size(); ++c)
    out["last_pass"][columns[c]] = std::isfinite(last[c]) ? Json(last[c]) : Json(nullptr);
  if (answer.ductility)
    out["ductility"] = ductility_json(*answer.ductility, largest_strain(result), cycles_of(series), series.cycle);
  Summary summary;
  summary.shakedown = answer.shakedown;
  if (Json factors = shakedown_json(summary); !factors.is_null()) out["shakedown"] = std::move(factors);
  out["points"] = points_by_class(series.points, verdict_of(series).kind);
  out["zones"] = zones_json(spec, rail);
  out["loops"] = way_json(rail.grid, way);
  out["grid"] = grid_json(rail.grid);
  out["assumptions"] = {"pressure and friction are those of the elastic bodies",
                        "straight endless rail, layers "
                        "without sideways ends on a half-space",
                        "small strains", "one patch, the same in every pass", "the wheel stays elastic"};
  out["notes"] = rail.notes;
  write_whole_file(file, json_text(out, 2) + "\n");
}

}  // namespace railstrata
