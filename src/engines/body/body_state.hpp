#pragma once
// The state of a body: named arrays of its nodes, listed once, and the history of its elements. Checkpoints go through
// this list.
#include <array>

#include "body/body.hpp"

namespace railstrata {

struct BodyState {
  BodyState() = default;
  /// Zero everywhere, with the initial history.
  explicit BodyState(const Body& body);

  Field u;                 ///< m, displacements
  Field v;                 ///< m/s, velocities at the half step before
  Field f;                 ///< N, internal forces and what is added to them in a step; nothing of it survives the step
  PlasticHistory history;  ///< of the elements that may yield, as the last pass left it; else empty
};

struct StateArray {
  const char* name;
  const char* unit;
  Field BodyState::*values;
  bool restart;  ///< needed to go on
};

inline constexpr std::array<StateArray, 3> kStateArrays{
    {{"u", "m", &BodyState::u, true}, {"v", "m/s", &BodyState::v, true}, {"f", "N", &BodyState::f, false}}};

/// Whether the arrays that a restart needs and the history are those of a body.
bool fits(const Body& body, const BodyState& state);

/// The history of elements to which nothing has happened.
PlasticHistory initial_history(const Body& body);

}  // namespace railstrata
