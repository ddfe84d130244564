#pragma once
// The text of `check` and `mesh` about a model's meshes.
#include <string>
#include <vector>

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

}  // namespace railstrata
