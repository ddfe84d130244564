#pragma once
// Plane cuts through the stress of a body, for pictures: the longitudinal section through the patch's centre line, a
// cross section, and coarser ones all along the patch. The same from both engines.
#include <vector>

#include "bem/solve_bem.hpp"
#include "core/vec.hpp"
#include "result/band_stress.hpp"

namespace railstrata {

/// Stresses at the centres of the cells of a section, index along + along.size() * row. Rows go down from the surface
/// along its normal; the first begins at the surface and a material ends where a row does, so the rows' borders follow
/// from their centres.
struct StressSection {
  double at = 0;  ///< m, where the plane stands: y in the model frame (longitudinal) or x from the axle (cross)
  std::vector<double> along;               ///< m, x from the axle (longitudinal) or y in the model frame (cross)
  std::vector<double> depth;               ///< m, below the surface along its normal
  std::vector<Sym3> stress;                ///< Pa, model frame
  std::vector<int> material;               ///< 0: matrix, then the layers from the surface down
  std::vector<ElementPlasticity> plastic;  ///< as stress; empty where nothing may yield
};
struct StressSections {
  StressSection longitudinal, cross;
  std::vector<StressSection> slices;  ///< cross sections one behind the other along the patch, to look through: at most
                                      ///< 17 of them, of at most 34 columns
};

/// Stress against depth below the point (x, y) of largest subsurface von Mises stress, y from the rigid contact point:
/// a longitudinal section of one place.
StressSection depth_line(const BandStress& band, double x, double y);

/// Half the difference of the largest and the smallest of the principal stresses, largest first.
inline double largest_shear(const Vec3& principal) { return 0.5 * (principal.x - principal.z); }

/// Through the elements of a contact band nearest to x (from the axle) and y (model frame); values are the elements'
/// own, not smoothed.
StressSections band_sections(const BandStress& band, double x, double y);

/// Through the cells nearest to x and y of a half-space result. Rows are a cell high at the surface and grow by 6 %
/// each to `deepest`; a layer has at least 3.
StressSections rail_sections(const BemResult& result, double x, double y, double deepest);
StressSections wheel_sections(const BemResult& result, double x, double y, double deepest);

}  // namespace railstrata
