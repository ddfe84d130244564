#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <nlohmann/json.hpp>

#include "app/case_of.hpp"
#include "app/commands.hpp"
#include "app/common_options.hpp"
#include "app/mesh_report.hpp"
#include "io/output_folder.hpp"
#include "mesh/unstructured.hpp"
#include "record/vtk.hpp"

namespace railstrata {
namespace {

void write_body(const std::filesystem::path& file, const SweptBody& body) {
  HexMesh mesh = unstructured(body);
  VtkHexahedra out;
  out.points = std::move(mesh.points);
  out.cells = std::move(mesh.cells);
  out.cell_fields = {{"material", 1, std::vector<std::int32_t>(mesh.material.begin(), mesh.material.end())},
                     {"block", 1, std::vector<std::int32_t>(mesh.block.begin(), mesh.block.end())},
                     {"scaled_jacobian", 1, std::move(mesh.scaled_jacobian)}};
  write_vtu(file, out);
}

nlohmann::ordered_json as_json(const std::vector<MeshRow>& rows) {
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

ExitCode command_mesh(const CommandOptions& options) {
  const LoadedCase loaded = load_case_of(options);
  require_finite_elements(loaded);
  const Model model = build_model(loaded.spec, loaded.folder());
  const std::filesystem::path out = output_folder_of(options, loaded);
  const FolderHold hold = prepare_output_folder(out, options.force);
  write_origin(out, loaded, options.command_line, options.threads);
  write_body(out / "rail.vtu", model.rail);
  write_body(out / "wheel.vtu", model.wheel);
  const std::vector<MeshRow> rows = mesh_rows(model);
  if (options.json)
    fmt::print("{}\n", as_json(rows).dump(2));
  else
    fmt::print("{}\nrail.vtu and wheel.vtu are in {}\n", mesh_table(rows), out.string());
  return ExitCode::ok;
}

}  // namespace

const Command kMeshCommand{"mesh", "Make the meshes and write them as VTU with a table of their quality",
                           "Examples:\n  railstrata mesh cases/quick --out /tmp/mesh\n", add_case_and_output,
                           command_mesh};

}  // namespace railstrata
