#pragma once
// One Newton step of the tangential problem with its sets of sticking and slipping cells. [Kalker1990 ch. 4]
#include <array>
#include <vector>

#include "bem/gmres.hpp"
#include "bem/tangential_state.hpp"

namespace railstrata {

/// With n = q/|q|, t across it and the slip
/// s(q, xi) = w(xi) + history - L q, the equations of the sets are
///   stick: s = 0 (two unknowns dq),   slip: |q| = g and s·t = 0 (one unknown: dq along t, then back to the circle),
/// linearised at the last q. Turning q by dq/g turns t as well, so that a slipping cell's row is
///   t·L dq + ((s·n)/g) dq·t = s·t:   the diagonal (s·n)/g >= 0 is what makes slip solvable by itself.
/// Where a force is given its creepage is a further unknown, and the equation sum of dq dA = missing force a further
/// row. Vectors of the Newton system hold the planes x and y one after the other, then one entry for each such
/// direction.
///
/// Where the bound varies with slip (VaryingBound), the size of the traction of a slipping cell is unknown as well:
///   n·dq + g' n·(L dq - dxi) = g(s·n) - |q|,   weighed like a row of slip, with L of a cell on itself.
class NewtonStep {
 public:
  explicit NewtonStep(TangentialState& state);

  const std::vector<int>& directions() const { return directions_; }  ///< 0 x, 1 y: those whose force is given
  /// Changes tractions, given forces' creepages and, with a bound that varies, what slipping cells carry. accuracy: of
  /// the linear system; close: a slip that may be left in every cell, 0: `accuracy` alone ends it. Cells that leave
  /// the circle are kLoosened.
  void take(double accuracy, double close = 0);
  /// Linearises for what follows: sets as they stand, slipping cells turn on their circle. In steady rolling, without
  /// VaryingBound.
  void linearise();
  /// Unit tractions of slipping cells, two planes.
  const Plane& normal() const { return normal_; }
  /// The weights z of changes of the slip (two planes) and of the given forces (missing_force) in a sum over the
  /// tractions' changes and then the given forces' creepages that take them back: A^T z = sum, until what is left is no
  /// longer than `left`. Each call is cheaper than those before.
  Plane adjoint(const Plane& sum, double left);
  /// Of these weights those of the slip of each cell; lateral: of lateral_slip alone, a plane.
  void weights_of_slip(const Plane& z, Plane& out, Plane& lateral) const;
  double length_of(const Plane& sum) const;  ///< that `left` counts

 private:
  using Components = std::array<double, 2>;
  template <class Slip>
  void change_bound(Slip&& slip);
  void add_row_along(std::size_t i, const Plane& in, Plane& out) const;
  double next_carried(std::size_t i) const;
  void prepare_slip_cells();
  void prepare_steer();
  bool nearly_sticks(std::size_t i) const;
  void project(std::size_t i, double& x, double& y) const;
  void solve(double accuracy, double close);
  void product(const Plane& in, Plane& out);
  void prepare_border();
  void precondition(const Plane& in, Plane& out);
  Components precondition_block(const double* in, double* out);
  void integrate_from_leading_edge(const double* r);
  void product_transposed(const Plane& in, Plane& out);
  void precondition_transposed(const Plane& in, Plane& out);
  void integrate_from_trailing_edge(const double* w, double* out) const;
  double first_step(std::size_t i) const;
  Plane right_side_of(const Plane& sum) const;
  void advance();

  TangentialState& s_;
  Plane normal_, diagonal_;  // of slipping cells: unit traction; (s.n)/g
  Plane steer_;  // of linearise(): change of lateral_slip beyond that of the slip itself, by the slip's x and y
  Plane step_, right_side_, integral_, slowed_;
  std::vector<int> directions_;
  double force_row_;  // a force residual weighs like a slip residual
  std::vector<Plane> border_;
  double border_force_[2][2] = {{1, 0}, {0, 1}};
  GmresSpace space_;
  Plane weights_, lateral_, displacement_;  // of adjoint()
  RecycledKrylov searched_;
};

}  // namespace railstrata
