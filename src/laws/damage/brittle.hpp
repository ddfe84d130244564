#pragma once
// Largest principal stress of each layer over the cycle, and the flaw that would run under it: brittle layers (white
// etching layers, hard coatings) crack, they do not yield.
#include <vector>

#include "damage/residual_rows.hpp"
#include "damage/stress_history.hpp"

namespace railstrata {

struct BrittleZone {
  int zone = 0;
  double thickness = 0;  ///< m, between its first and its last row; of the matrix as far as the section reaches
  double stress = 0;     ///< Pa, the largest sigma_1 of all its rows, residual stress included; may be negative
  int row = 0;           ///< that has it
};
/// By zone, from the surface down.
std::vector<BrittleZone> principal_peaks(const StressHistory& history, ResidualRows residual);

/// m, depth c of the edge crack that runs under sigma_1: K_I = 1.12 sigma_1 sqrt(pi c) = K_Ic. [TadaParisIrwin2000]
/// Infinite without tension. A half-space under the same stress in all its depth: of a layer only while c is small
/// against its thickness. Throws std::invalid_argument unless toughness > 0 [Pa sqrt(m)].
double critical_flaw(double toughness, double sigma_1);

}  // namespace railstrata
