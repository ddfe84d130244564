#pragma once
// Viscoelastic bodies in steady rolling to +x (M = 1): a standard linear solid of constant Poisson's ratio, both bodies
// alike in its two numbers. The creep compliance of the shear is 1/G (1 + F (1 - exp(-t/tau))). A particle that is at x
// was at x + V t, so that the displacement is that of two elastic parts, one of them late:
//   u = A p + F R A p,    (R u)(x) = ∫ exp(-s) u(x + V tau s) ds, s from 0 to infinity    [Kalker1990 appendix D]
#include <array>
#include <cstdlib>
#include <vector>

#include "cntc/problem.hpp"

namespace railstrata::cntc {

/// The body with F and no delay, G/(1 + F).
HalfSpaceMaterial soft(const HalfSpaceMaterial& material, const Viscosity& viscosity);

/// What delay takes off: F (R - 1) A p, of which A p (1 + F), the soft bodies' displacement, is the larger part.
class Delay {
 public:
  Delay(const Materials& materials, const PatchGrid& grid, double speed);

  /// m, into the bodies together, by pressure.
  Plane normal(const Plane& pressure) const;
  /// m, rail minus wheel, by tractions on the rail; rows of x: nx + 1, one more ahead of the grid.
  PlanePair tangential(const Plane& q_x, const Plane& q_y) const;

 private:
  struct Kernel {
    double nn = 0, xx = 0, xy = 0, yy = 0;
  };
  static Kernel weighted(Kernel sum, double weight, const RectangleInfluence& value);
  Kernel late(double x, double y, double from, double to) const;
  void fill_row(int j);
  const Kernel& at(int i, int j) const {
    return kernel_[static_cast<std::size_t>(i + grid_.nx) * static_cast<std::size_t>(grid_.ny) +
                   static_cast<std::size_t>(j)];
  }

  PatchGrid grid_;
  SurfaceCompliance pair_;
  double share_, way_;  // F; V tau, m
  std::vector<Kernel> kernel_;
};

/// Solves the contact of the soft bodies with what delay takes off as a further gap and a further slip, in turn until
/// the pressure and the tractions repeat to `tolerance`: the error shrinks by F/(1 + F) or more in a turn. The late
/// displacement is left in `late`: normal, then along x and y. Throws NumericalError without an end.
RollingSolution solve_delayed(const InfluenceOperator& of_soft_bodies, const Materials& materials,
                              const PatchGrid& grid, RollingContact contact, const RollingOptions& options,
                              const RollingSolution* start, std::array<Plane, 3>& late);

}  // namespace railstrata::cntc
