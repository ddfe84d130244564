#include "io/pass_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

#include "core/faults.hpp"
#include "io/csv.hpp"
#include "io/json_text.hpp"
#include "io/output_file.hpp"
#include "post/row_strength.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;
constexpr double kMilli = 1e3, kMega = 1e-6, kMicro = 1e6;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Columns of passes.csv; the strains of classify() have no unit, so that they are read back as they were.
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
constexpr std::size_t kAccumulated = 1, kNet = 2;

std::vector<double> row_of(const PassRow& r) {
  return {static_cast<double>(r.pass),
          r.largest.accumulated,
          r.largest.net,
          kMilli * r.net_y,
          kMilli * r.net_depth,
          kMega * r.stress[0],
          kMilli * r.stress_depth[0],
          kMega * r.stress[1],
          kMilli * r.stress_depth[1],
          kMicro * r.forward,
          kMicro * r.lateral,
          kMicro * r.sinking,
          r.force,
          r.balance,
          static_cast<double>(r.iterations),
          r.error};
}

std::vector<std::string> state_names(const SteadyGrid& grid) {
  std::vector<std::string> names{"passes"};
  for (std::size_t n = 0; n < kPointPasses; ++n)
    for (const char* what : {"accumulated", "net"}) names.push_back(fmt::format("{}_{}", what, n));
  for (int n = 0; n < kStreamlineHistory; ++n) names.push_back(fmt::format("history_{}", n));
  for (int n = 0; n < 6 * grid.active_stations(); ++n) names.push_back(fmt::format("strain_{}", n));
  return names;
}

}  // namespace

void add_pass(const SteadyGrid& grid, const PassResult& result, PassSeries& series) {
  series.table.push_back(row_of(pass_row(grid, series.state.passes, result)));
  series.points.resize(grid.points());
  for (std::size_t n = 0; n < grid.points(); ++n) {
    std::vector<PassStrain>& point = series.points[n];
    if (point.size() == kPointPasses) point.erase(point.begin());
    point.push_back({result.accumulated[n], result.net[n]});
  }
}

PassVerdict verdict_of(const PassSeries& series) {
  std::vector<PassStrain> passes;
  for (const std::vector<double>& row : series.table) passes.push_back({row[kAccumulated], row[kNet]});
  return classify(passes);
}

void write_pass_table(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                      const PassSeries& series) {
  std::vector<CsvColumn> columns;
  for (std::size_t c = 0; c < kPassColumns.size(); ++c) {
    columns.push_back({kPassColumns[c], {}});
    for (const std::vector<double>& row : series.table) columns.back().values.push_back(row[c]);
  }
  write_csv(file, provenance, columns);
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
  if (!same || rows.columns.size() != kPassColumns.size())
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
  for (std::size_t n = 0; n < grid.points(); ++n) {
    std::size_t c = 1;
    const auto take = [&] { return values.columns[c++].values[n]; };
    for (std::size_t k = 0; k < kPointPasses; ++k) {
      const double accumulated = take(), net = take();
      if (!std::isnan(net)) series.points[n].push_back({accumulated, net});
    }
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

namespace {

/// Columns of residual.csv and profile.csv: those of a point.
struct PointTable {
  std::vector<CsvColumn> columns;
  PointTable() {
    for (const char* name : {"y_mm", "depth_mm", "zone", "accumulated_strain", "net_strain", "class", "sigma_xx_MPa",
                             "sigma_yy_MPa", "sigma_zz_MPa", "tau_xy_MPa", "tau_yz_MPa", "tau_xz_MPa", "plastic_xx",
                             "plastic_yy", "plastic_zz", "plastic_xy", "plastic_yz", "plastic_xz", "plastic_p"})
      columns.push_back({name, {}});
  }
  void add(const RailPasses& rail, const PassSeries& series, const PassResult& last, int r, int j) {
    const std::size_t n = rail.grid.point(r, j);
    std::vector<double> row{kMilli * rail.grid.y(j),
                            kMilli * rail.grid.depth(r),
                            static_cast<double>(rail.zone[static_cast<std::size_t>(r)]),
                            last.accumulated[n],
                            last.net[n],
                            static_cast<double>(classify(series.points[n]).kind)};
    for (const double s : last.residual_stress[n]) row.push_back(kMega * s);
    for (const double e : last.plastic_strain[n]) row.push_back(e);
    row.push_back(series.state.history[n * kStreamlineHistory + 6]);
    for (std::size_t c = 0; c < row.size(); ++c) columns[c].values.push_back(row[c]);
  }
};

}  // namespace

void write_residual(const std::filesystem::path& folder, const std::vector<std::string>& provenance,
                    const RailPasses& rail, const PassSeries& series, const PassResult& last) {
  std::vector<std::string> remarks = provenance;
  remarks.push_back(
      "After the last pass. y: contact frame. class: 0 elastic shakedown, 1 plastic shakedown, 2 ratchetting, "
      "3 transient. plastic_xy ...: tensor shears; plastic_p: accumulated over all passes.");
  const SteadyGrid& g = rail.grid;
  PointTable section, profile;
  for (int r = 0; r < g.rows(); ++r)
    for (int j = 0; j < g.ny; ++j) section.add(rail, series, last, r, j);
  std::size_t most = 0;
  for (std::size_t n = 0; n < g.points(); ++n) {
    const auto p = [&](std::size_t at) { return series.state.history[at * kStreamlineHistory + 6]; };
    if (p(n) > p(most)) most = n;
  }
  const int column = most > 0 ? static_cast<int>(most) % g.ny : g.ny / 2;
  for (int r = 0; r < g.rows(); ++r) profile.add(rail, series, last, r, column);
  write_csv(folder / "residual.csv", remarks, section.columns);
  remarks.push_back("The column of the section with the largest plastic strain.");
  write_csv(folder / "profile.csv", remarks, profile.columns);
}

void write_pass_summary(const std::filesystem::path& file, const CaseSpec& spec, const RailPasses& rail,
                        const PassSeries& series) {
  const PassVerdict verdict = verdict_of(series);
  const std::vector<double>& last = series.table.back();
  Json out{{"title", spec.title}, {"passes", series.state.passes}};
  out["class"] = words(verdict.kind);
  out["net_strain_per_pass"] = verdict.rate;
  out["trend"] = verdict.trend;
  for (std::size_t c = 1; c < kPassColumns.size(); ++c) out["last_pass"][kPassColumns[c]] = last[c];
  for (const PassClass kind :
       {PassClass::elastic_shakedown, PassClass::plastic_shakedown, PassClass::ratchetting, PassClass::transient})
    out["points"][words(kind)] = std::count_if(series.points.begin(), series.points.end(),
                                               [&](const auto& point) { return classify(point).kind == kind; });
  const SteadyGrid& g = rail.grid;
  out["grid"] = {{"stations", g.nx},
                 {"columns", g.ny},
                 {"rows", g.rows()},
                 {"dx_m", g.dx},
                 {"dy_m", g.dy},
                 {"row_m", g.thickness.front()},
                 {"deepest_m", g.depth(g.rows() - 1)}};
  out["assumptions"] = {"pressure and friction are those of the elastic bodies",
                        "straight endless rail, layers "
                        "without sideways ends on a half-space",
                        "small strains", "one patch, every pass in one place"};
  out["notes"] = rail.notes;
  write_whole_file(file, json_text(out, 2) + "\n");
}

}  // namespace railstrata
