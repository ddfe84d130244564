#include "body/body_state.hpp"

namespace railstrata {

BodyState::BodyState(const Body& body) : history(initial_history(body)) {
  for (Field* nodal : {&u, &v, &f}) *nodal = body.layout.field();
}

bool fits(const Body& body, const BodyState& state) {
  for (const StateArray& a : kStateArrays)
    if (a.restart && (state.*a.values).size() != static_cast<std::size_t>(body.layout.size)) return false;
  return body.plastic.fits(state.history);
}

PlasticHistory initial_history(const Body& body) {
  PlasticHistory out;
  body.plastic.initialise(out);
  return out;
}

}  // namespace railstrata
