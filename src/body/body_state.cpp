#include "body/body_state.hpp"

namespace railstrata {

BodyState::BodyState(const Body& body, int history_entries) {
  for (Field* nodal : {&u, &v, &f}) *nodal = body.layout.field();
  if (history_entries == body.history.entries)
    history = initial_history(body);
  else
    history.assign(static_cast<std::size_t>(HistoryLayout(body.layout, body.mesh, history_entries).size), 0.0);
}

bool fits(const Body& body, const StateArray& array, const Field& values) {
  if (array.values == &BodyState::history) {
    if (body.plastic.empty()) return values.size() == static_cast<std::size_t>(body.history.size);
    return body.plastic.fits(values);
  }
  return values.size() == static_cast<std::size_t>(body.layout.size);
}

Field initial_history(const Body& body) {
  Field out(static_cast<std::size_t>(body.history.size), 0.0);
  body.plastic.initialise(out);
  return out;
}

}  // namespace railstrata
