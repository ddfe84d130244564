#pragma once
// The shakedown map of a case: its patch, pressure and layers under full sliding in the rolling direction, q = mu p.
//
// Stresses are linear in the tractions, so the cycle for any mu is that of the pressure plus mu times that of q = p:
// two histories give the whole map.
#include <vector>

#include "fatigue/shakedown_summary.hpp"

namespace railstrata {

struct SlidingLimit {
  double traction = 0;       ///< mu = q/p
  ShakedownFactors factors;  ///< on the case's own pressure; without single_track
};
struct SlidingMap {
  BodyId body = BodyId::rail;
  double p_max = 0;  ///< Pa, of the patch; times a factor it is the pressure at a limit
  std::vector<SlidingLimit> limits;
};

/// mu = 0, 0.05, … 0.6 for every section that has a strength, on its own patch. As long as two half_space_shakedown.
std::vector<SlidingMap> sliding_maps(const BemResult& result, const std::vector<SectionShakedown>& sections);

}  // namespace railstrata
