#include "bem/interface_slip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/faults.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {
namespace {

constexpr double kContactTolerance = 1e-3;  // of the largest pressure, between two solutions
constexpr int kMostTries = 8;               // of contact and slip in one passage
constexpr int kMostPassages = 30;
constexpr double kRepeats = 0.01;  // of the first passage: changes of what a passage leaves behind

/// Cells around a patch, over so many depths, on which periods do not show.
struct GridAround {
  PatchGrid grid;
  int border = 0;  // cells that do not slide
};

GridAround grid_around_patch(const PatchGrid& patch, double depth) {
  constexpr double kAlong = 6, kAcross = 4, kBorder = 3;  // depths
  GridAround out;
  const auto cells = [&](double depths) { return static_cast<int>(std::ceil(depths * depth / patch.finest())); };
  out.border = cells(kBorder);
  out.grid = patch;
  out.grid.nx = good_fft_length(patch.nx + 2 * cells(kAlong));
  out.grid.x0 -= cells(kAlong) * patch.dx;
  if (patch.line) return out;
  out.grid.ny = good_fft_length(patch.ny + 2 * cells(kAcross));
  out.grid.y0 -= cells(kAcross) * patch.dy;
  return out;
}

/// The values of a plane in the cells of another grid with cells of the same size; none beyond it.
Plane moved_to(const PatchGrid& to, const PatchGrid& from, const Plane& given) {
  Plane out(to.size(), 0.0);
  const auto shift_x = static_cast<int>(std::lround((to.x0 - from.x0) / from.dx)),
             shift_y = to.line ? 0 : static_cast<int>(std::lround((to.y0 - from.y0) / from.dy));
  for (int i = 0; i < to.nx; ++i)
    for (int j = 0; j < to.ny; ++j) {
      const int a = i + shift_x, b = j + shift_y;
      if (a >= 0 && b >= 0 && a < from.nx && b < from.ny) out[to.index(i, j)] = given[from.index(a, b)];
    }
  return out;
}

InterfaceLoad load_on(const PatchGrid& grid, double depth, const BemResult& r) {
  const int more_x = (grid.nx - r.grid.nx) / 2 + 1, more_y = grid.line ? 0 : (grid.ny - r.grid.ny) / 2 + 1;
  const auto wide = rail_interior(r).widened(more_x, more_y);
  const StatePlane plane = wide->plane(depth);
  InterfaceLoad out{{moved_to(grid, wide->grid(), plane.s_xz), moved_to(grid, wide->grid(), plane.s_yz)},
                    moved_to(grid, wide->grid(), plane.s_zz)};
  scale_by(out.pressure, -1);
  return out;
}

RailSurface surface_above(const InterfaceMarch& march, const PatchGrid& cells) {
  const PatchGrid& g = march.waves().grid();
  const std::array<Plane, 3> moves = march.waves().surface(march.slip());
  const auto stretch = [&](const Plane& u) {
    Plane out(u.size(), 0.0);
    for (std::size_t k = 0; k + static_cast<std::size_t>(g.ny) < u.size(); ++k)
      out[k] = (u[k + static_cast<std::size_t>(g.ny)] - u[k]) / g.dx;
    return moved_to(cells, g, out);
  };
  return {moved_to(cells, g, moves[2]), {stretch(moves[0]), stretch(moves[1])}};
}

/// Largest change of the pressure over its maximum.
double change_between(const BemResult& a, const BemResult& b) {
  if (a.field.p.size() != b.field.p.size()) return 1;
  double most = 0;
  for (std::size_t k = 0; k < a.field.p.size(); ++k)
    most = std::max({most, std::abs(a.field.p[k] - b.field.p[k]), std::abs(a.field.q_x[k] - b.field.q_x[k]),
                     std::abs(a.field.q_y[k] - b.field.q_y[k])});
  return most / a.patch.largest_pressure;
}

/// Along the row in which a passage slips most.
std::vector<InterfacePlace> places_along(const InterfaceMarch& march) {
  const PatchGrid& g = march.waves().grid();
  const PlanePair &slip = march.slip(), &shear = march.shear();
  double most = -1;
  int row = 0;
  for (int i = 0; i < g.nx; ++i)
    for (int j = 0; j < g.ny; ++j) {
      const std::size_t k = g.index(i, j), at = static_cast<std::size_t>(j);
      const double here = std::hypot(slip.x[k] - march.ahead().x[at], slip.y[k] - march.ahead().y[at]);
      if (!(here > most)) continue;
      most = here;
      row = j;
    }
  std::vector<InterfacePlace> out;
  for (int i = march.border(); i < g.nx - march.border(); ++i) {
    const std::size_t k = g.index(i, row);
    out.push_back({g.x(i), slip.x[k], slip.y[k], shear.x[k], shear.y[k]});
  }
  return out;
}

}  // namespace

std::optional<SlidingInterface> sliding_interface(const CaseSpec& spec) {
  double depth = 0;
  for (const LayerSpec& layer : spec.layers) {
    if (layer.on != BodyId::rail) continue;
    depth += layer.thickness;
    if (!layer.slides()) continue;
    SlidingInterface out{0, 0, {layer.interface_shear_limit.value_or(0), layer.interface_friction.value_or(0)}};
    const LayeredHalfSpace rail = layered_body(spec, BodyId::rail);
    while (out.depth < (1 - 1e-9) * depth) out.depth += rail.layers[out.layer++].thickness;
    --out.layer;
    return out;
  }
  return {};
}

ContactOverInterface solve_over_interface(const SlidingInterface& sliding, const BemOptions& given,
                                          const std::function<BemResult(const BemOptions&)>& solve) {
  BemOptions options = given;
  ContactOverInterface out{solve(options), {}};
  BemResult& r = out.contact;
  InterfaceSlip& slip = out.slip;
  if (!r.further.empty() || !r.others.empty())
    throw CaseError("the wheel touches at several places: an interface slides below one patch",
                    "move the wheel (geometry.lateral_shift) until it touches at one place", "geometry.lateral_shift");
  const GridAround around = grid_around_patch(r.grid, sliding.depth);
  InterfaceMarch march(InterfaceWaves(r.rail, sliding.layer, around.grid), sliding.limit, around.border);
  options.rail_surface = [&](const PatchGrid& cells) { return surface_above(march, cells); };
  for (int passage = 0; passage < kMostPassages && !slip.repeats; ++passage) {
    InterfacePassage now;
    for (int round = 0; round < kMostTries; ++round) {
      now = march.pass(load_on(around.grid, sliding.depth, r));
      if (!(now.largest > 0) && passage == 0) break;
      BemResult next = solve(options);
      const double change = change_between(r, next);
      r = std::move(next);
      if (change < kContactTolerance) break;
    }
    slip.passages.push_back(now);
    slip.last = places_along(march);
    if (passage == 0) slip.first = slip.last;
    const double first = slip.passages.front().left;
    slip.repeats =
        !(std::abs(now.left - (passage > 0 ? slip.passages[slip.passages.size() - 2].left : 0)) > kRepeats * first);
    if (!slip.repeats) march.turn_to_next();
  }
  if (!slip.repeats)
    r.notes.push_back(
        fmt::format("interface: after {} passages each leaves another slip behind than the one before", kMostPassages));
  return out;
}

}  // namespace railstrata
