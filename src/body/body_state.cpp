#include "body/body_state.hpp"

namespace railstrata {

BodyState::BodyState(const Body& body, int history_entries)
    : u(body.layout.field()),
      v(body.layout.field()),
      f(body.layout.field()),
      history(static_cast<std::size_t>(HistoryLayout(body.layout, body.mesh, history_entries).size), 0.0) {}

HistoryLayout::HistoryLayout(const BodyLayout& layout, const SweptBody& mesh, int entries_) : entries(entries_) {
  for (std::size_t b = 0; b < layout.blocks.size(); ++b) {
    offset.push_back(size);
    stride.push_back((layout.blocks[b].elements + 15) / 16 * 16);  // whole packs of any number type
    size += static_cast<std::ptrdiff_t>(mesh.blocks[b].section.quads.size()) * entries * stride.back();
  }
}

}  // namespace railstrata
