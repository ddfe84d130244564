#pragma once
// The state of a body: named arrays of its nodes, listed once, and the history of its elements. Checkpoints go through
// this list.
#include <array>

#include "body/body.hpp"

namespace railstrata {

/// The history of elements to which nothing has happened.
inline PlasticHistory initial_history(const Body& body) { return body.plastic.initial_history(); }

struct BodyState {
  BodyState() = default;
  /// Zero everywhere, with the initial history.
  explicit BodyState(const Body& body) : u(body.layout.field()), v(u), f(u), history(initial_history(body)) {}

  Field u;                 ///< m, displacements
  Field v;                 ///< m/s, velocities at the half step before
  Field f;                 ///< N, internal forces and what is added to them in a step; nothing of it survives the step
  PlasticHistory history;  ///< of the elements that may yield, as the last pass left it; else empty
};

/// An array that a restart needs.
struct StateArray {
  const char* name;
  Field BodyState::*values;
};

inline constexpr std::array<StateArray, 2> kStateArrays{{{"u", &BodyState::u}, {"v", &BodyState::v}}};

/// Whether the arrays that a restart needs and the history are those of a body.
inline bool fits(const Body& body, const BodyState& state) {
  for (const StateArray& a : kStateArrays)
    if ((state.*a.values).size() != static_cast<std::size_t>(body.layout.size)) return false;
  return body.plastic.fits(state.history);
}

}  // namespace railstrata
