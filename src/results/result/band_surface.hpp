#pragma once
// The stress at the running surface of a finite element body, recovered from what is known there: the tractions
// (sigma n) and the surface's own strains (differences of the surface nodes' displacements), joined by Hooke's law.
#include "result/band_stress.hpp"
#include "result/rolling_mean.hpp"

namespace railstrata {

/// The surface of a body with the stress tensors recovered at its nodes (zero on the border of the sample), index
/// station * (columns + 1) + column, model frame; `mean` must outlive it.
BandSurface band_surface(const RollingSystem& system, BodyId body, const MeanContact& mean);

/// Stress at a free or loaded surface from the traction t = sigma n and the strains in the surface's own plane; n
/// outward, t1, t2 tangents, orthonormal: s_11 = E/(1-nu²) (e11 + nu e22) + nu/(1-nu) t.n, s_22 alike, s_12 = mu g12,
/// s_1n = t.t1, s_2n = t.t2, s_nn = t.n.
Sym3 surface_stress(const Elastic& material, Vec3 n, Vec3 t1, Vec3 t2, double e11, double e22, double g12,
                    Vec3 traction);

/// The axes of a column of a band: its surface rises with `angle` towards the field side; of a wheel also turned by the
/// azimuth of the station.
struct ColumnAxes {
  double angle = 0;   ///< rad
  double radius = 0;  ///< m, of BandSurface
  /// Stresses of the model frame in these axes, z into the body, of the station at x.
  Sym3 turned(const Sym3& stress, double x) const;
};

/// Of the surface between two nodes of a band.
ColumnAxes column_axes(const BandStress& band, const BandSurface& surface, int left, int right);

/// Stresses at the inner surface nodes of a column, stations 1, 2, ..., in the column's axes. Peaks between nodes, at
/// the edges of the patch and at the front of slip (result/surface_peaks.hpp), stand at the node next to them; not of a
/// layer thinner than an element is long, whose stress follows the strain of what lies below.
std::vector<Sym3> surface_column(const BandStress& band, const BandSurface& surface, int column);

}  // namespace railstrata
