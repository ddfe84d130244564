#include "body/body_state.hpp"

namespace railstrata {

BodyState::BodyState(const Body& body, int history_entries) {
  for (const StateArray& a : kStateArrays) (this->*a.values).assign(array_size(body, a, history_entries), 0.0);
  if (history_entries == body.history.entries) history = initial_history(body);
}

std::size_t array_size(const Body& body, const StateArray& array, int history_entries) {
  const bool nodal = array.values != &BodyState::history;
  if (nodal) return static_cast<std::size_t>(body.layout.size);
  if (history_entries != body.history.entries)
    return static_cast<std::size_t>(HistoryLayout(body.layout, body.mesh, history_entries).size);
  return static_cast<std::size_t>(body.history.size + body.plastic.size());
}

Field initial_history(const Body& body) {
  Field out(static_cast<std::size_t>(body.history.size + body.plastic.size()), 0.0);
  body.plastic.initialise(out.data() + body.history.size);
  return out;
}

}  // namespace railstrata
