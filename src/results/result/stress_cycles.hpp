#pragma once
// The stress cycles (damage/stress_history.hpp) of a body's section below the contact, from either engine.
//
// Axes of the contact plane, z into the body. Both engines give one frame to what shakedown, fatigue and the interfaces
// are computed from.
#include <optional>
#include <vector>

#include "bem/solve_bem.hpp"
#include "damage/stress_history.hpp"
#include "result/band_stress.hpp"

namespace railstrata {

/// A section's row: a depth in one material.
struct CycleRow {
  double depth = 0;  ///< m
  int zone = 0;      ///< 0: the matrix, then the layers from the surface down
};

/// Rows for a patch with the shorter semi-axis s [m]: 0, 0.02 s, then every 0.04 s to 1.6 s, growing by 15 % each to
/// 4 s; of a layer at least four. Both sides of every interface are rows.
std::vector<CycleRow> cycle_rows(const LayeredHalfSpace& body, double shorter);

/// y [m] in the axes of a patch's grid.
struct AcrossRange {
  double from = 0, to = 0;
};

/// For a patch of a half-space result: samples at cells from 3 semi-axes behind the patch's middle to 3 ahead of it,
/// and 1.5 to either side, at most about 90 and 50. y is that of the patch's grid.
/// across: of the columns that are wanted, to the cells around it, instead of those.
StressHistory half_space_cycles(const BemResult& result, BodyId body, const BemPatch& patch,
                                const std::vector<CycleRow>& rows, const std::optional<AcrossRange>& across = {});

/// For the contact band of a finite element body: the surface (recovered at the nodes, with the peaks between them,
/// result/surface_peaks.hpp), the elements' centres, and both sides of every interface. Samples are at the nodes and
/// half-way between them, in x and y: the surface is the mean of its nodes between them, what lies below is cubic
/// between the centres. Each column in the axes of its own place of the surface; y from the rigid contact point, in the
/// model frame.
StressHistory band_cycles(const BandStress& band, const BandSurface& surface);

}  // namespace railstrata
