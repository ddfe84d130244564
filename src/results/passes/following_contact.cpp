#include "passes/following_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "steady/anderson.hpp"

namespace railstrata {
namespace {

constexpr double kTolerance = 2e-3;  // of the largest pressure
constexpr int kMostRounds = 40;
constexpr double kShare = 0.5;  // of a round's new displacement that is taken: sinking lowers the pressure behind it

/// Weights of the numbers of a period at a place, in steps from the first one: the interpolation of its waves.
std::vector<double> weights_at(int n, double place) {
  std::vector<double> out(static_cast<std::size_t>(n), 1.0);
  if (n == 1) return out;
  for (int k = 0; k < n; ++k) {
    const double t = std::numbers::pi * (place - k), period = t / n;
    if (std::abs(std::sin(period)) < 1e-12) continue;
    out[static_cast<std::size_t>(k)] = std::sin(t) / (n * (n % 2 == 0 ? std::tan(period) : std::sin(period)));
  }
  return out;
}

/// The change of pressure in a cell over the largest one; infinite on another grid.
double largest_change(const BemResult& now, const BemResult& before) {
  if (now.field.p.size() != before.field.p.size() || now.grid.nx != before.grid.nx)
    return std::numeric_limits<double>::infinity();
  double change = 0;
  for (std::size_t k = 0; k < now.field.p.size(); ++k)
    change = std::max(change, std::abs(now.field.p[k] - before.field.p[k]));
  return change / now.patch.largest_pressure;
}

}  // namespace

RailSurface surface_in_cells(const PatchGrid& cells, const SteadyGrid& g, double middle_x, int columns,
                             const Field& surface) {
  std::vector<std::vector<double>> along, across;
  for (int i = 0; i <= cells.nx; ++i)  // one beyond: the step ahead of the last cell
    along.push_back(weights_at(g.nx, (g.front - (cells.x(i) - middle_x)) / g.dx - 0.5));
  for (int j = 0; j < cells.ny; ++j)
    across.push_back(weights_at(g.ny, g.ny > 1 ? (cells.y(j) - g.y0) / g.dy + columns : 0));
  const auto in_cells = [&](std::size_t component) {
    const double* values = surface.data() + component * g.plane();
    Plane out(along.size() * across.size());
    std::vector<double> line(static_cast<std::size_t>(g.ny));
    for (std::size_t i = 0; i < along.size(); ++i) {
      std::fill(line.begin(), line.end(), 0.0);
      for (std::size_t n = 0; n < along[i].size(); ++n)
        for (std::size_t m = 0; m < line.size(); ++m) line[m] += along[i][n] * values[n * line.size() + m];
      for (std::size_t j = 0; j < across.size(); ++j)
        for (std::size_t m = 0; m < line.size(); ++m) out[i * across.size() + j] += across[j][m] * line[m];
    }
    return out;
  };
  const auto stretch = [&](const Plane& u) {
    Plane out(cells.size());
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = (u[k + static_cast<std::size_t>(cells.ny)] - u[k]) / cells.dx;
    return out;
  };
  RailSurface out{in_cells(2), {stretch(in_cells(0)), stretch(in_cells(1))}};
  out.sinking.resize(cells.size());
  return out;
}

FollowingContact::FollowingContact(std::vector<CaseSpec> specs, std::vector<Placement> placements,
                                   const BemOptions& bem)
    : specs_(std::move(specs)), placements_(std::move(placements)), bem_(bem) {}

BemResult FollowingContact::solve(const RailPasses& rail, const Field& surface, std::size_t traction, int columns,
                                  BemNeighbour& neighbour) {
  BemOptions bem = bem_;
  bem.cache = &cache_;
  bem.neighbour = &neighbour;
  bem.rail_surface = [&](const PatchGrid& cells) {
    return surface_in_cells(cells, rail.grid, rail.middle_x, columns, surface);
  };
  return solve_bem(specs_.at(traction), placements_.at(traction), bem);
}

FollowedPass FollowingContact::run_pass(const RailPasses& rail, const SteadyBody& body, std::size_t traction,
                                        int columns, PassState& state, const PassLimits& limits) {
  FollowedPass out;
  PassState begun = state;
  Field surface = body.surface_expected(state);
  BemNeighbour neighbour;  // of this pass alone: passes that go on from a file have the same bits
  BemResult contact = solve(rail, surface, traction, columns, neighbour);
  Anderson anderson;
  for (;;) {
    ++out.rounds;
    out.contact_strain = contact_strain(rail, body, contact_stress(rail, contact), columns);
    PassState next = begun;
    out.result = body.run_pass(out.contact_strain, next, limits);
    begun.residual_strain = next.residual_strain;  // the next round's first guess
    Field residual(surface.size());
    for (std::size_t n = 0; n < surface.size(); ++n) residual[n] = kShare * (out.result.surface[n] - surface[n]);
    anderson.step(surface, residual);
    BemResult moved = solve(rail, surface, traction, columns, neighbour);
    out.change = largest_change(moved, contact);
    out.converged = out.change <= kTolerance;
    if (out.converged || out.rounds == kMostRounds) {
      state = std::move(next);
      break;
    }
    contact = std::move(moved);
  }
  out.largest_pressure = contact.patch.largest_pressure;
  out.creepage = contact.rigid_slip.x;
  return out;
}

}  // namespace railstrata
