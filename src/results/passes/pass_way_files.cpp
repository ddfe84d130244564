#include "passes/pass_way_files.hpp"

#include <utility>

#include "record/csv.hpp"

namespace railstrata {
namespace {

void write_along(const std::filesystem::path& file, std::vector<std::string> remarks, const RailPasses& rail,
                 const PassWay& way) {
  remarks.push_back(
      "The longitudinal section through the governing point in the last pass. x: from the middle of the patch, the "
      "load travels to +x. elastic: the same pressure on a rail that does not yield.");
  struct Point {
    double x, y, depth;
    int zone;
    double elastic, yielding;
  };
  const SteadyGrid& g = rail.grid;
  std::vector<Point> points;
  for (int r = 0; r < g.rows(); ++r)
    for (int i = 0; i < g.active_stations(); ++i)
      points.push_back({g.x(i), g.y(way.column), g.depth(r), rail.zone[static_cast<std::size_t>(r)],
                        way.elastic[points.size()], way.yielding[points.size()]});
  write_csv(file, remarks, points,
            Columns<Point>{{"x", unit::kMillimetres, &Point::x},
                           {"y", unit::kMillimetres, &Point::y},
                           {"depth", unit::kMillimetres, &Point::depth},
                           {"zone", unit::kCount, &Point::zone},
                           {"von_mises_elastic", unit::kMPa, &Point::elastic},
                           {"von_mises", unit::kMPa, &Point::yielding}});
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
      "The last pass, station by station as the load passes. point: its place in passes.json, loops. strain: tensor "
      "shears.");
  struct LoopStep {
    int point;
    double y, depth, x;
    const StationState& state;
  };
  std::vector<LoopStep> steps;
  for (std::size_t k = 0; k < loops.size(); ++k)
    for (std::size_t i = 0; i < loops[k].states.size(); ++i)
      steps.push_back({static_cast<int>(k), loops[k].y, loops[k].depth, loops[k].x[i], loops[k].states[i]});
  Columns<LoopStep> columns{{"point", unit::kCount, &LoopStep::point},
                            {"y", unit::kMillimetres, &LoopStep::y},
                            {"depth", unit::kMillimetres, &LoopStep::depth},
                            {"x", unit::kMillimetres, &LoopStep::x}};
  append(columns, tensor_columns<LoopStep>("sigma", unit::kMPa, [](const LoopStep& s) { return s.state.stress; }));
  append(columns, tensor_columns<LoopStep>("strain", unit::kNone, [](const LoopStep& s) { return s.state.strain; }));
  append(columns, {{"plastic_strain_accumulated", unit::kNone, [](const LoopStep& s) { return s.state.accumulated; }}});
  write_csv(file, remarks, steps, columns);
}

void write_way(const std::filesystem::path& folder, const std::vector<std::string>& provenance, const RailPasses& rail,
               const PassWay& way) {
  write_loops(folder / "loops.csv", provenance, loops_of(rail, way));
  write_along(folder / "along.csv", provenance, rail, way);
}

void write_points_vtk(const std::filesystem::path& file, VtkQuads mesh, const std::vector<PassPoint>& points,
                      PointColumns which) {
  const PointLists lists = point_lists(which);
  mesh.cell_fields = {vtk_field<double>("residual_stress", points, lists.stress),
                      vtk_field<double>("plastic_strain", points, lists.plastic)};
  for (const Columns<PassPoint>& columns : {lists.accumulated, lists.of_pass, lists.zone})
    add_vtk_fields<double>(mesh.cell_fields, points, columns);
  write_vtp(file, mesh);
}

void write_section_vtk(const std::filesystem::path& file, const RailPasses& rail, const PassSeries& series,
                       const PassResult& last) {
  write_points_vtk(file, quads_of(rail.grid), section_points(rail, series, last), PointColumns::of_passes);
}

}  // namespace railstrata
