#pragma once
// Lagrange's polynomial through up to four samples that stand next to each other.
#include <algorithm>
#include <array>

namespace railstrata {

/// Samples first .. first + count - 1 and their weights at a point.
struct LagrangeStencil {
  int first = 0, count = 0;
  std::array<double, 4> weight{};
};

/// Through the `most` samples (at most four) around t, among `count` ascending ones; beyond the outermost through the
/// last ones. Of three the nearest.
inline LagrangeStencil lagrange_stencil(const double* at, int count, double t, int most = 4) {
  LagrangeStencil s;
  s.count = std::min(most, count);
  const int above = static_cast<int>(std::upper_bound(at, at + count, t) - at);
  const bool nearer_below = above > 0 && above < count && t - at[above - 1] < at[above] - t;
  s.first = std::clamp(above - s.count / 2 - (s.count % 2 && nearer_below), 0, count - s.count);
  for (int i = 0; i < s.count; ++i) {
    s.weight[i] = 1;
    for (int j = 0; j < s.count; ++j)
      if (j != i) s.weight[i] *= (t - at[s.first + j]) / (at[s.first + i] - at[s.first + j]);
  }
  return s;
}

}  // namespace railstrata
