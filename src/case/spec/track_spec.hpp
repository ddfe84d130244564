#pragma once
// The track below the rail of a case.
#include "track/sleeper_track.hpp"

namespace railstrata {

struct TrackSpec {
  TrackSet preset = TrackSet::held;
  SleeperTrack support;  ///< where the preset is not `held`
  bool held() const { return preset == TrackSet::held; }
};

}  // namespace railstrata
