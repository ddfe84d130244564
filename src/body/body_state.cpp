#include "body/body_state.hpp"

namespace railstrata {

BodyState::BodyState(const Body& body, int history_entries) {
  for (const StateArray& a : kStateArrays) (this->*a.values).assign(array_size(body, a, history_entries), 0.0);
}

std::size_t array_size(const Body& body, const StateArray& array, int history_entries) {
  const bool nodal = array.values != &BodyState::history;
  return static_cast<std::size_t>(nodal ? body.layout.size
                                        : HistoryLayout(body.layout, body.mesh, history_entries).size);
}

HistoryLayout::HistoryLayout(const BodyLayout& layout, const SweptBody& mesh, int entries_) : entries(entries_) {
  for (std::size_t b = 0; b < layout.blocks.size(); ++b) {
    offset.push_back(size);
    stride.push_back((layout.blocks[b].elements + 15) / 16 * 16);  // whole packs of any number type
    size += static_cast<std::ptrdiff_t>(mesh.blocks[b].section.quads.size()) * entries * stride.back();
  }
}

}  // namespace railstrata
