#pragma once
// Influence operators of earlier solutions: cases of a sweep share bodies and grid.
#include <memory>

#include "bem/influence_operator.hpp"
#include "bem/patch_grid.hpp"
#include "halfspace/layered.hpp"

namespace railstrata {

/// Safe to share between threads.
class InfluenceCache {
 public:
  InfluenceCache();
  ~InfluenceCache();
  /// film: flexibility of a third-body layer, m/Pa.
  std::shared_ptr<const InfluenceOperator> get(const LayeredHalfSpace& wheel, const LayeredHalfSpace& rail,
                                               const PatchGrid& grid, double film = 0);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace railstrata
