#pragma once
// A wheel under its load, or at its approach, on all patches that it has.
#include "bem/several_patches.hpp"

namespace railstrata {

/// The patches that bear the case's load together with their friction, or have its approach. Throws as solve_bem.
SharedLoad loaded_wheel(const CaseSpec& spec, const Placement& placement, const BemOptions& options);

}  // namespace railstrata
