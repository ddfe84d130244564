#pragma once
// Claims that a plastic strain still allows. The laws are of small strain, split off additively: numbers are off by
// about half the strain, 2 to 3 % at 5 %; from 10 % on nothing is claimed.
#include <string>

namespace railstrata {

/// Equivalent plastic strains √(2/3 Ep:Ep).
inline constexpr double kLargeStrain = 0.05, kNoClaimStrain = 0.1;

/// Norm of six components, tensor shears.
double equivalent_strain(const double* plastic);

/// One sentence on the largest equivalent plastic strain that something has come to; empty up to kLargeStrain.
std::string strain_warning(double largest);

}  // namespace railstrata
