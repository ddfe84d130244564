#include "passes/pass_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <nlohmann/json.hpp>

#include "core/faults.hpp"
#include "io/damage_files.hpp"
#include "material/strain_claim.hpp"
#include "model/zone.hpp"
#include "passes/pass_way.hpp"
#include "record/csv.hpp"
#include "record/json.hpp"
#include "record/output_file.hpp"
#include "record/unit.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;

const Columns<PassStrain> kPassStrain{{"accumulated_strain", unit::kNone, &PassStrain::accumulated},
                                      {"net_strain", unit::kNone, &PassStrain::net}},
    kCycleStrain{{"cycle_accumulated", unit::kNone, &PassStrain::accumulated},
                 {"cycle_net", unit::kNone, &PassStrain::net}};

/// Those that are in a table of passes, and those that were jumped over.
std::vector<PassStrain> strains_in(const CsvTable& table, const Columns<PassStrain>& columns, int cycle = 1) {
  const std::vector<double> accumulated = table.column(columns[0].column_name()),
                            net = table.column(columns[1].column_name()), pass = table.column("pass");
  std::vector<PassStrain> out;
  for (std::size_t n = 0; n < net.size(); ++n)
    if (!std::isnan(net[n])) add_strain(static_cast<int>(pass[n]) / cycle, {accumulated[n], net[n]}, out);
  return out;
}

constexpr std::size_t kBegun = 7;  // numbers of PassSeries::begun

/// Columns that PassState::rise takes, point after point of the section.
std::size_t rise_columns(const SteadyGrid& grid) { return (3 * grid.plane() + grid.points() - 1) / grid.points(); }

/// In PassState::residual_strain, of column k of a point.
std::size_t place_of_strain(const SteadyGrid& g, std::size_t k, std::size_t point) {
  const int active = g.active_stations(), column = static_cast<int>(k), n = static_cast<int>(point);
  return g.active_index(column / active, n / g.ny, column % active, n % g.ny);
}

/// state.csv, of the points of the section.
Columns<std::size_t> state_columns(const SteadyGrid& grid, const PassSeries& series) {
  using N = std::size_t;
  const N active = static_cast<N>(grid.active_stations()), lines = grid.points();
  Columns<N> out{{"passes", unit::kCount, [&](N) { return series.state.passes; }}};
  append(out,
         of_part<N>(remembered_columns(), [&](N n) -> const std::vector<PassStrain>& { return series.points[n]; }));
  for (N k = 0; k < kBegun; ++k)
    out.push_back({fmt::format("begun_{}", k), unit::kNone,
                   [&, k](N n) { return n < series.begun.size() ? series.begun[n][k] : 0.0; }});
  for (N k = 0; k < kStreamlineHistory; ++k)
    out.push_back({fmt::format("history_{}", k), unit::kNone,
                   [&, k](N n) { return series.state.history[n * kStreamlineHistory + k]; }});
  for (N k = 0; k < 6 * active; ++k)
    out.push_back({fmt::format("strain_{}", k), unit::kNone,
                   [&, k](N n) { return series.state.residual_strain[place_of_strain(grid, k, n)]; }});
  for (N k = 0; k < rise_columns(grid); ++k)
    out.push_back({fmt::format("rise_{}", k), unit::kNone, [&, k, lines](N n) {
                     const N at = k * lines + n;
                     return at < series.state.rise.size() ? series.state.rise[at] : 0.0;
                   }});
  if (series.jump.length > 0)
    append(out, {{"jump_length", unit::kCount, [&](N) { return series.jump.length; }},
                 {"jump_error", unit::kNone, [&](N) { return series.jump.error; }}});
  return out;
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
  for (const auto& e : result.plastic_strain) out = std::max(out, equivalent_strain(e.data()));
  return out;
}

/// null where they are not known.
Json errors_json(const PassSeries& series, const PassAnswer& answer) {
  if (!answer.error.known()) return nullptr;
  Json last = Json::object(), classes = Json::array();
  for (const auto& [column, error] : answer.error.last) last[column] = json_number(error);
  for (const PassClass kind : answer.error.classes) classes.push_back(class_text(kind));
  return {{"last_pass", last},
          {"net_strain_per_pass", json_number(answer.error.of("cycle_net") / series.cycle)},
          {"strain", answer.error.strain},
          {"classes_on_coarser_grids", classes},
          {"not_converged", not_converged(answer.error, series.table)}};
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
          {"behind_m", g.active},
          {"row_m", g.thickness.front()},
          {"deepest_m", g.depth(g.rows() - 1)}};
}

}  // namespace

Columns<PassRow> pass_columns() {
  using R = PassRow;
  Columns<R> out{{"pass", unit::kCount, &R::pass}};
  append(out, of_part<R>(kPassStrain, &R::largest));
  append(out, {{"net_y", unit::kMillimetres, &R::net_y},
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
               {"error", unit::kNone, &R::error}});
  return out;
}

std::vector<PassStrain> pass_strains(const CsvTable& table) { return strains_in(table, kPassStrain); }

Columns<StationaryRow> stationary_columns() {
  using R = StationaryRow;
  Columns<R> out = of_part<R>(pass_columns(), [](const R& r) -> const PassRow& { return r.pass; });
  append(out, {{"lateral", unit::kMillimetres, [](const R& r) { return r.pass.contact.lateral; }},
               {"traction", unit::kNone, [](const R& r) { return r.pass.contact.traction; }},
               {"creepage", unit::kNone, [](const R& r) { return r.pass.contact.creepage; }},
               {"p_max", unit::kMPa, [](const R& r) { return r.pass.contact.p_max; }},
               {"rounds", unit::kCount, [](const R& r) { return r.pass.rounds; }},
               {"force_share", unit::kNone, [](const R& r) { return r.pass.force_share; }},
               {"late_flow", unit::kNone, [](const R& r) { return r.pass.late_flow; }}});
  append(out, of_part<R>(kCycleStrain, &R::cycle));
  return out;
}

void write_pass_state(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                      const SteadyGrid& grid, const PassSeries& series) {
  std::vector<std::size_t> points(grid.points());
  std::iota(points.begin(), points.end(), 0U);
  write_csv(file, provenance, points, state_columns(grid, series));
}

int active_stations(const std::filesystem::path& state) {
  const CsvTable values = read_csv(state);
  const auto strains = std::count_if(values.columns.begin(), values.columns.end(),
                                     [](const CsvColumn& c) { return c.name.rfind("strain_", 0) == 0; });
  return static_cast<int>(strains / 6);
}

PassSeries read_pass_series(const std::filesystem::path& state, const std::filesystem::path& table,
                            const SteadyGrid& grid, int cycle) {
  const CsvTable values = read_csv(state), rows = read_csv(table);
  PassSeries series;
  series.cycle = cycle;
  const bool jumps = std::any_of(values.columns.begin(), values.columns.end(),
                                 [](const CsvColumn& c) { return c.name == "jump_length"; });
  series.jump.length = jumps ? 1 : 0;
  const std::vector<std::string> names = names_of(state_columns(grid, series));
  bool same = values.rows() == grid.points() && values.columns.size() == names.size();
  for (std::size_t c = 0; same && c < names.size(); ++c) same = values.columns[c].name == names[c];
  if (!same || rows.columns.size() != stationary_columns().size())
    throw CaseError("the state was saved with another cell size",
                    "give the same --cell as at the start, or start again with --force", state.string());
  const double passes = values.columns[0].values[0];
  const std::vector<double> pass = rows.column("pass");
  const auto end = std::find(pass.begin(), pass.end(), passes);
  if (passes != 0 && end == pass.end())
    throw CaseError("fewer passes than the saved state contains", "begin anew with --force", table.string());
  series.state.passes = static_cast<int>(passes);
  const auto seen = passes == 0 ? 0 : end - pass.begin() + 1;
  series.table = first_rows(rows, stationary_columns(), static_cast<std::size_t>(seen));
  series.strains = pass_strains(series.table);
  series.cycles = strains_in(series.table, kCycleStrain, cycle);
  const std::size_t active = static_cast<std::size_t>(grid.active_stations());
  series.state.history.resize(grid.points() * kStreamlineHistory);
  series.state.residual_strain.resize(grid.active_size());
  series.state.rise.resize(3 * grid.plane());
  series.points.resize(grid.points());
  series.begun.resize(grid.points());
  for (std::size_t n = 0; n < grid.points(); ++n) {
    series.points[n] = remembered_passes(values, n, 1);
    std::size_t c = 1 + 2 * kPointPasses;
    const auto take = [&] { return values.columns[c++].values[n]; };
    for (std::size_t k = 0; k < kBegun; ++k) series.begun[n][k] = take();
    for (std::size_t k = 0; k < kStreamlineHistory; ++k) series.state.history[n * kStreamlineHistory + k] = take();
    for (std::size_t k = 0; k < 6 * active; ++k) series.state.residual_strain[place_of_strain(grid, k, n)] = take();
    for (std::size_t k = 0; k < rise_columns(grid); ++k) {
      const double value = take();
      if (const std::size_t at = k * grid.points() + n; at < series.state.rise.size()) series.state.rise[at] = value;
    }
    if (jumps) series.jump = {static_cast<int>(take()), take()};
  }
  const auto finite = [](const auto& numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](double v) { return std::isfinite(v); });
  };
  if (!finite(series.state.history) || !finite(series.state.residual_strain) || !finite(series.state.rise))
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
  if (which == PointColumns::of_a_run) return out;
  out.of_pass = of_part<P>(kPassStrain, &P::strain);
  append(out.of_pass, {{"class", unit::kCount, [](const P& p) { return static_cast<double>(p.kind); }}});
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
  remarks.push_back(fmt::format("After the last pass. y: contact frame. {}", kPointRemark));
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

Json last_pass_json(const CsvTable& table) {
  Json out;
  for (std::size_t c = 1; c < table.columns.size(); ++c)
    out[table.columns[c].name] = json_number(table.columns[c].values.back());
  return out;
}

Json points_json(const std::vector<std::vector<PassStrain>>& points, PassClass whole) {
  Json out;
  for (const PassClass kind :
       {PassClass::elastic_shakedown, PassClass::plastic_shakedown, PassClass::ratchetting, PassClass::transient})
    out[class_text(kind)] =
        std::count_if(points.begin(), points.end(), [&](const auto& p) { return class_of_point(p, whole) == kind; });
  return out;
}

Json ductility_json(double ductility, double reached, const std::vector<PassStrain>& cycles, int cycle) {
  const DuctilityReach reach = passes_to_ductility(ductility, reached, cycles);
  const auto passes = [&](double count) { return json_number(cycle * count); };
  return {{"strain", ductility},
          {"reached", reached},
          {"passes", passes(reach.passes)},
          {"earliest", passes(reach.earliest)},
          {"latest", passes(reach.latest)}};
}

Json zones_json(const CaseSpec& spec, const std::vector<ZoneTop>& zones) {
  Json out = Json::array();
  for (const ZoneTop& z : zones)
    out.push_back({{"name", zone_name(spec, BodyId::rail, z.zone)}, {"zone", z.zone}, {"top_m", z.top}});
  return out;
}

Json loops_json(const std::vector<PassLoop>& loops) {
  Json out = Json::array();
  for (const PassLoop& l : loops) out.push_back({{"name", l.name}, {"y_m", l.y}, {"depth_m", l.depth}});
  return out;
}

void write_pass_summary(const std::filesystem::path& file, const CaseSpec& spec, const RailPasses& rail,
                        const PassSeries& series, const PassResult& result, const PassWay& way,
                        const PassAnswer& answer) {
  const PassVerdict verdict = verdict_of(series);
  Json out{{"title", spec.title}, {"method", "stationary"}, {"passes", series.state.passes}};
  out["verdict"] = answer.verdict;
  out["law"] = answer.law;
  out["class"] = class_text(verdict.kind);
  out["passes_per_cycle"] = series.cycle;
  out["net_strain_per_pass"] = verdict.rate;
  out["trend"] = verdict.trend;
  out["last_pass"] = last_pass_json(series.table);
  out["error"] = errors_json(series, answer);
  if (!answer.error.known()) out["no_error"] = answer.no_error;
  if (series.jump.length > 0)
    out["jump"] = {{"tolerance", spec.passes.jump_tolerance},
                   {"passes_in_table", series.table.rows()},
                   {"largest_error", series.jump.error}};
  if (answer.ductility)
    out["ductility"] = ductility_json(*answer.ductility, largest_strain(result), series.cycles, series.cycle);
  if (Json factors = shakedown_json(answer.elastic); !factors.is_null()) out["shakedown"] = std::move(factors);
  out["points"] = points_json(series.points, verdict.kind);
  out["zones"] = zones_json(spec, zones_of(rail));
  out["loops"] = loops_json(way.loops);
  out["grid"] = grid_json(rail.grid);
  const bool follows = spec.passes.pressure == PassPressure::following;
  out["assumptions"] = {
      follows ? "half-spaces: the rail's surface has the elastic and plastic strain of a half-space's surface"
              : "pressure and friction of the elastic bodies",
      "straight endless rail; layers without lateral ends on a half-space", "small strains",
      "one patch, the same in every pass", "the wheel stays elastic"};
  out["notes"] = rail.notes;
  for (const std::string& doubt : answer.doubts) out["notes"].push_back(doubt);
  write_whole_file(file, json_text(out, 2) + "\n");
}

}  // namespace railstrata
