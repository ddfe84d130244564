#pragma once
// Stresses below and at the running surface.
//
// Element centres are the points where the stress of these elements is most accurate; maxima are taken there and refined by parabolas through the neighbours in depth
// and along the rail. At the surface the stress is recovered from what is known exactly there: the tractions (sigma n) and the surface's own strains (differences of
// the surface nodes' displacements), joined by Hooke's law. On either side of an interface the tensor is extrapolated linearly from the two nearest centres.
#include "fem/rolling_run.hpp"
#include "post/rolling_mean.hpp"
#include "post/summary.hpp"

namespace railstrata {

/// A body's contact band around the wheel: geometry and mean stresses, ready for maxima, lines and pictures.
struct BandStress {
  const SweptBody* body = nullptr;
  BandSample sample;
  double contact_y = 0;                ///< y of the rigid contact point in section coordinates
  std::vector<double> centre_y;        ///< per column, section coordinate
  std::vector<double> centre_depth;    ///< per row
  Sym3 at(int column, int row, int station) const {
    return sample.stress[(static_cast<std::size_t>(station) * sample.rows + row) * sample.columns + column];
  }
  double x(int station) const { return 0.5 * (sample.along[station] + sample.along[station + 1]); }
};
BandStress band_stress(const SweptBody& body, BandSample sample, double contact_y);

/// Stress tensors at the rail's surface nodes (interior ones; zero on the border), index as in ContactField. Components in the model frame.
std::vector<Sym3> rail_surface_stress(const RollingSystem& system, const MeanContact& mean);

/// subsurface: deeper than one element edge (mesh.element_size). surface is given for the rail only.
StressSummary rail_stress_summary(const RollingSystem& system, const MeanContact& mean);
StressSummary wheel_stress_summary(const RollingSystem& system, const MeanContact& mean);

/// Stress against depth below the point (x, y) of largest subsurface von Mises stress.
struct DepthLine {
  double x = 0, y = 0;
  std::vector<double> depth;
  std::vector<Sym3> stress;
  std::vector<int> material;
};
DepthLine depth_line(const BandStress& band, double x, double y);

}  // namespace railstrata
