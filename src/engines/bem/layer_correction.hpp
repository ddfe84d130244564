#pragma once
// Difference that layers make inside a body to the half-space of its substrate's material: wave by wave
// (layer_waves.hpp), on a grid whose periodic images are far away.
#include <array>
#include <vector>

#include "bem/plane_fft.hpp"
#include "bem/subsurface.hpp"
#include "halfspace/layer_waves.hpp"

namespace railstrata {

inline std::array<Plane*, 6> planes_of(StatePlane& s) { return {&s.e_xx, &s.e_yy, &s.e_xy, &s.s_xz, &s.s_yz, &s.s_zz}; }
inline std::array<Plane*, 3> planes_of(DisplacementPlane& u) { return {&u.u_x, &u.u_y, &u.u_z}; }

/// Makes all planes of a field n zeros; pointers to their values.
template <class Planes>
std::vector<double*> cleared(Planes& s, std::size_t n) {
  std::vector<double*> out;
  for (Plane* p : planes_of(s)) {
    p->assign(n, 0.0);
    out.push_back(p->data());
  }
  return out;
}

/// The state under unit surface loads at one wave number and depth, in the axes of the wave: displacements times k,
/// tractions; see layer_waves.hpp for U, W, T, S, V, Q.
struct WaveResponse {
  double kU_p = 0, kW_p = 0, T_p = 0, S_p = 0;  // under pressure
  double kU_q = 0, kW_q = 0, T_q = 0, S_q = 0;  // under traction along the wave vector
  double kV = 0, Q = 0;                         // under traction across it
};
WaveResponse wave_response(const LayerWaves& waves, std::size_t layer, double depth);

class LayerCorrection {
 public:
  /// period: distance of the periodic images in extents of the grid; up to twice that for thick layers, whose strains
  /// reach farther.
  LayerCorrection(const LayeredHalfSpace& body, const PatchGrid& grid, double period);

  /// Points of the transform that such a correction takes.
  static double points_of(const LayeredHalfSpace& body, const PatchGrid& grid, double period);

  /// Add what the layers change at the planes' depth; on an interface that of the layer above, or below if asked.
  void add(const PlaneLoads& loads, bool below_interface, StatePlane& to) const;
  void add(const PlaneLoads& loads, bool below_interface, DisplacementPlane& to) const;

 private:
  using Nodes = std::vector<WaveResponse>;
  /// Averages of a response over wave numbers, weighed by (k_x/k)² and (k_y/k)².
  struct Means {
    WaveResponse x, y;
  };

  double points() const { return static_cast<double>(fft_.mx()) * fft_.my(); }
  Nodes nodes(double depth, bool below_interface) const;
  WaveResponse between(const Nodes& node, double k) const;
  double largest_wave_number(const Nodes& node) const;
  /// The FFT's sum over wave numbers instead of an integral is the pull of the periodic images, nearly uniform over the
  /// patch. It is the difference of sum and integral at low wave numbers (a Gaussian cuts off the rest); given with the
  /// opposite sign to the mean k = 0, which the sum leaves free, it takes the images away. Of the responses over
  /// k^power: 0 for strains and tractions, 1 for displacements.
  Means means_of(const Nodes& node, int power = 0) const;
  WaveResponse mean_along(const Nodes& node) const;
  template <class Planes, class Wave, class Zero>
  void add_waves(const PlaneLoads& loads, const Nodes& node, Planes& to, Wave&& wave, Zero&& zero) const;

  PatchGrid grid_;
  PlaneFft fft_;  // over a square: its period
  double unit_x_, unit_y_, log_low_, log_step_;
  std::vector<LayerWaves> stack_, plain_;  // at wave numbers spaced geometrically
};

}  // namespace railstrata
