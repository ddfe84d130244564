#include "passes/rolled_pass_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/faults.hpp"
#include "model/zone.hpp"
#include "passes/pass_json.hpp"
#include "passes/pass_way_files.hpp"
#include "record/csv.hpp"
#include "record/json.hpp"
#include "record/output_file.hpp"
#include "record/unit.hpp"
#include "record/vtk.hpp"

namespace railstrata {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kNoQuad = -1;  // in state.csv: no element has become hot

/// A row of passes.csv by the finite elements.
struct RolledRow {
  const PassRow& pass;
  const PassContact& contact;
};

Columns<RolledRow> rolled_row_columns() {
  using R = RolledRow;
  Columns<R> out = of_part<R>(pass_columns(), [](const R& r) -> const PassRow& { return r.pass; });
  append(out, {{"traction", unit::kNone, [](const R& r) { return r.contact.traction; }},
               {"creepage", unit::kNone, [](const R& r) { return r.contact.creepage; }},
               {"p_max", unit::kMPa, [](const R& r) { return r.contact.p_max; }},
               {"lateral", unit::kMillimetres, [](const R& r) { return r.contact.lateral; }}});
  return out;
}

/// Columns of the state before the numbers of a point.
std::vector<std::string> state_heads() {
  std::vector<std::string> names{"passes", "block", "quadrilateral", "pair", "creepage_shift"};
  for (std::size_t n = 0; n < kPointPasses; ++n)
    for (const char* what : {"accumulated", "net"}) names.push_back(fmt::format("{}_{}", what, n));
  return names;
}

[[noreturn]] void refuse(const std::string& what, const std::filesystem::path& file) {
  throw CaseError(what, "begin anew with --force", file.string());
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

}  // namespace

std::vector<std::string> rolled_columns() { return names_of(rolled_row_columns()); }

std::vector<double> rolled_values(const PassRow& pass, const PassContact& contact) {
  return table_row(rolled_row_columns(), {pass, contact});
}

void write_rolled_table(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                        const RolledSeries& series) {
  write_pass_rows(file, provenance, rolled_columns(), series.table);
}

void write_rolled_state(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                        const RolledSeries& series) {
  std::vector<CsvColumn> columns;
  for (std::string& name : state_heads()) columns.push_back({std::move(name), {}});
  const PlasticSection& section = series.section;
  for (int k = 0; k < section.point_entries; ++k) columns.push_back({fmt::format("history_{}", k), {}});
  for (std::size_t n = 0; n < section.quads.size(); ++n)
    for (int pair = 0; pair < kGaussPairs; ++pair) {
      std::size_t c = 0;
      const auto put = [&](double value) { columns[c++].values.push_back(value); };
      for (const int v : {series.passes, section.quads[n].block, section.quads[n].quad, pair}) put(v);
      put(series.creepage_shift);
      for (std::size_t k = 0; k < kPointPasses; ++k) {
        const bool known = k < series.points[n].size();
        put(known ? series.points[n][k].accumulated : kUnknown);
        put(known ? series.points[n][k].net : kUnknown);
      }
      for (int k = 0; k < section.point_entries; ++k) put(section.point(n, pair)[k]);
    }
  if (section.quads.empty()) {  // nothing is hot: one row has the number of passes and the creepage
    for (CsvColumn& column : columns) column.values.push_back(0);
    columns[0].values[0] = series.passes;
    columns[2].values[0] = kNoQuad;
    columns[4].values[0] = series.creepage_shift;
  }
  write_csv(file, provenance, columns);
}

RolledSeries read_rolled_series(const std::filesystem::path& state, const std::filesystem::path& table) {
  const CsvTable values = read_csv(state), rows = read_csv(table);
  const std::size_t heads = state_heads().size(), pairs = kGaussPairs;
  const bool nothing_hot = values.rows() == 1 && values.column("quadrilateral")[0] == kNoQuad;
  if (values.columns.size() < heads + 7 || values.rows() == 0 || (values.rows() % pairs != 0 && !nothing_hot))
    refuse("the state is none of such passes", state);
  RolledSeries series;
  series.passes = whole(values, "passes", 0);
  series.creepage_shift = values.column("creepage_shift")[0];
  if (static_cast<std::size_t>(series.passes) > rows.rows() || rows.columns.size() != rolled_columns().size())
    refuse("fewer passes than the state has seen", table);
  for (int n = 0; n < series.passes; ++n) {
    series.table.emplace_back();
    for (const CsvColumn& column : rows.columns) series.table.back().push_back(column.values[n]);
    series.strains.push_back({rows.column("accumulated_strain")[static_cast<std::size_t>(n)],
                              rows.column("net_strain")[static_cast<std::size_t>(n)]});
  }
  series.section.point_entries = static_cast<int>(values.columns.size() - heads);
  if (nothing_hot) return series;
  for (std::size_t row = 0; row < values.rows(); ++row) {
    for (std::size_t c = heads; c < values.columns.size(); ++c)
      series.section.history.push_back(values.columns[c].values[row]);
    if (row % pairs != 0) continue;
    series.section.quads.push_back({whole(values, "block", row), whole(values, "quadrilateral", row)});
    series.points.emplace_back();
    for (std::size_t k = 0; k < kPointPasses; ++k) {
      const double net = values.columns[heads - 2 * (kPointPasses - k) + 1].values[row];
      if (!std::isnan(net))
        series.points.back().push_back({values.columns[heads - 2 * (kPointPasses - k)].values[row], net});
    }
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
  remarks.emplace_back(
      "After the last pass. y, depth: axes of the rigid contact point. class: 0 elastic shakedown, 1 plastic "
      "shakedown, "
      "2 ratchetting, 3 transient. plastic_xy ...: tensor shears; plastic_strain_accumulated: accumulated over all "
      "passes.");
  write_pass_points(folder / "residual.csv", remarks, points);
  remarks.emplace_back("Below the place with the largest plastic strain.");
  write_pass_points(folder / "profile.csv", remarks, profile_of(points));
  if (!points.empty()) write_points_vtk(folder / "section.vtp", quads_of(pass.mesh), points, PointColumns::of_passes);
  if (!loops.empty()) write_loops(folder / "loops.csv", provenance, loops);
  const PassVerdict verdict = classify(series.strains);
  nlohmann::ordered_json out{{"title", spec.title},
                             {"passes", series.table.size()},
                             {"class", words(verdict.kind)},
                             {"net_strain_per_pass", verdict.rate},
                             {"trend", verdict.trend}};
  out["last_pass"] = last_pass_json(rolled_columns(), series.table.back());
  out["points"] = points_json(series.points, verdict.kind);
  out["engine"] = "fem";
  out["verdict"] = pass_words(standing_of(verdict, series.strains, pass.row));
  if (spec.passes.ductility)
    out["ductility"] = ductility_json(*spec.passes.ductility, largest_plastic_norm(pass.points), series.strains, 1);
  out["zones"] = zones_json(spec, zones_of(spec));
  out["loops"] = loops_json(loops);
  out["roll"] = {{"half_length_m", roll.half_length},
                 {"length_m", roll.length},
                 {"steady_from_m", roll.from},
                 {"steady_to_m", roll.to}};
  out["element_size_m"] = spec.mesh.element_size;
  out["assumptions"] = {"every pass begins with the state of the steady stations at every station",
                        "the wheel is a new one in every pass, with a given creepage", "small strains"};
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
  remarks.push_back(fmt::format(
      "What the wheel leaves behind: mean of the stations from {:.6g} to {:.6g} mm, in an endless rail at rest. y, "
      "depth: axes of the rigid contact point. plastic_xy ...: tensor shears.",
      kToMilli * residual.from, kToMilli * residual.to));
  write_pass_points(folder / "residual.csv", remarks, residual.pass.points, PointColumns::of_a_run);
  write_points_vtk(folder / "section.vtp", quads_of(residual.pass.mesh), residual.pass.points, PointColumns::of_a_run);
  write_whole_file(folder / "residual.json", json_text(out, 2) + "\n");
}

}  // namespace railstrata
