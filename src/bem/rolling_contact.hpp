#pragma once
// Normal and tangential contact together.
//
// Equal (elastically similar) bodies: pressure first, then friction. Dissimilar or layered ones: the two problems are solved in turn, each with the displacement
// caused by the other's traction, until the pressure repeats. [Kalker1990 sec. 4.2.2, the Panagiotopoulos process]
#include "bem/normal_problem.hpp"
#include "bem/tangential_problem.hpp"

namespace railstrata {

struct RollingContact {
  Plane gap;                  ///< m
  NormalTarget target;
  double friction = 0.3;
  Plane local_friction;       ///< in each cell, replaces `friction`; empty: uniform
  RollingKind kind = RollingKind::steady;  ///< steady or shift
  CreepOrForce x, y;
  double spin = 0;            ///< 1/m
  Plane extra_x, extra_y;     ///< further rigid slip, see TangentialProblem; empty: none
};

struct RollingOptions {
  NormalOptions normal;
  TangentialOptions tangential;
  double coupling_tolerance = 1e-5;  ///< largest change of the pressure over its maximum between two turns
  int max_turns = 50;
};

struct RollingSolution {
  NormalSolution normal;
  TangentialSolution tangential;
  int turns = 1;  ///< 1 for similar bodies
};

RollingSolution solve_rolling(const InfluenceOperator& influence, const PatchGrid& grid, const RollingContact& contact, const RollingOptions& options = {});

}  // namespace railstrata
