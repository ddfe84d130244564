#pragma once
// Normal and tangential contact together.
//
// Equal (elastically similar) bodies: pressure first, then friction. Dissimilar or layered ones: outer iterations (the
// Panagiotopoulos process [Kalker1990 sec. 4.2.2]) solve the two problems alternately, each with the displacement
// caused by the other's traction, until the pressure repeats. Both are solved only as accurately as the other is known:
// the tangential problem takes one Newton step per outer iteration, the normal one a tolerance that follows the last
// change of the pressure. So the coupled problem costs little more Newton steps than the tangential problem alone.
#include <optional>

#include "bem/contact_heat.hpp"
#include "bem/normal_problem.hpp"
#include "bem/tangential_problem.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {

/// `before` of the conditions is the displacement by pressure and traction.
struct RollingContact : RollingConditions {
  Plane gap;   ///< m
  Plane turn;  ///< of solve_normal; traction across is along each row's own tangent then
  NormalTarget target;
  double friction = 0.3;
  Plane local_friction;             ///< in each cell, replaces `friction`; empty: uniform
  std::optional<ContactHeat> heat;  ///< friction and film by temperature
  Plane temperature;                ///< K, of each cell, for `heat`; empty: before sliding
  std::vector<Plane> flux_before;   ///< W/m², transient with `heat`: friction's of the particles, a step ago, two, …
  LeadingEdge leading_edge = LeadingEdge::sub_cell;
};

struct RollingOptions {
  NormalOptions normal;
  TangentialOptions tangential;
  double coupling_tolerance = 1e-5;  ///< largest change of the pressure over its maximum between two outer iterations
  int max_outer = 100;
};

struct RollingSolution {
  NormalSolution normal;
  TangentialSolution tangential;
  Plane temperature;         ///< K, of each cell; empty: without ContactHeat
  std::vector<Plane> flux;   ///< W/m², friction's of the particles, now, a step ago, …; empty: without ContactHeat
  int outer_iterations = 1;  ///< 1 for similar bodies; the iterations of both parts are sums over the outer ones
};

/// start: solution of a similar problem on the same grid (the state before, a neighbour in a sweep), or of its normal
/// contact alone, or null.
/// Friction and film by temperature: in turn with the heat of friction until they repeat. Throws as solve_normal and
/// solve_tangential, NumericalError if the two do not settle against each other, CaseError if the temperature does not.
RollingSolution solve_rolling(const InfluenceOperator& influence, const PatchGrid& grid, const RollingContact& contact,
                              const RollingOptions& options = {}, const RollingSolution* start = nullptr);

/// The tangential problem under a pressure.
TangentialProblem tangential_part(const InfluenceOperator& influence, const PatchGrid& grid,
                                  const RollingContact& contact, const NormalSolution& normal);
/// f p in each cell, Pa.
Plane traction_bound(const RollingContact& contact, const Plane& pressure);

/// Makes `contact` the transient step in which the wheel rolls on by one cell (dx) from the state `before`. Gap and
/// load may change from step to step too.
void roll_on_one_cell(const InfluenceOperator& influence, const PatchGrid& grid, const RollingSolution& before,
                      RollingContact& contact);
/// Makes `contact` the next increment of load or shift from the state `before`: creepages are further distances, forces
/// and load the new totals.
void shift_on(const InfluenceOperator& influence, const PatchGrid& grid, const RollingSolution& before,
              RollingContact& contact);

}  // namespace railstrata
