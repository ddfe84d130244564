#include "runs/steady_friction.hpp"

#include <fmt/format.h>

#include <memory>

#include "bem/case_patch.hpp"
#include "bem/leading_edge.hpp"
#include "bem/tangential_problem.hpp"
#include "core/faults.hpp"
#include "model/rolling_start.hpp"

namespace railstrata {
namespace {

/// Surface elements yield to the shortest waves more than a half-space does, by about dx/2 of its shear in each cell.
/// So much flexibility, in series with that of the half-spaces, makes the passes contract by a factor of three to five.
constexpr double kOfElements = 0.5;

/// Adds what tractions take from the slip: L q of tangential_problem.hpp.
void add_taken(const InfluenceOperator& influence, const PatchGrid& grid, const SteadyQuestion& asked,
               PlanePair& slip) {
  const PlanePair u = influence.tangential(asked.traction[0], asked.traction[1], grid.nx + 1);
  const auto ahead = static_cast<std::size_t>(grid.ny);
  for (std::size_t k = 0; k < grid.size(); ++k) {
    slip.x[k] += (u.x[k] - u.x[k + ahead]) / grid.dx;
    slip.y[k] += (u.y[k] - u.y[k + ahead]) / grid.dx;
  }
}

TangentialProblem problem_of(const SteadyQuestion& asked, const PatchGrid& grid) {
  TangentialProblem out;
  out.x.force = asked.force[0];
  out.y.force = asked.force[1];
  out.traction_bound = asked.bound;
  out.extra_slip = {asked.slip[0], asked.slip[1]};
  NormalSolution normal;
  normal.pressure = asked.bound;  // where they are, not how large
  normal.gap = asked.gap;
  out.leading_weight = leading_weights(grid, normal);
  return out;
}

}  // namespace

SteadyFriction steady_friction(const CaseSpec& spec) {
  if (!why_from_rest(spec).empty()) return {};
  const auto cache = std::make_shared<InfluenceCache>();
  const LayeredHalfSpace wheel = layered_body(spec, BodyId::wheel), rail = layered_body(spec, BodyId::rail);
  const double film = third_body(spec).flexibility(), lateral_share = lateral_friction_share(spec);
  const MaterialSpec& steel = spec.rail_material;
  const double of_elements = kOfElements * 2 * (1 + steel.poisson) / steel.young;  // per m of the cells
  return [=](const SteadyQuestion& asked) -> SteadyAnswer {
    const PatchGrid grid{asked.nx, asked.ny, asked.dx, asked.dy, 0, 0};
    const double own = of_elements * asked.dx;
    TangentialProblem problem = problem_of(asked, grid);
    problem.lateral_share = lateral_share;
    add_taken(*cache->get(wheel, rail, grid, own), grid, asked, problem.extra_slip);
    try {
      const TangentialSolution s = solve_tangential(*cache->get(wheel, rail, grid, own + film), grid, problem);
      return {{s.q_x, s.q_y}, {s.creepage_x, s.creepage_y}};
    } catch (const std::exception& e) {
      throw CaseError(fmt::format("no friction of steady rolling was found to start with: {}", e.what()),
                      "set run.start = \"rest\"", "run.start");
    }
  };
}

}  // namespace railstrata
