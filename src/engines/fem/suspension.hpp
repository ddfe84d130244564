#pragma once
// Primary suspension: groups of a spring and a dashpot, each carrying its share of the sprung mass, vertical, on the
// axle's non-rotating box.
//
//   m z'' = k (z_axle - z) + c (z_axle' - z'),   shares of the whole: m / n, k / n, c / n
// z is counted from static equilibrium, where the springs carry the weight.
#include <vector>

#include "fem/axle_law.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata {

SuspensionLaw suspension_law(const VehicleSpec& vehicle);

/// One central-difference step of the groups; axle_z from static equilibrium [m], axle_vz its half-step velocity [m/s].
SuspensionForce step_suspension(const VehicleSpec& vehicle, double axle_z, double axle_vz, double dt,
                                std::vector<MassGroup>& groups);

}  // namespace railstrata
