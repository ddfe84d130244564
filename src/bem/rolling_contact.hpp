#pragma once
// Normal and tangential contact together.
//
// Equal (elastically similar) bodies: pressure first, then friction. Dissimilar or layered ones: the two problems are
// solved in turn, each with the displacement caused by the other's traction, until the pressure repeats. [Kalker1990
// sec. 4.2.2, the Panagiotopoulos process] Neither is solved further in a turn than the other is known: the tangential
// problem takes one Newton step, which costs little more than that step would cost alone.
#include "bem/normal_problem.hpp"
#include "bem/tangential_problem.hpp"

namespace railstrata {

struct RollingContact {
  Plane gap;  ///< m
  NormalTarget target;
  double friction = 0.3;
  Plane local_friction;  ///< in each cell, replaces `friction`; empty: uniform
  RollingKind kind = RollingKind::steady;
  CreepOrForce x, y;
  double spin = 0;           ///< 1/m
  Plane extra_x, extra_y;    ///< further rigid slip, see TangentialProblem; empty: none
  double step = 0;           ///< rolled distance [m]: transient only
  Plane before_x, before_y;  ///< history: displacement by pressure and traction of the state before, see
                             ///< TangentialProblem; empty: none
};

struct RollingOptions {
  NormalOptions normal;
  TangentialOptions tangential;
  double coupling_tolerance = 1e-5;  ///< largest change of the pressure over its maximum between two turns
  int max_turns = 100;
};

struct RollingSolution {
  NormalSolution normal;
  TangentialSolution tangential;
  int turns = 1;  ///< 1 for similar bodies; iterations of both parts are summed over the turns
};

/// start: solution of a similar problem on the same grid (the state before, a neighbour in a sweep), or null.
/// Throws as solve_normal and solve_tangential, and NumericalError if the two do not settle against each other.
RollingSolution solve_rolling(const InfluenceOperator& influence, const PatchGrid& grid, const RollingContact& contact,
                              const RollingOptions& options = {}, const RollingSolution* start = nullptr);

/// Makes `contact` the transient step in which the wheel rolls on by one cell (dx) from the state `before`. Gap and
/// load may change from step to step too.
void roll_on_one_cell(const InfluenceOperator& influence, const PatchGrid& grid, const RollingSolution& before,
                      RollingContact& contact);
/// Makes `contact` the next increment of load or shift from the state `before`: creepages are further distances, forces
/// and load the new totals.
void shift_on(const InfluenceOperator& influence, const PatchGrid& grid, const RollingSolution& before,
              RollingContact& contact);

}  // namespace railstrata
