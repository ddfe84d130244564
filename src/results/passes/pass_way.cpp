#include "passes/pass_way.hpp"

#include <algorithm>
#include <utility>

#include "material/elastic.hpp"
#include "record/csv.hpp"

namespace railstrata {
namespace {

Sym3 as_tensor(const std::array<double, 6>& s) { return {s[0], s[1], s[2], s[3], s[4], s[5]}; }

std::size_t largest(const std::vector<double>& values) {
  return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

/// Where the elastic stress of a row's column comes nearest to yield.
std::size_t nearest_to_yield(const RailPasses& rail) {
  const SteadyGrid g = rail.grid.path();
  const Field& stress = rail.contact_stress.front();
  std::vector<double> share(g.points());
  for (int r = 0; r < g.rows(); ++r)
    for (int j = 0; j < g.ny; ++j)
      for (int i = 0; i < g.active_stations(); ++i) {
        std::array<double, 6> s{};
        for (int c = 0; c < 6; ++c) s[c] = stress[g.active_index(c, r, i, j)];
        double& most = share[g.point(r, j)];
        most = std::max(most, von_mises(as_tensor(s)) / rail.rows[static_cast<std::size_t>(r)].law.yield);
      }
  return largest(share);
}

/// A point of the section whose history over the passes is recorded.
struct WayPoint {
  std::string name;
  std::size_t point = 0;  ///< SteadyGrid::point
};

std::vector<WayPoint> way_points(const RailPasses& rail, const PassResult& last, const PassState& state) {
  const SteadyGrid& g = rail.grid;
  std::vector<double> p(g.points());
  for (std::size_t n = 0; n < p.size(); ++n) p[n] = state.history[n * kStreamlineHistory + 6];
  const std::size_t net = largest(last.net), flowed = largest(p);
  const std::size_t governing = last.net[net] > 0 ? net : p[flowed] > 0 ? flowed : nearest_to_yield(rail);
  const int column = static_cast<int>(governing) % g.ny;
  std::vector<WayPoint> out{{"governing", governing}};
  const auto add = [&](const std::string& name, int row) {
    const std::size_t n = g.point(row, column);
    const bool there = std::any_of(out.begin(), out.end(), [&](const WayPoint& w) { return w.point == n; });
    if (!there) out.push_back({name, n});
  };
  add("surface", 0);
  for (int r = 1; r < g.rows(); ++r)
    if (rail.zone[static_cast<std::size_t>(r)] != rail.zone[static_cast<std::size_t>(r) - 1]) {
      add("above the border", r - 1);
      add("below the border", r);
    }
  return out;
}

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
  const SteadyGrid g = rail.grid.path();
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

PassWay pass_way(const RailPasses& rail, const SteadyBody& body, const Field& contact, const PassResult& last,
                 const PassState& state) {
  const SteadyGrid g = rail.grid.path();
  const std::vector<WayPoint> way = way_points(rail, last, state);
  PassWay out;
  out.row = static_cast<int>(way.front().point) / g.ny;
  out.column = static_cast<int>(way.front().point) % g.ny;
  std::vector<std::size_t> points;
  for (const WayPoint& w : way) points.push_back(w.point);
  std::vector<std::vector<StationState>> states = body.streamlines(contact, last, state, points);
  for (std::size_t k = 0; k < way.size(); ++k) {
    PassLoop& loop = out.loops.emplace_back();
    loop = {way[k].name, g.y(out.column), g.depth(static_cast<int>(way[k].point) / g.ny), {}, std::move(states[k])};
    for (std::size_t i = 0; i < loop.states.size(); ++i) loop.x.push_back(g.x(static_cast<int>(i)));
  }
  points.clear();
  for (int r = 0; r < g.rows(); ++r) points.push_back(g.point(r, out.column));
  const auto column = body.streamlines(contact, last, state, points);
  for (int r = 0; r < g.rows(); ++r)
    for (int i = 0; i < g.active_stations(); ++i) {
      std::array<double, 6> e{};
      for (int c = 0; c < 6; ++c) e[c] = contact[g.active_index(c, r, i, out.column)];
      std::array<double, 6> s = body.stress_of(r, e);
      const auto& process = rail.initial_stress[static_cast<std::size_t>(r)];
      s[0] += process[0];
      s[1] += process[1];
      out.elastic.push_back(von_mises(as_tensor(s)));
      out.yielding.push_back(
          von_mises(as_tensor(column[static_cast<std::size_t>(r)][static_cast<std::size_t>(i)].stress)));
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
  write_loops(folder / "loops.csv", provenance, way.loops);
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
