#pragma once
// What `check` reports and writes of a model's meshes.
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "mesh/quality.hpp"
#include "model/model.hpp"

namespace railstrata {

struct MeshRow {
  std::string body;
  BlockQuality quality;
  double step = 0;  ///< s, smallest edge over the fastest wave speed of the body's materials: a bound that shows which
                    ///< block limits the step
};

/// Rows of the table of meshes: one per block of both bodies.
std::vector<MeshRow> mesh_rows(const Model& model);

/// The rows as an aligned table.
std::string mesh_table(const std::vector<MeshRow>& rows);
nlohmann::ordered_json mesh_json(const std::vector<MeshRow>& rows);

/// A VTU file with materials, blocks and scaled Jacobians.
void write_mesh(const std::filesystem::path& file, const SweptBody& body);

}  // namespace railstrata
