#include "body/body_state.hpp"

namespace railstrata {

BodyState::BodyState(const Body& body) : history(initial_history(body)) {
  for (Field* nodal : {&u, &v, &f}) *nodal = body.layout.field();
}

bool fits(const Body& body, const StateArray& array, const Field& values) {
  if (array.values == &BodyState::history) {
    return body.plastic.empty() ? values.empty() : body.plastic.fits(values);
  }
  return values.size() == static_cast<std::size_t>(body.layout.size);
}

Field initial_history(const Body& body) {
  Field out;
  body.plastic.initialise(out);
  return out;
}

}  // namespace railstrata
