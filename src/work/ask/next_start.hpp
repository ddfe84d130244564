#pragma once
// Start of a contact's next solution: the last one, extrapolated along the line from the one before it.
#include <array>

#include "ask/state.hpp"
#include "bem/bem_options.hpp"

namespace railstrata {

/// Keeps the last two solutions of a sequence. A start changes how long a solution takes, and its numbers within the
/// tolerances of the solver (BemOptions::neighbour).
class NextStart {
 public:
  /// The start for a case; empty at first.
  BemNeighbour of(const CaseSpec& spec) const;
  /// The last solution; empty: none, or one that cannot be started from.
  const BemNeighbour& last() const { return last_.solved; }
  /// Takes the solution of a case; empty: of one that cannot be started from.
  void add(const CaseSpec& spec, BemNeighbour solved);

 private:
  using Coordinates = std::array<double, kState.size()>;  // of kState
  struct Known {
    Coordinates at;
    BemNeighbour solved;
  };
  static Coordinates coordinates(const CaseSpec& spec);
  Known last_{}, before_{};
};

}  // namespace railstrata
