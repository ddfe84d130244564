#pragma once
// Displacements and stresses inside one body under the tractions of its contact.
//
// On a plane at any depth, by convolution: the closed form of a homogeneous half-space of the substrate's material,
// plus for layers the difference of the Fourier-domain solutions (layer_waves.hpp), which dies out away from the patch,
// so that the periodic images of its grid do not reach back. Of a line contact (PatchGrid::line) in plane strain, the
// same along every y.
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <tuple>
#include <vector>

#include "bem/patch_grid.hpp"
#include "bem/plane_algebra.hpp"
#include "halfspace/interior.hpp"
#include "halfspace/layered.hpp"

namespace railstrata {

/// Pa, in every cell, in the body's own axes.
struct PlaneLoads {
  Plane p, q_x, q_y;
};

/// The state (halfspace/interior.hpp) in every cell of the grid at one depth. Axes: x rolling, y lateral, z into the
/// body. On an interface that gives, that of its upper side.
struct StatePlane {
  double depth = 0;
  Plane e_xx, e_yy, e_xy, s_xz, s_yz, s_zz;
  std::shared_ptr<const StatePlane> lower = {};  ///< of an interface that gives, else null
  const StatePlane& side(bool below_interface) const { return below_interface && lower ? *lower : *this; }
  InteriorState at(std::size_t k) const { return {e_xx[k], e_yy[k], e_xy[k], s_xz[k], s_yz[k], s_zz[k]}; }
};

/// Displacement [m] in every cell of the grid at one depth, u_z into the body. The half-space is at rest far away;
/// below a line contact it is nowhere, and the displacement NaN.
struct DisplacementPlane {
  double depth = 0;
  Plane u_x, u_y, u_z;
};

struct InteriorPoint {
  Vec3 displacement;  ///< m
  Sym3 stress;        ///< Pa; von_mises and principal_stresses stand in material/elastic.hpp
};

struct StressPeak {
  double value = 0;     ///< Pa
  double x = 0, y = 0;  ///< m, in the grid's frame
  double depth = 0;     ///< m
  double at_rim = 0;  ///< Pa, largest value at the rim of what was searched; near `value`: a larger one may lie beyond
};
struct ZonePeaks {
  StressPeak von_mises, sigma1;
};

/// How far to look for maxima, m.
struct SearchDepths {
  double from = 0;     ///< what lies nearer to the surface is the surface's
  double deepest = 0;  ///< to begin with
};

/// Maxima by zone. Depths are refined by parabolas until they move by less than 1 % of the cell, positions in plan by
/// one parabola through the neighbouring cells.
struct SubsurfacePeaks {
  ZonePeaks surface;              ///< depth 0, the material at the surface
  ZonePeaks subsurface;           ///< below SearchDepths::from, whatever the material
  std::vector<ZonePeaks> layers;  ///< inside each layer (a graded one with all its cuts), the first one from
                                  ///< SearchDepths::from (at most half its depth), to its bottom
  std::vector<ZonePeaks> above_interface,
      below_interface;  ///< the two sides of each interface; the cuts of a graded layer are none
  ZonePeaks matrix;     ///< the substrate; of a homogeneous body as `subsurface`
};

class LayerCorrection;
class SectionBelow;

/// Spectra of the influence below homogeneous half-spaces, for bodies that ask for the same depths on the same cells
/// again. Threads may share one.
class InteriorKernels {
 public:
  /// Young's modulus, Poisson's ratio, depth, cells and lengths of the transform; the last: of a line.
  using Key = std::tuple<double, double, double, double, double, int, int, bool>;
  using Spectra = std::vector<Plane>;
  /// What is kept, or what `make` gives, which is kept from now on.
  std::shared_ptr<const Spectra> get(const Key& key, const std::function<Spectra()>& make);

 private:
  std::mutex mutex_;
  std::map<Key, std::shared_ptr<const Spectra>> kept_;
  std::size_t numbers_ = 0;
};

class Subsurface {
 public:
  /// p, q_x, q_y act on the body in its own axes: for the rail z is down and q as in ContactField; for the wheel z is
  /// up and q changes sign. period: distance of the periodic images of what layers change, in extents of the grid.
  /// Their mean pull is taken out; its variation over the patch leaves some 1e-5 of the largest pressure, which falls
  /// with the fourth power of the period. The cost grows with its square.
  Subsurface(const LayeredHalfSpace& body, const PatchGrid& grid, Plane p, Plane q_x, Plane q_y, double period = 4);
  ~Subsurface();
  Subsurface(Subsurface&&) noexcept;

  /// Takes the influence of its planes, and of bodies made from it, from these; they must outlive it.
  void share(InteriorKernels* kernels) { kernels_ = kernels; }

  /// Adds what the body's section changes to the states, here and in bodies made from it. Where layers end or vary
  /// across, materials and zones are then those of the section.
  void stand_on(std::unique_ptr<const SectionBelow> section);

  const PatchGrid& grid() const { return grid_; }
  StatePlane plane(double depth) const;
  DisplacementPlane displacement(double depth, bool below_interface = false) const;
  /// Stresses in cell k of a plane; at an interface those of the layer above, or below if asked.
  Sym3 stress(const StatePlane& plane, std::size_t k, bool below_interface = false) const;
  /// The material at a depth, of a graded layer its own there.
  HalfSpaceMaterial material_at(double depth, bool below_interface = false) const;
  HalfSpaceMaterial material_at(double y, double depth, bool below_interface) const;
  /// The layer (0: the substrate) in each row of cells, where they differ; empty: all as material_at has it.
  std::vector<int> layers_of_rows(double depth, bool below_interface) const;
  /// m, how deep a layer reaches below any row; 0 where they do not differ.
  double bottom_of(int layer) const;
  /// Displacements and stresses at any points (x, y, depth >= 0) [m], in the order given: bicubic between cells, on a
  /// wider grid where points lie outside. A plane is computed per depth: give points of a depth together. On an
  /// interface the stresses of the layer above, or below if asked. Throws std::out_of_range for a point above the
  /// surface or more than ten lengths of the grid beyond it; less with layers and many cells.
  std::vector<InteriorPoint> at(const std::vector<Vec3>& points, bool below_interface = false) const;

  /// Whether a point (x, y) lies so that four cells each way are around it.
  bool covers(const Vec3& at) const;
  /// Stresses at a point (x, y) of a plane, bicubic between cells; as `stress` at an interface.
  Sym3 stress_at(const StatePlane& plane, const Vec3& at, bool below_interface = false) const;

  /// The same tractions on a grid with so many more cells on each side, empty ones.
  std::unique_ptr<Subsurface> widened(int more_x, int more_y) const;
  /// The same on cells so many times smaller, between which tractions run on instead of in steps: the square of the
  /// pressure, which falls straight to the patch's edge, as a quadratic between cells (linear at the edge), the ratio
  /// of friction to pressure linearly. The normal force stays. Of the grid only the patch and a rim around it.
  std::unique_ptr<Subsurface> refined(int times) const;
  /// The same on as many cells three times as large: each takes the mean of nine.
  std::unique_ptr<Subsurface> coarsened() const;

  /// Where the rim of the grid has a good share of the maximum the search goes on outside of it, on a grid three times
  /// as wide with cells three times as large; where the maximum lies at `deepest`, down to eight times that depth.
  SubsurfacePeaks peaks(SearchDepths depths) const;

 private:
  StatePlane plane(double depth, bool below_interface) const;
  bool gives_at(double depth) const;
  void follow(const Subsurface& whole);
  PatchGrid loaded(int rim) const;
  /// Takes the first-order error of stepwise tractions out of a plane nearer to the surface than a cell.
  void straighten_steps(double depth, StatePlane& out) const;

  LayeredHalfSpace body_;
  PatchGrid grid_;
  PlaneLoads loads_;
  double period_;
  int reach_x_, reach_y_;  ///< cells from a traction to the farthest cell
  std::unique_ptr<LayerCorrection> layered_;
  InteriorKernels* kernels_ = nullptr;
  std::unique_ptr<const SectionBelow> section_;  // null: a half-space
  std::vector<LayerExtent> extents_;             // of a section in full
};

}  // namespace railstrata
