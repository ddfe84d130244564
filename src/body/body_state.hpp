#pragma once
// The state of a body: named arrays, listed once. Checkpoints go through this list.
#include <array>

#include "body/body.hpp"

namespace railstrata {

struct BodyState {
  BodyState() = default;
  /// Zero everywhere, with the initial history.
  explicit BodyState(const Body& body);

  Field u;        ///< m, displacements
  Field v;        ///< m/s, velocities at the half step before
  Field f;        ///< N, internal forces and what is added to them in a step; nothing of it survives the step
  Field history;  ///< of the elements that may yield, as the last pass left it (body/plastic_elements.hpp); else empty
};

struct StateArray {
  const char* name;
  const char* unit;
  Field BodyState::*values;
  bool restart;  ///< needed to go on
};

inline constexpr std::array<StateArray, 4> kStateArrays{{{"u", "m", &BodyState::u, true},
                                                         {"v", "m/s", &BodyState::v, true},
                                                         {"f", "N", &BodyState::f, false},
                                                         {"history", "", &BodyState::history, true}}};

/// Whether an array may be that of a body's state.
bool fits(const Body& body, const StateArray& array, const Field& values);

/// The history of elements to which nothing has happened.
Field initial_history(const Body& body);

}  // namespace railstrata
