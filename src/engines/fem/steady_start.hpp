#pragma once
// The friction of steady rolling in the static equilibrium before a run.
//
// In the equilibrium the surfaces have displacements u, as functions of the place relative to the axle. Rolling
// steadily, they keep them while the particles pass: from one row of cells to the next one behind it a particle of the
// wheel is displaced against that of the rail by U(x) - U(x + dx), U = u_wheel - u_rail, and the rigid motion slides
// over it by G dx/V, so that over a row of cells
//   s = G/V + (U(x) - U(x + dx))/dx
// is the slip over V (wheel over rail, as in the half-space engine). Weights and places are those of the contact's rows
// (contact/mortar.hpp), so that wheel and rail slip as they do in a step; the sums of rigid and elastic motion hold for
// finite displacements.
//
// What tractions belong to that slip is asked of a half-space engine: it gets the slip that the present tractions
// leave on the mesh and answers with better ones and the change of the creepages. A few times, each followed by the
// equilibrium of the mesh, and the mesh rolls steadily: how the half-spaces differ from it decides how soon, not where
// it ends.
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "contact/mortar.hpp"
#include "fem/rolling_system.hpp"

namespace railstrata {

/// Values in cells have index j + ny i, i along rolling (the leading edge has the largest), j across.
struct SteadyQuestion {
  int nx = 0, ny = 0;
  double dx = 0, dy = 0;                        ///< m
  std::vector<double> gap;                      ///< m, infinite where the contact does not look
  std::vector<double> bound;                    ///< Pa, of the traction; 0 outside the patch
  std::array<std::vector<double>, 2> traction;  ///< Pa, on the rail: along rolling and across
  std::array<std::vector<double>, 2> slip;      ///< of the mesh under them, without a film's shear
  std::array<std::optional<double>, 2> force;   ///< N, wanted on the rail; none: the creepage stays as it is
};

struct SteadyAnswer {
  std::array<std::vector<double>, 2> traction;  ///< Pa, on the rail
  std::array<double, 2> creepage_change{};
};

/// The same bits on every rank. Throws CaseError where none is found. Empty: the rolling starts from rest.
using SteadyFriction = std::function<SteadyAnswer(const SteadyQuestion&)>;

/// How the wheel starts.
struct StartMotion {
  double spin = 0;           ///< rad/s
  double lateral_speed = 0;  ///< m/s
};

/// From the rows of an equilibrium to cells and back.
class SteadyCells {
 public:
  /// pressure: of the rows. They are kept by reference.
  SteadyCells(const RollingSystem& system, const MortarRows& rows, const std::vector<double>& pressure);

  /// traction: of the rail's surface nodes, by column and station; u in the axes of the preload.
  SteadyQuestion ask(const SurfaceTractions& traction, const std::array<Field, 2>& u, const StartMotion& motion) const;
  /// Into the tractions of the rows' nodes; returns the change over the tractions, both root of the sum of squares.
  double take(const SteadyAnswer& answer, SurfaceTractions& traction) const;

 private:
  struct Point {
    Vec3 apart, rigid;  ///< m, u_wheel - u_rail; m/s, rigid motion of the wheel over the rail
  };
  std::size_t cell(const ContactRow& row) const;
  Point point(const ContactRow& row, const std::array<Field, 2>& u, const StartMotion& motion) const;

  const RollingSystem& sys_;
  const MortarRows& rows_;
  const std::vector<double>& pressure_;
  int first_column_ = 0, nx_ = 0, ny_ = 0;
  int first_station_ = 0, along_ = 1;  ///< station of i = 0; step of the station from i to i + 1
  double dx_ = 0, dy_ = 0;
};

}  // namespace railstrata
