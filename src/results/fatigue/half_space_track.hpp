#pragma once
// The slow part of shakedown for half-spaces: traffic on one line, and the map of limits.
#include "fatigue/shakedown_summary.hpp"

namespace railstrata {

/// Limit for wheels that all run in the same place (single_track/single_track.hpp) of every section of `sections`,
/// which half_space_shakedown has found. Where `upper` exceeds `wandering` by at most 2 % the limit lies between the
/// two and is taken to be `wandering`, the safe one; of a line contact both are the same. Else it costs some seconds.
void add_single_track(const CaseSpec& spec, const BemResult& result, std::vector<SectionShakedown>& sections);

}  // namespace railstrata
