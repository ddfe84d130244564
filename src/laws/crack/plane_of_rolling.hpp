#pragma once
// Stresses on the plane of a crack while a wheel rolls over the rail, from a passage. Plane strain: the crack's plane
// is normal to the vertical plane through h, a horizontal direction at an angle (the azimuth) from the direction of
// rolling x towards y; z into the body.
#include <vector>

#include "damage/residual_rows.hpp"
#include "damage/stress_history.hpp"

namespace railstrata {

/// Pa, in a plane; of x and z, or of h and z.
struct PlaneStress {
  double xx = 0, zz = 0, xz = 0;
};

/// Normal and shear traction on a line that leaves x's direction by an angle towards z: normal to it (by a quarter turn
/// the same way) and along it.
struct LineTraction {
  double normal = 0, shear = 0;
};
LineTraction traction_on(const PlaneStress& stress, double angle);

class PlaneOfRolling {
 public:
  /// y [m]: of the crack's start; residual: by row of the history, or none.
  PlaneOfRolling(StressHistory history, double y, double azimuth, std::vector<Sym3> residual);
  /// At h [m] from the crack's start and a depth, the contact's origin at `wheel` along the rail from there. Linear
  /// between samples, columns and rows; beyond the samples the contact's part falls with the square of the distance
  /// from their middle, beyond columns and rows it keeps that of the last one.
  PlaneStress at(double h, double depth, double wheel) const;
  double behind() const { return history_.x.front(); }
  double ahead() const { return history_.x.back(); }
  /// x of a place h along the plane.
  double along(double h) const;
  void turn(double azimuth) { azimuth_ = azimuth; }

 private:
  Sym3 in_row(int row, double x, double y) const;
  StressHistory history_;
  double y_ = 0, azimuth_ = 0;
  std::vector<Sym3> residual_;
};

}  // namespace railstrata
