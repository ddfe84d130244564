#pragma once
// Stresses below and at the running surface.
//
// Element centres are the points where the stress of these elements is most accurate; maxima are taken there and
// refined by parabolas through the neighbours in depth and along the rail. At the surface the stress is recovered from
// what is known exactly there: the tractions (sigma n) and the surface's own strains (differences of the surface nodes'
// displacements), joined by Hooke's law. On either side of an interface the tensor is extrapolated linearly from the
// two nearest centres.
#include "fem/rolling_run.hpp"
#include "post/rolling_mean.hpp"
#include "post/summary.hpp"

namespace railstrata {

/// A body's contact band around the wheel: geometry and mean stresses, ready for maxima, lines and pictures.
struct BandStress {
  const SweptBody* body = nullptr;
  BandSample sample;
  double contact_y = 0;              ///< y of the rigid contact point in section coordinates
  std::vector<double> centre_y;      ///< per column, section coordinate
  std::vector<double> centre_depth;  ///< per row
  std::size_t index(int column, int row, int station) const {
    return (static_cast<std::size_t>(station) * sample.rows + row) * sample.columns + column;
  }
  Sym3 at(int column, int row, int station) const { return sample.stress[index(column, row, station)]; }
  double x(int station) const { return 0.5 * (sample.along[station] + sample.along[station + 1]); }
};
BandStress band_stress(const SweptBody& body, BandSample sample, double contact_y);

/// Of an element of the band: 0 the matrix, then the layers from the surface down.
int layer_of(const BandStress& band, int column, int row);

/// Stress at the upper face of row `row`, which is an interface: extrapolated linearly from the two nearest centres
/// above it or below.
Sym3 stress_at_interface(const BandStress& band, int column, int row, int station, bool below);

/// Recovered stress tensors at the surface nodes of a body (zero on the border of the sample), index station * (columns
/// + 1) + column, model frame.
std::vector<Sym3> rail_surface_stress(const RollingSystem& system, const MeanContact& mean);
std::vector<Sym3> wheel_surface_stress(const RollingSystem& system, const MeanContact& mean);

/// Stress at a free or loaded surface from the traction t = sigma n and the strains in the surface's own plane; n
/// outward, t1, t2 tangents, orthonormal: s_11 = E/(1-nu²) (e11 + nu e22) + nu/(1-nu) t.n, s_22 alike, s_12 = mu g12,
/// s_1n = t.t1, s_2n = t.t2, s_nn = t.n.
Sym3 surface_stress(const Elastic& material, Vec3 n, Vec3 t1, Vec3 t2, double e11, double e22, double g12,
                    Vec3 traction);

/// subsurface: deeper than subsurface_begin (plausibility.hpp) and than one element edge (mesh.element_size).
StressSummary rail_stress_summary(const RollingSystem& system, const MeanContact& mean);
StressSummary wheel_stress_summary(const RollingSystem& system, const MeanContact& mean);

/// Stress against depth below the point (x, y) of largest subsurface von Mises stress.
struct DepthLine {
  double x = 0, y = 0;
  std::vector<double> depth;
  std::vector<Sym3> stress;
  std::vector<int> material;
  std::vector<ElementPlasticity> plastic;  ///< empty where nothing may yield
};
DepthLine depth_line(const BandStress& band, double x, double y);

}  // namespace railstrata
