#include "body/tiling.hpp"

#include <algorithm>

#include "mesh/sweep_order.hpp"

namespace railstrata {
namespace {

// A node gets the lowest free slot at its first touch and returns it after its last.
SweepPlan sweep_plan(const Section& section) {
  const auto& quads = section.quads;
  const std::size_t nodes = section.nodes.size();
  SweepPlan plan;
  plan.order = sweep_order(section);
  plan.first.resize(quads.size());
  plan.last.resize(quads.size());
  std::vector<int> first(nodes, -1), last(nodes, -1);
  for (int q : plan.order)
    for (int n : quads[q]) {
      if (first[n] < 0) first[n] = q;
      last[n] = q;
    }
  plan.slot.assign(nodes, 0);
  std::vector<char> taken;
  for (int q : plan.order) {
    for (int k = 0; k < 4; ++k) {
      const int n = quads[q][k];
      if (first[n] != q) continue;
      plan.first[q][k] = 1;
      const auto free = std::find(taken.begin(), taken.end(), 0);
      plan.slot[n] = static_cast<int>(free - taken.begin());
      if (free == taken.end())
        taken.push_back(1);
      else
        *free = 1;
    }
    for (int k = 0; k < 4; ++k) {
      if (last[quads[q][k]] != q) continue;
      plan.last[q][k] = 1;
      taken[plan.slot[quads[q][k]]] = 0;
    }
  }
  plan.slots = static_cast<int>(taken.size());
  return plan;
}

}  // namespace

Tiling tiling_of(const SweptBody& body, const BodyLayout& layout) {
  Tiling out;
  for (int b = 0; b < static_cast<int>(body.blocks.size()); ++b) {
    const BlockLayout& lay = layout.blocks[b];
    out.plans.push_back(sweep_plan(body.blocks[b].section));
    out.first_tile.push_back(static_cast<int>(out.tiles.size()));
    for (int first = 0; first < lay.elements; first += kTile) {
      out.tiles.push_back({b, first, std::min(first + kTile, lay.elements)});
      out.border.push_back(out.border_size);
      out.border_size += static_cast<std::ptrdiff_t>(lay.nodes) * 3;
    }
  }
  out.first_tile.push_back(static_cast<int>(out.tiles.size()));
  return out;
}

}  // namespace railstrata
