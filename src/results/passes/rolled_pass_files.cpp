#include "passes/rolled_pass_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "core/faults.hpp"
#include "model/zone.hpp"
#include "passes/pass_way.hpp"
#include "record/json.hpp"
#include "record/output_file.hpp"
#include "record/unit.hpp"

namespace railstrata {
namespace {

constexpr int kNoQuad = -1;  // in state.csv: no element has become hot

constexpr const char *kPasses = "passes", *kBlock = "block", *kQuadrilateral = "quadrilateral",
                     *kShift = "creepage_shift";

/// state.csv: a pair of Gauss points.
struct StateRow {
  int passes, block, quad, pair;
  double creepage_shift;
  const std::vector<PassStrain>& points;
  const double* history;
};
constexpr std::size_t kHeads = 5;  // columns before those of remembered_columns

Columns<StateRow> state_columns(int history) {
  using R = StateRow;
  Columns<R> out{{kPasses, unit::kCount, &R::passes},
                 {kBlock, unit::kCount, &R::block},
                 {kQuadrilateral, unit::kCount, &R::quad},
                 {"pair", unit::kCount, &R::pair},
                 {kShift, unit::kNone, &R::creepage_shift}};
  const auto points = [](const R& r) -> const std::vector<PassStrain>& { return r.points; };
  append(out, of_part<R>(remembered_columns(), points));
  for (int k = 0; k < history; ++k)
    out.push_back({fmt::format("history_{}", k), unit::kNone, [k](const R& r) { return r.history[k]; }});
  return out;
}

[[noreturn]] void refuse(const std::string& what, const std::filesystem::path& file) {
  throw CaseError(what, "start again with --force", file.string());
}

/// A whole number of a column.
int whole(const CsvTable& table, const char* name, std::size_t row) {
  const double v = table.column(name).at(row);
  if (!(v >= 0 && v < std::numeric_limits<int>::max() && v == std::floor(v)))
    refuse(fmt::format("{} cannot be {}", name, v), table.file);
  return static_cast<int>(v);
}

/// The points nearest across to the one with the largest plastic strain, from the surface down.
std::vector<PassPoint> profile_of(const std::vector<PassPoint>& points) {
  if (points.empty()) return {};
  const auto most = std::max_element(points.begin(), points.end(), [](const PassPoint& a, const PassPoint& b) {
    return a.accumulated < b.accumulated;
  });
  const double y = most->accumulated > 0 ? most->y : 0;
  std::vector<PassPoint> out;
  std::vector<PassPoint> sorted = points;
  std::sort(sorted.begin(), sorted.end(), [](const PassPoint& a, const PassPoint& b) { return a.depth < b.depth; });
  constexpr double kSameRow = 1e-4;  // m, rows follow the curved surface
  double nearest = std::numeric_limits<double>::infinity();
  for (const PassPoint& p : sorted) nearest = std::min(nearest, std::abs(p.y - y));
  for (const PassPoint& p : sorted)
    if (std::abs(p.y - y) < nearest + kSameRow) out.push_back(p);
  return out;
}

/// The rail's layers from the surface down, then the rail.
std::vector<ZoneTop> zones_of(const CaseSpec& spec) {
  std::vector<ZoneTop> out;
  double top = 0;
  for (const std::size_t layer : layers_on(spec, BodyId::rail)) {
    out.push_back({static_cast<int>(out.size()) + 1, top});
    top += spec.layers[layer].thickness;
  }
  out.push_back({0, top});
  return out;
}

/// A cell a quadrilateral, in the axes of write_section_vtk.
VtkQuads quads_of(const SectionMesh& section) {
  VtkQuads mesh;
  for (const Vec2& node : section.nodes) mesh.points.push_back({0, node.y, -node.z});
  for (const std::array<int, 4>& quad : section.quads) mesh.cells.push_back({quad[0], quad[1], quad[2], quad[3]});
  return mesh;
}

/// passes.csv by the finite elements; its contact is that in the middle of the evaluated end of a pass.
Columns<PassRow> rolled_columns() {
  using C = PassContact;
  Columns<PassRow> out = pass_columns();
  append(out, of_part<PassRow>(Columns<C>{{"traction", unit::kNone, &C::traction},
                                          {"creepage", unit::kNone, &C::creepage},
                                          {"p_max", unit::kMPa, &C::p_max},
                                          {"lateral", unit::kMillimetres, &C::lateral}},
                               &PassRow::contact));
  return out;
}

}  // namespace

void add_rolled_pass(const PlasticSection& section, RolledPass& pass, RolledSeries& series) {
  std::map<std::pair<int, int>, std::vector<PassStrain>> earlier;
  for (std::size_t n = 0; n < series.section.quads.size(); ++n)
    earlier[{series.section.quads[n].block, series.section.quads[n].quad}] = series.points[n];
  series.points.clear();
  for (const PlasticSection::Quad& q : section.quads) series.points.push_back(earlier[{q.block, q.quad}]);
  series.section = section;
  ++series.passes;
  pass.row.pass = series.passes;
  add_row(rolled_columns(), pass.row, series.table);
  series.strains.push_back(pass.row.largest);
  const PassClass whole = classify(series.strains).kind;
  for (std::size_t n = 0; n < pass.points.size(); ++n) {
    remember_pass(pass.points[n].strain, series.points[n]);
    pass.points[n].kind = class_of_point(series.points[n], whole);
  }
}

void write_rolled_state(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                        const RolledSeries& series) {
  const PlasticSection& section = series.section;
  std::vector<StateRow> rows;
  for (std::size_t n = 0; n < section.quads.size(); ++n)
    for (int pair = 0; pair < kGaussPairs; ++pair)
      rows.push_back({series.passes, section.quads[n].block, section.quads[n].quad, pair, series.creepage_shift,
                      series.points[n], section.point(n, pair)});
  const std::vector<PassStrain> none(kPointPasses);
  const std::vector<double> zeros(static_cast<std::size_t>(section.point_entries));
  if (rows.empty())  // nothing is hot: one row has the number of passes and the creepage
    rows.push_back({series.passes, 0, kNoQuad, 0, series.creepage_shift, none, zeros.data()});
  write_csv(file, provenance, rows, state_columns(section.point_entries));
}

RolledSeries read_rolled_series(const std::filesystem::path& state, const std::filesystem::path& table) {
  const CsvTable values = read_csv(state), rows = read_csv(table);
  const std::size_t heads = kHeads + 2 * kPointPasses, pairs = kGaussPairs;
  const bool nothing_hot = values.rows() == 1 && values.column(kQuadrilateral)[0] == kNoQuad;
  if (values.columns.size() < heads + 7 || values.rows() == 0 || (values.rows() % pairs != 0 && !nothing_hot))
    refuse("the state in this folder comes from another method", state);
  RolledSeries series;
  series.passes = whole(values, kPasses, 0);
  series.creepage_shift = values.column(kShift)[0];
  if (static_cast<std::size_t>(series.passes) > rows.rows() || rows.columns.size() != rolled_columns().size())
    refuse("fewer passes than the saved state contains", table);
  series.table = first_rows(rows, rolled_columns(), static_cast<std::size_t>(series.passes));
  series.strains = pass_strains(series.table);
  series.section.point_entries = static_cast<int>(values.columns.size() - heads);
  if (nothing_hot) return series;
  for (std::size_t row = 0; row < values.rows(); ++row) {
    for (std::size_t c = heads; c < values.columns.size(); ++c)
      series.section.history.push_back(values.columns[c].values[row]);
    if (row % pairs != 0) continue;
    series.section.quads.push_back({whole(values, kBlock, row), whole(values, kQuadrilateral, row)});
    series.points.push_back(remembered_passes(values, row, kHeads));
  }
  if (!std::all_of(series.section.history.begin(), series.section.history.end(),
                   [](double v) { return std::isfinite(v); }))
    refuse("a value is not a finite number", state);
  return series;
}

void write_rolled_result(const std::filesystem::path& folder, const std::vector<std::string>& provenance,
                         const CaseSpec& spec, const PassRoll& roll, const RolledSeries& series, const RolledPass& pass,
                         const std::vector<PassLoop>& loops) {
  const std::vector<PassPoint>& points = pass.points;
  std::vector<std::string> remarks = provenance;
  remarks.push_back(fmt::format("After the last pass. y, depth: axes of the rigid contact point. {}", kPointRemark));
  write_pass_points(folder / "residual.csv", remarks, points);
  remarks.emplace_back("Below the place with the largest plastic strain.");
  write_pass_points(folder / "profile.csv", remarks, profile_of(points));
  if (!points.empty()) write_points_vtk(folder / "section.vtp", quads_of(pass.mesh), points, PointColumns::of_passes);
  if (!loops.empty()) write_loops(folder / "loops.csv", provenance, loops);
  const PassVerdict verdict = classify(series.strains);
  nlohmann::ordered_json out{{"title", spec.title},
                             {"passes", series.passes},
                             {"class", class_text(verdict.kind)},
                             {"net_strain_per_pass", verdict.rate},
                             {"trend", verdict.trend}};
  out["last_pass"] = last_pass_json(series.table);
  out["points"] = points_json(series.points, verdict.kind);
  out["engine"] = "fem";
  PassProgress progress = progress_of(verdict, series.strains, pass.row);
  progress.ductility = spec.passes.ductility;
  progress.strain_life = strain_life_of(spec.rail_material, "rail", "material.rail");
  const std::string doubt = unevenness_text(pass.uneven);
  out["verdict"] = describe(progress) + (doubt.empty() ? "" : fmt::format(" Not reliable: {}.", doubt));
  out["doubts"] = doubt.empty() ? nlohmann::ordered_json::array() : nlohmann::ordered_json::array({doubt});
  if (spec.passes.ductility)
    out["ductility"] = ductility_json(*spec.passes.ductility, pass.row.strain, series.strains, 1);
  out["zones"] = zones_json(spec, zones_of(spec));
  out["loops"] = loops_json(loops);
  out["roll"] = {{"half_length_m", roll.half_length},
                 {"length_m", roll.length},
                 {"steady_from_m", roll.from},
                 {"steady_to_m", roll.to}};
  out["element_size_m"] = spec.mesh.element_size;
  out["assumptions"] = {"every pass starts with the state of the steady stations at every station",
                        "the wheel is new in every pass, with a given creepage", "small strains"};
  write_whole_file(folder / "passes.json", json_text(out, 2) + "\n");
}

void write_run_residual(const std::filesystem::path& folder, const std::vector<std::string>& provenance,
                        const RunResidual& residual) {
  if (!residual.none.empty()) {
    write_whole_file(folder / "residual.json", json_text(nlohmann::ordered_json{{"none", residual.none}}, 2) + "\n");
    return;
  }
  nlohmann::ordered_json out{{"none", nullptr}};
  for (const ResidualNumber& n : residual_numbers()) out[n.key()] = n.value(residual);
  std::vector<std::string> remarks = provenance;
  remarks.push_back(
      fmt::format("State behind the wheel: mean of the stations from {:.6g} to {:.6g} mm, in an endless rail at rest. "
                  "y, depth: axes of the rigid contact point. plastic_xy ...: tensor shears.",
                  kToMilli * residual.from, kToMilli * residual.to));
  write_pass_points(folder / "residual.csv", remarks, residual.pass.points, PointColumns::of_a_run);
  write_points_vtk(folder / "section.vtp", quads_of(residual.pass.mesh), residual.pass.points, PointColumns::of_a_run);
  write_whole_file(folder / "residual.json", json_text(out, 2) + "\n");
}

}  // namespace railstrata
