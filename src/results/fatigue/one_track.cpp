#include "fatigue/one_track.hpp"

#include <algorithm>

namespace railstrata {

double one_track(const Shakedown& found, const std::function<SingleTrackInput()>& input) {
  constexpr double kNearEnough = 1.02;
  const double safe = found.wandering.value, most = found.upper.value;
  if (most <= kNearEnough * safe) return safe;
  return std::clamp(single_track(input()).factor, safe, most);
}

}  // namespace railstrata
