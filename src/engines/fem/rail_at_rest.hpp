#pragma once
// The rail without a wheel: what its plastic strains leave in it.
#include "fem/rolling_system.hpp"

namespace railstrata {

/// Displacements [m] in equilibrium with the eigenstress of the history, nothing else loading the rail: its foot is
/// held, its ends are free. Nothing yields on the way: a wheel that goes leaves stresses that were there behind it
/// already. Newton's steps with the elastic stiffness, conjugate gradients with its diagonal. tolerance: residual
/// force over that of the undeformed rail. Throws NumericalError if it is not reached.
Field rail_at_rest(const RollingSystem& system, const PlasticHistory& history, double tolerance = 1e-7);

/// The same of an endless rail, for a history that is the same at all stations: so are the displacements, and what
/// holds the ends is the rest of the rail. Forces of all stations together vanish node by node of the section.
Field endless_rail_at_rest(const RollingSystem& system, const PlasticHistory& history, double tolerance = 1e-7);

}  // namespace railstrata
