#pragma once
// A wheel under its load, or at its approach, on all patches that it has.
#include "bem/several_patches.hpp"

namespace railstrata {

/// The patches that bear the case's load together with their friction, or have its approach. Several where two places
/// are on the way into one plane, all at one descent: the answer is the mean by their shares. Throws as solve_bem.
std::vector<SharedLoad> loaded_wheel(const CaseSpec& spec, const Placement& placement, const BemOptions& options);

/// What a similar case starts from.
BemNeighbour neighbour_of(std::vector<SharedLoad> solved);

}  // namespace railstrata
