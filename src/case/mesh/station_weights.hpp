#pragma once
// Linear interpolation along a sweep: what a hanging node takes of the two stations around it.
#include "mesh/swept.hpp"

namespace railstrata {

/// The value at sweep coordinate t is (1 - weight) of station `left` plus weight of station `right`.
struct StationWeights {
  int left = 0, right = 0;
  double weight = 0;  ///< 0 … 1
};

/// t beyond the ends of open stations takes the end's value; in closed ones it is taken modulo a turn.
StationWeights station_weights(const Stations& stations, double t);

}  // namespace railstrata
