#include "body/body_state.hpp"

namespace railstrata {

BodyState::BodyState(const Body& body, int history_entries) {
  for (const StateArray& a : kStateArrays) (this->*a.values).assign(array_size(body, a, history_entries), 0.0);
}

std::size_t array_size(const Body& body, const StateArray& array, int history_entries) {
  const bool nodal = array.values != &BodyState::history;
  if (nodal) return static_cast<std::size_t>(body.layout.size);
  const bool own = history_entries == body.history.entries;
  return static_cast<std::size_t>(own ? body.history.size
                                      : HistoryLayout(body.layout, body.mesh, history_entries).size);
}

}  // namespace railstrata
