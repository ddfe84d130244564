#include "bem/rolling_contact.hpp"

#include <algorithm>
#include <cmath>

#include "core/faults.hpp"

namespace railstrata {

namespace {

/// Rigid slip equivalent to the displacement that the pressure causes: what the tangential problem sees of it.
void add_slip_of_pressure(const InfluenceOperator& influence, const PatchGrid& grid, RollingKind kind, const Plane& p, Plane& slip_x, Plane& slip_y) {
  const std::size_t n = grid.size(), row = static_cast<std::size_t>(grid.ny);
  Plane ux(n + row), uy(n + row);
  influence.tangential_from_pressure(p.data(), ux.data(), uy.data(), grid.nx + 1);
  for (std::size_t i = 0; i < n; ++i) {
    slip_x[i] += kind == RollingKind::shift ? -ux[i] : (ux[i + row] - ux[i]) / grid.dx;
    slip_y[i] += kind == RollingKind::shift ? -uy[i] : (uy[i + row] - uy[i]) / grid.dx;
  }
}

TangentialProblem tangential_part(const InfluenceOperator& influence, const PatchGrid& grid, const RollingContact& contact, const Plane& pressure) {
  TangentialProblem t;
  t.kind = contact.kind;
  t.x = contact.x;
  t.y = contact.y;
  t.spin = contact.spin;
  t.extra_x = contact.extra_x;
  t.extra_y = contact.extra_y;
  t.bound = pressure;
  for (std::size_t i = 0; i < t.bound.size(); ++i) t.bound[i] *= contact.local_friction.empty() ? contact.friction : contact.local_friction[i];
  if (influence.couples()) {
    t.extra_x.resize(grid.size(), 0.0);
    t.extra_y.resize(grid.size(), 0.0);
    add_slip_of_pressure(influence, grid, contact.kind, pressure, t.extra_x, t.extra_y);
  }
  return t;
}

double largest_change(const Plane& a, const Plane& b) {
  double change = 0, peak = 0;
  for (std::size_t i = 0; i < a.size(); ++i) change = std::max(change, std::abs(a[i] - b[i])), peak = std::max(peak, b[i]);
  return change / peak;
}

}  // namespace

RollingSolution solve_rolling(const InfluenceOperator& influence, const PatchGrid& grid, const RollingContact& contact, const RollingOptions& options) {
  RollingSolution s;
  s.normal = solve_normal(influence, grid, contact.gap, contact.target, options.normal);
  s.tangential = solve_tangential(influence, grid, tangential_part(influence, grid, contact, s.normal.pressure), options.tangential);
  if (!influence.couples()) return s;
  Plane gap(grid.size());
  for (s.turns = 2; s.turns <= options.max_turns; ++s.turns) {
    influence.normal_from_traction(s.tangential.q_x.data(), s.tangential.q_y.data(), gap.data());
    for (std::size_t i = 0; i < gap.size(); ++i) gap[i] += contact.gap[i];
    NormalSolution next = solve_normal(influence, grid, gap, contact.target, options.normal, s.normal.pressure);
    const double change = largest_change(next.pressure, s.normal.pressure);
    s.normal = std::move(next);
    s.tangential = solve_tangential(influence, grid, tangential_part(influence, grid, contact, s.normal.pressure), options.tangential, &s.tangential);
    if (change < options.coupling_tolerance) return s;
  }
  throw NumericalError("normal and tangential contact did not settle against each other");
}

}  // namespace railstrata
