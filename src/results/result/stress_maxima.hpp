#pragma once
// Stresses below and at the running surface.
//
// Element centres are the points where the stress of these elements is most accurate; maxima are taken there and
// refined by parabolas through the neighbours in depth and along the rail. At the surface the stress is recovered from
// what is known exactly there: the tractions (sigma n) and the surface's own strains (differences of the surface nodes'
// displacements), joined by Hooke's law. On either side of an interface the tensor is extrapolated linearly from the
// two nearest centres.
#include "result/band_stress.hpp"
#include "result/rolling_mean.hpp"
#include "result/summary.hpp"

namespace railstrata {

/// The surface of a body with the stress tensors recovered at its nodes (zero on the border of the sample), index
/// station * (columns + 1) + column, model frame; `mean` must outlive it.
BandSurface band_surface(const RollingSystem& system, BodyId body, const MeanContact& mean);

/// Stress at a free or loaded surface from the traction t = sigma n and the strains in the surface's own plane; n
/// outward, t1, t2 tangents, orthonormal: s_11 = E/(1-nu²) (e11 + nu e22) + nu/(1-nu) t.n, s_22 alike, s_12 = mu g12,
/// s_1n = t.t1, s_2n = t.t2, s_nn = t.n.
Sym3 surface_stress(const Elastic& material, Vec3 n, Vec3 t1, Vec3 t2, double e11, double e22, double g12,
                    Vec3 traction);

/// subsurface: deeper than subsurface_begin (patch.hpp) and than one element edge (mesh.element_size).
StressSummary band_stress_summary(const RollingSystem& system, BodyId body, const MeanContact& mean);

}  // namespace railstrata
