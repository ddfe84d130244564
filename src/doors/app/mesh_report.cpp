#include "app/mesh_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "mesh/unstructured.hpp"
#include "record/vtk.hpp"

namespace railstrata {
namespace {

double fastest_wave(const std::vector<Elastic>& materials) {
  double c = 0;
  for (const Elastic& m : materials) c = std::max(c, std::sqrt((m.lambda + 2 * m.mu) / m.density));
  return c;
}

void add_rows(std::vector<MeshRow>& rows, const SweptBody& body, const std::vector<Elastic>& materials) {
  const double fastest = fastest_wave(materials), matrix = fastest_wave({materials.front()});
  for (const BlockQuality& q : measure_quality(body)) {
    const bool layered = q.block == body.blocks[body.contact.block].name;
    rows.push_back({body.name, q, q.edge_min / (layered ? fastest : matrix)});
  }
}

}  // namespace

std::vector<MeshRow> mesh_rows(const Model& model) {
  std::vector<MeshRow> rows;
  add_rows(rows, model.rail, model.rail_materials);
  add_rows(rows, model.wheel, model.wheel_materials);
  return rows;
}

nlohmann::ordered_json mesh_json(const std::vector<MeshRow>& rows) {
  auto out = nlohmann::ordered_json::array();
  for (const MeshRow& r : rows)
    out.push_back({{"body", r.body},
                   {"block", r.quality.block},
                   {"elements", r.quality.elements},
                   {"scaled_jacobian_min", r.quality.scaled_jacobian_min},
                   {"aspect_max", r.quality.aspect_max},
                   {"edge_min_m", r.quality.edge_min},
                   {"edge_over_wave_speed_s", r.step}});
  return out;
}

std::string mesh_table(const std::vector<MeshRow>& rows) {
  std::string out = fmt::format("{:<6} {:<14} {:>10} {:>12} {:>10} {:>12} {:>12}\n", "body", "block", "elements",
                                "Jacobian", "aspect", "edge/mm", "edge/c/ns");
  const auto limiting =
      std::min_element(rows.begin(), rows.end(), [](const MeshRow& a, const MeshRow& b) { return a.step < b.step; });
  for (auto row = rows.begin(); row != rows.end(); ++row)
    out += fmt::format("{:<6} {:<14} {:>10} {:>12.3f} {:>10.1f} {:>12.4f} {:>12.2f}{}\n", row->body, row->quality.block,
                       row->quality.elements, row->quality.scaled_jacobian_min, row->quality.aspect_max,
                       1e3 * row->quality.edge_min, 1e9 * row->step, row == limiting ? "  limits the step" : "");
  return out;
}

void write_mesh(const std::filesystem::path& file, const SweptBody& body) {
  HexMesh mesh = unstructured(body);
  VtkHexahedra out;
  out.points = std::move(mesh.points);
  out.cells = std::move(mesh.cells);
  out.cell_fields = {{"material", 1, std::vector<std::int32_t>(mesh.material.begin(), mesh.material.end())},
                     {"block", 1, std::vector<std::int32_t>(mesh.block.begin(), mesh.block.end())},
                     {"scaled_jacobian", 1, std::move(mesh.scaled_jacobian)}};
  write_vtu(file, out);
}

}  // namespace railstrata
