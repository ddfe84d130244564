#pragma once
// What slip of an interface does, wave by wave on a grid that repeats itself: to the interface's own tractions and to
// the surface. Slip: displacement of the lower side less that of the upper side, besides what springs give.
#include <array>
#include <complex>
#include <memory>
#include <vector>

#include "bem/patch_grid.hpp"
#include "bem/plane_algebra.hpp"
#include "fft/fft.hpp"
#include "halfspace/layered.hpp"

namespace railstrata {

class InterfaceWaves {
 public:
  /// layer: whose lower side the interface is. Its springs hold some shear. Even numbers of cells, or a line.
  InterfaceWaves(const LayeredHalfSpace& body, std::size_t layer, const PatchGrid& grid);

  const PatchGrid& grid() const { return grid_; }
  /// Pa per m of slip that varies as cells can at most, and over a length [m].
  double stiffest() const;
  double stiffness_over(double length) const;

  /// Pa, shear of the interface that its slip adds, and the pressure across it.
  PlanePair shear(const PlanePair& slip) const;
  Plane pressure(const PlanePair& slip) const;
  /// (hold - K)⁻¹ of a shear [Pa], K slip = shear(slip); hold: Pa/m.
  PlanePair slip_under(const PlanePair& shear, double hold) const;
  /// m, displacement of the surface in x, y and into the body. By reciprocity: the transpose of the shear that loads of
  /// the surface make at the interface.
  std::array<Plane, 3> surface(const PlanePair& slip) const;

 private:
  struct Wave {
    double along = 0, across = 0, normal = 0;             // Pa/m (crack/jump_waves.hpp)
    double by_pressure = 0, by_along = 0, by_across = 0;  // shear at the interface per traction of the surface
  };
  /// Of a wave vector; 0 the odd ones of the shortest wave along an axis, whose sign is unknown.
  struct Direction {
    double x = 0, y = 0, xx = 0, yy = 0, xy = 0;
  };
  using Complex = std::complex<double>;
  std::vector<Wave> at_nodes(const LayeredHalfSpace& body, std::size_t layer, const std::vector<double>& k) const;
  template <class Change>
  std::vector<Plane> changed(const PlanePair& given, std::size_t planes, Change&& change) const;

  PatchGrid grid_;
  double unit_x_, unit_y_;
  std::vector<Wave> wave_;  // of kx, ky >= 0, ky fastest
  std::vector<Direction> way_;
  std::shared_ptr<const RealPlaneFft> fft_;
};

}  // namespace railstrata
