#pragma once
// Anderson's acceleration of a fixed point y = g(y). [WalkerNi2011]
#include <vector>

#include "core/array.hpp"

namespace railstrata {

/// Keeps the last steps and proposes the next point: the combination of the last images whose residual g(y) - y is
/// smallest in the mean. The same bits for any number of threads.
class Anderson {
 public:
  explicit Anderson(int depth = 8) : depth_(depth) {}
  void clear();
  /// y: where g was taken; residual: g(y) - y, which is taken over. y becomes the next point.
  void step(Field& y, Field& residual);

 private:
  void keep(const Field& y, const Field& residual);
  std::vector<double> weights(const Field& residual) const;

  int depth_;
  std::vector<Field> dy_, df_;             // differences of points and of residuals, the newest last
  std::vector<std::vector<double>> gram_;  // of df_, lower half
  Field last_y_, last_f_;
};

}  // namespace railstrata
