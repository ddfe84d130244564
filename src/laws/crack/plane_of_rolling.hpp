#pragma once
// Stresses of the plane of rolling at a place across, from a passage. Plane strain; x along the surface, z into the
// body.
#include <vector>

#include "damage/residual_rows.hpp"
#include "damage/stress_history.hpp"

namespace railstrata {

/// Pa, in the plane.
struct PlaneStress {
  double xx = 0, zz = 0, xz = 0;
};

/// Normal and shear traction on a line that leaves x's direction by an angle towards z: normal to it (by a quarter turn
/// the same way) and along it.
struct LineTraction {
  double normal = 0, shear = 0;
};
LineTraction traction_on(const PlaneStress& stress, double angle);

/// Stresses of the plane of rolling at a place across.
class PlaneOfRolling {
 public:
  /// y [m] between columns of the history; residual: by row, or none.
  PlaneOfRolling(const StressHistory& history, double y, ResidualRows residual);
  /// x [m] from the history's origin, linear between samples and rows; beyond the samples the contact's part falls with
  /// the square of the distance from their middle, below the rows it keeps that of the last one.
  PlaneStress at(double x, double depth) const;
  double behind() const { return x_.front(); }
  double ahead() const { return x_.back(); }

 private:
  PlaneStress in_row(std::size_t row, double x) const;
  std::vector<double> x_, depth_;
  std::vector<PlaneStress> stress_;    ///< row * samples + sample
  std::vector<PlaneStress> residual_;  ///< of rows
};

}  // namespace railstrata
