#include "mesh/station_weights.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace railstrata {

StationWeights station_weights(const Stations& from, double t) {
  const double period = 2 * std::numbers::pi;
  const int n = from.nodes();
  if (from.closed) {  // into [first, first + period)
    t = from.at.front() + std::fmod(t - from.at.front(), period);
    if (t < from.at.front()) t += period;
  }
  int left = static_cast<int>(std::upper_bound(from.at.begin(), from.at.end(), t) - from.at.begin()) - 1;
  if (!from.closed) left = std::clamp(left, 0, n - 2);
  const int right = left + 1 < n ? left + 1 : 0;
  const double t1 = right > left ? from.at[right] : from.at[0] + period;
  return {left, right, std::clamp((t - from.at[left]) / (t1 - from.at[left]), 0.0, 1.0)};
}

}  // namespace railstrata
