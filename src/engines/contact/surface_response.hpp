#pragma once
// How the surface nodes of a swept body answer one another's impulses within a step, where they are not simply masses
// (body/local_steps.hpp).
#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include "core/vec.hpp"

namespace railstrata {

/// Velocity [m/s] of node (to, station + apart) per unit impulse [N s] on node (from, station): 3 x 3 numbers in 1/kg
/// by row, rows the components of the velocity, columns those of the impulse, both in the frame of the station that
/// gets the impulse. The same at all stations; nothing beyond `reach` of them, which is half the ring's at most.
class SurfaceResponse {
 public:
  /// Every node answers for itself, by its mass.
  SurfaceResponse() = default;
  SurfaceResponse(int columns, int reach)
      : columns_(columns), reach_(reach), blocks_(static_cast<std::size_t>(columns) * columns * (2 * reach + 1) * 9) {}

  bool empty() const { return blocks_.empty(); }
  int reach() const { return reach_; }
  double& entry(int from, int to, int apart, int velocity, int impulse) {
    return blocks_[index_of(from, to, apart) + 3 * velocity + impulse];
  }
  Vec3 velocity(int from, int to, int apart, Vec3 impulse) const {
    if (std::abs(apart) > reach_) return {};
    const double* b = blocks_.data() + index_of(from, to, apart);
    return {b[0] * impulse.x + b[1] * impulse.y + b[2] * impulse.z,
            b[3] * impulse.x + b[4] * impulse.y + b[5] * impulse.z,
            b[6] * impulse.x + b[7] * impulse.y + b[8] * impulse.z};
  }
  /// The largest of the three answers of a node to its own impulse [1/kg].
  double own(int column) const {
    const double* b = blocks_.data() + index_of(column, column, 0);
    return std::max({b[0], b[4], b[8]});
  }

 private:
  std::size_t index_of(int from, int to, int apart) const {
    assert(from >= 0 && from < columns_);
    assert(to >= 0 && to < columns_);
    assert(std::abs(apart) <= reach_);
    return ((static_cast<std::size_t>(from) * columns_ + to) * (2 * reach_ + 1) + (apart + reach_)) * 9;
  }
  int columns_ = 0, reach_ = 0;
  std::vector<double> blocks_;
};

}  // namespace railstrata
