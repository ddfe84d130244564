#pragma once
// Limit for wheels that all run in the same place (single_track/single_track.hpp) of a section that has its other
// factors.
#include <functional>

#include "damage/shakedown.hpp"
#include "single_track/single_track.hpp"

namespace railstrata {

/// Where `upper` exceeds `wandering` by at most 2 % the limit lies between the two and is taken to be `wandering`, the
/// safe one. Else `input` is asked for and solved, some seconds; what comes out lies between the two.
double one_track(const Shakedown& found, const std::function<SingleTrackInput()>& input);

}  // namespace railstrata
