#include "body/deformable_body.hpp"

#include <algorithm>

namespace railstrata {

DeformableBody::DeformableBody(const SweptBody& mesh, const std::vector<Elastic>& materials,
                               const SolidOptions& options)
    : solid(mesh, materials, options), ties(mesh, solid.layout()), mass(solid.mass()) {
  ties.collect(mass);
  const BodyLayout& lay = solid.layout();
  std::vector<std::vector<bool>> held;
  for (const BlockLayout& b : lay.blocks) held.emplace_back(b.nodes, false);
  for (const SectionNode& n : mesh.held) held[n.block][n.node] = true;
  inverse_mass = lay.field();
  for (int b = 0; b < static_cast<int>(lay.blocks.size()); ++b)
    for (int n = 0; n < lay.blocks[b].nodes; ++n)
      for (int i = 0; i < 3; ++i) {
        const std::ptrdiff_t first = lay.blocks[b].line(n, i);
        const int count = lay.blocks[b].stations;
        if (held[b][n] || ties.is_slave(b, n)) {
          if (!held[b][n]) std::fill(mass.begin() + first, mass.begin() + first + count, 0.0);
          continue;
        }
        for (int j = 0; j < count; ++j) inverse_mass[first + j] = 1 / mass[first + j];
        lines.push_back({first, count, i, b, n});
      }
}

}  // namespace railstrata
