#pragma once
// Stresses inside one body under the tractions of its contact.
//
// On a plane at any depth, by convolution: the closed form of a homogeneous half-space of the substrate's material, plus for layers the difference of the Fourier-domain
// solutions (layer_waves.hpp), which dies out away from the patch, so that the periodic images of its grid do not reach back.
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bem/patch_grid.hpp"
#include "bem/plane_algebra.hpp"
#include "core/vec.hpp"
#include "halfspace/interior.hpp"
#include "halfspace/layered.hpp"

namespace railstrata {

/// The state (halfspace/interior.hpp) in every cell of the grid at one depth. Axes: x rolling, y lateral, z into the body.
struct StatePlane {
  double depth = 0;
  Plane e_xx, e_yy, e_xy, s_xz, s_yz, s_zz;
  InteriorState at(std::size_t k) const { return {e_xx[k], e_yy[k], e_xy[k], s_xz[k], s_yz[k], s_zz[k]}; }
};

struct StressPeak {
  double value = 0;        ///< Pa
  double x = 0, y = 0;     ///< m, in the grid's frame
  double depth = 0;        ///< m
};
struct ZonePeaks {
  StressPeak von_mises, sigma1;
};

/// Maxima by zone. Depths are refined by golden section to 1 % of the cell, positions in plan by parabolas through neighbouring cells.
struct SubsurfacePeaks {
  ZonePeaks surface;                 ///< depth 0, the material at the surface
  ZonePeaks subsurface;              ///< below half a cell, whatever the material
  std::vector<ZonePeaks> layers;     ///< inside each layer, from the surface (excluded) to its bottom
  std::vector<ZonePeaks> above_interface, below_interface;  ///< the two sides of each interface
  ZonePeaks matrix;                  ///< the substrate; of a homogeneous body as `subsurface`
};

class Subsurface {
 public:
  /// p, q_x, q_y act on the body in its own axes: for the rail z is down and q as in ContactField; for the wheel z is up and q changes sign.
  Subsurface(const LayeredHalfSpace& body, const PatchGrid& grid, Plane p, Plane q_x, Plane q_y);
  ~Subsurface();

  StatePlane plane(double depth) const;
  /// Stresses in cell k of a plane; at an interface those of the layer above, or below if asked.
  Sym3 stress(const StatePlane& plane, std::size_t k, bool below_interface = false) const;
  const HalfSpaceMaterial& material_at(double depth, bool below_interface = false) const;
  /// Stresses at any point with depth >= 0 [m]; between cells by bicubic interpolation of the plane, outside the grid: std::out_of_range.
  Sym3 stress_at(double x, double y, double depth) const;

  /// deepest: how far down to look [m].
  SubsurfacePeaks peaks(double deepest) const;

 private:
  struct Layered;
  /// Takes the first-order error of stepwise tractions out of a plane nearer to the surface than a cell.
  void straighten_steps(double depth, StatePlane& out) const;
  void add_layer_difference(double depth, StatePlane& out) const;

  LayeredHalfSpace body_;
  PatchGrid grid_;
  Plane p_, q_x_, q_y_;
  std::unique_ptr<Layered> layered_;
};

}  // namespace railstrata
