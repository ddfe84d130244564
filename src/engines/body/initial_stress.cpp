#include "body/initial_stress.hpp"

#include <algorithm>
#include <map>

#include "body/tiling.hpp"
#include "element/plastic_hex.hpp"

namespace railstrata {

InitialStress::InitialStress(const SweptBody& mesh, const StressOf& stress_of) {
  std::map<Stress, int> known;
  std::vector<std::vector<int>> kind;
  for (int b = 0; b < static_cast<int>(mesh.blocks.size()); ++b) {
    kind.emplace_back();
    for (int q = 0; q < static_cast<int>(mesh.blocks[b].section.quads.size()); ++q) {
      const Stress s = stress_of(b, q);
      if (s == Stress{}) {
        kind.back().push_back(-1);
        continue;
      }
      const auto [at, is_new] = known.try_emplace(s, static_cast<int>(rows_.size()));
      kind.back().push_back(at->second);
      if (!is_new) continue;
      rows_.emplace_back(static_cast<std::size_t>(kEigenstressEntries) * kTile, 0.0);
      for (int i = 0; i < 6; ++i)
        std::fill_n(rows_.back().begin() + static_cast<std::ptrdiff_t>(i) * kTile, kTile, -s[i]);
    }
  }
  if (!rows_.empty()) kind_ = std::move(kind);
}

}  // namespace railstrata
