#pragma once
// How a wheel starts that slides or is pushed sideways, or whose spin on its contact angle drags it there.
//
// Rail and wheel bend sideways under the lateral friction, 0.2 mm for a tenth of the weight. A run that began without
// would first have to creep that far, and its axle would ring on these springs (some 40 Hz) for longer than a run. So
// the static equilibrium before the rolling has the lateral friction already, spread like the pressure, and the axle
// starts with the lateral creepage that belongs to it. What the case does not give of the two is an estimate:
// Kalker's simplified theory on Hertz's ellipse, with the spin of the contact angle and a film's flexibility
// [Kalker1982]. It is what the rolling starts from; what it comes to is the contact's own answer.
#include "model/model.hpp"

namespace railstrata {

struct LateralStart {
  double creepage = 0;  ///< in the contact plane
  double friction = 0;  ///< N, lateral friction on the rail
};

/// Zero for a wheel that neither is yawed nor moves or is pushed sideways and whose contact plane is level, and in a
/// static case.
LateralStart lateral_start(const Model& model);

/// Longitudinal creepage at which the same theory has a longitudinal force of `traction` times the static load on the
/// wheel. The largest that runs take where friction falls short of it; 0 without friction.
double estimated_creepage(const Model& model, double traction);

}  // namespace railstrata
