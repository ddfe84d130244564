#include "body/body_state.hpp"

namespace railstrata {

BodyState::BodyState(const Body& body, int history_entries)
    : u(body.layout.field()),
      v(body.layout.field()),
      f(body.layout.field()),
      history(static_cast<std::size_t>(HistoryLayout(body.layout, body.mesh, history_entries).size), 0.0) {}

}  // namespace railstrata
