#include "passes/pass_way_files.hpp"

#include <cstdint>
#include <utility>

#include "core/si_prefix.hpp"
#include "io/csv.hpp"

namespace railstrata {
namespace {

constexpr const char* kTensor[] = {"xx", "yy", "zz", "xy", "yz", "xz"};

void write_along(const std::filesystem::path& file, std::vector<std::string> remarks, const RailPasses& rail,
                 const PassWay& way) {
  remarks.push_back(
      "The longitudinal section through the governing point in the last pass. x: from the middle of the patch, the "
      "load travels to +x. elastic: the same pressure on a rail that does not yield.");
  const SteadyGrid& g = rail.grid;
  std::vector<CsvColumn> columns{
      {"x_mm", {}}, {"y_mm", {}}, {"depth_mm", {}}, {"zone", {}}, {"von_mises_elastic_MPa", {}}, {"von_mises_MPa", {}}};
  std::size_t n = 0;
  for (int r = 0; r < g.rows(); ++r)
    for (int i = 0; i < g.active_stations(); ++i, ++n) {
      const double row[] = {kToMilli * g.x(i),        kToMilli * g.y(way.column),
                            kToMilli * g.depth(r),    static_cast<double>(rail.zone[static_cast<std::size_t>(r)]),
                            kToMega * way.elastic[n], kToMega * way.yielding[n]};
      for (std::size_t c = 0; c < columns.size(); ++c) columns[c].values.push_back(row[c]);
    }
  write_csv(file, remarks, columns);
}

/// Corners of the section's cells, and the cells row by row.
VtkQuads quads_of(const SteadyGrid& g) {
  const double width = g.ny > 1 ? g.dy : g.dx;
  VtkQuads mesh;
  double z = 0;
  for (int r = 0; r <= g.rows(); ++r) {
    for (int j = 0; j <= g.ny; ++j) mesh.points.push_back({0, g.y(0) + (j - 0.5) * width, -z});
    if (r < g.rows()) z += g.thickness[static_cast<std::size_t>(r)];
  }
  const long long row = g.ny + 1;
  for (int r = 0; r < g.rows(); ++r)
    for (int j = 0; j < g.ny; ++j) {
      const long long at = r * row + j;
      mesh.cells.push_back({at, at + 1, at + row + 1, at + row});
    }
  return mesh;
}

}  // namespace

std::vector<PassLoop> loops_of(const RailPasses& rail, const PassWay& way) {
  const SteadyGrid& g = rail.grid;
  std::vector<PassLoop> out;
  for (std::size_t k = 0; k < way.points.size(); ++k) {
    const int n = static_cast<int>(way.points[k].point);
    PassLoop loop{way.points[k].name, g.y(n % g.ny), g.depth(n / g.ny), {}, way.loops[k]};
    for (std::size_t i = 0; i < loop.states.size(); ++i) loop.x.push_back(g.x(static_cast<int>(i)));
    out.push_back(std::move(loop));
  }
  return out;
}

void write_loops(const std::filesystem::path& file, std::vector<std::string> remarks,
                 const std::vector<PassLoop>& loops) {
  remarks.emplace_back(
      "The last pass, station after station as the load goes over. point: its place in passes.json, loops. strain: "
      "tensor shears.");
  std::vector<CsvColumn> columns{{"point", {}}, {"y_mm", {}}, {"depth_mm", {}}, {"x_mm", {}}};
  for (const char* c : kTensor) columns.push_back({std::string(c[0] == c[1] ? "sigma_" : "tau_") + c + "_MPa", {}});
  for (const char* c : kTensor) columns.push_back({std::string("strain_") + c, {}});
  columns.push_back({"plastic_p", {}});
  for (std::size_t k = 0; k < loops.size(); ++k)
    for (std::size_t i = 0; i < loops[k].states.size(); ++i) {
      const StationState& s = loops[k].states[i];
      std::vector<double> row{static_cast<double>(k), kToMilli * loops[k].y, kToMilli * loops[k].depth,
                              kToMilli * loops[k].x[i]};
      for (const double stress : s.stress) row.push_back(kToMega * stress);
      row.insert(row.end(), s.strain.begin(), s.strain.end());
      row.push_back(s.accumulated);
      for (std::size_t c = 0; c < row.size(); ++c) columns[c].values.push_back(row[c]);
    }
  write_csv(file, remarks, columns);
}

void write_way(const std::filesystem::path& folder, const std::vector<std::string>& provenance, const RailPasses& rail,
               const PassWay& way) {
  write_loops(folder / "loops.csv", provenance, loops_of(rail, way));
  write_along(folder / "along.csv", provenance, rail, way);
}

void write_points_vtk(const std::filesystem::path& file, VtkQuads mesh, const std::vector<PassPoint>& points,
                      PointColumns which) {
  std::vector<double> stress, strain, p, accumulated, net;
  std::vector<std::int32_t> kind, zone;
  for (const PassPoint& at : points) {
    for (const double s : at.stress) stress.push_back(kToMega * s);
    strain.insert(strain.end(), at.plastic.begin(), at.plastic.end());
    p.push_back(at.accumulated);
    accumulated.push_back(at.strain.accumulated);
    net.push_back(at.strain.net);
    kind.push_back(static_cast<std::int32_t>(at.kind));
    zone.push_back(at.zone);
  }
  mesh.cell_fields = {{"residual_stress_MPa", 6, std::move(stress)},
                      {"plastic_strain", 6, std::move(strain)},
                      {"plastic_p", 1, std::move(p)}};
  if (which == PointColumns::of_passes) {
    mesh.cell_fields.push_back({"accumulated_strain", 1, std::move(accumulated)});
    mesh.cell_fields.push_back({"net_strain", 1, std::move(net)});
    mesh.cell_fields.push_back({"class", 1, std::move(kind)});
  }
  mesh.cell_fields.push_back({"zone", 1, std::move(zone)});
  write_vtp(file, mesh);
}

void write_section_vtk(const std::filesystem::path& file, const RailPasses& rail, const PassSeries& series,
                       const PassResult& last) {
  write_points_vtk(file, quads_of(rail.grid), section_points(rail, series, last), PointColumns::of_passes);
}

}  // namespace railstrata
