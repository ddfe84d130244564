#pragma once
// The rail without a wheel: what its plastic strains leave in it.
#include "fem/rolling_system.hpp"

namespace railstrata {

/// Displacements [m] in equilibrium with the eigenstress of the history, nothing else loading the rail: its foot is
/// held, its ends are free. Nothing yields on the way: a wheel that goes leaves stresses that were there behind it
/// already. Newton's steps with the elastic stiffness, conjugate gradients with its diagonal. endless: of a history
/// that is the same at all stations: so are the displacements, and what holds the ends is the rest of the rail; forces
/// of all stations together vanish node by node of the section. Throws NumericalError where the residual force does not
/// fall to 1e-7 of that of the undeformed rail.
Field rail_at_rest(const RollingSystem& system, const PlasticHistory& history, bool endless = false);

}  // namespace railstrata
