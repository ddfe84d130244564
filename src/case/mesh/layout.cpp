#include "mesh/layout.hpp"

#include "core/simd.hpp"

namespace railstrata {

BodyLayout layout_of(const SweptBody& body) {
  BodyLayout layout;
  layout.size = kLanes - 1;
  for (const Block& b : body.blocks) {
    BlockLayout l;
    l.offset = layout.size;
    l.nodes = static_cast<int>(b.section.nodes.size());
    l.stations = b.stations.nodes();
    l.elements = b.stations.elements();
    l.closed = b.stations.closed;
    l.stride = whole_packs(l.elements) + kLanes;
    layout.size += static_cast<std::ptrdiff_t>(l.nodes) * 3 * l.stride;
    layout.blocks.push_back(l);
  }
  return layout;
}

}  // namespace railstrata
