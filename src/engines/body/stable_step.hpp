#pragma once
// The largest step central differences can take on a body.
#include "body/mass_scaling.hpp"

namespace railstrata {

/// 2/omega_max of K u = omega^2 (M + A) u on the free degrees of freedom, slaves following their masters, by Lanczos
/// steps [s]. Ritz values approach omega_max from below: the step is found from above, 60 iterations leave less than 1
/// %.
double lanczos_stable_step(const Body& body, const MassScaling& scaling = {});

}  // namespace railstrata
