#pragma once
// The largest stresses at and below the running surface of a finite element body.
//
// Element centres are the points where the stress of these elements is most accurate; at the border of a material it is
// recovered from the centres on either side (stress_at_depth), at the surface from tractions and strains
// (band_surface.hpp), with the peaks at the front of slip and at the edges of the patch. Maxima are refined by
// parabolas through the neighbours.
#include "result/rolling_mean.hpp"
#include "result/summary.hpp"

namespace railstrata {

/// Zones reach from border to border, as those of half-spaces do. The first layer begins at subsurface_begin
/// (patch.hpp); subsurface: deeper than that and than one element edge (mesh.element_size).
StressSummary band_stress_summary(const RollingSystem& system, BodyId body, const MeanContact& mean);

}  // namespace railstrata
