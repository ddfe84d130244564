#include "fem/node_update.hpp"

#include "core/parallel.hpp"
#include "core/vectorize.hpp"
#include "fem/rank_exchange.hpp"

namespace railstrata {
namespace {

// The rows of one section node: displacements, velocities and forces by component, and what the update reads.
struct NodeRows {
  double *ux, *uy, *uz, *vx, *vy, *vz;
  const double *fx, *fy, *fz;
  const double* inverse_mass;
  const double *cosine, *sine;  // of the station angles; revolved bodies only
  double radius;
};

NodeRows rows_of(const RollingBody& b, BodyState& state, SectionNode node, const double* const (&f)[3]) {
  const BlockLayout& lay = b.body.layout.blocks[node.block];
  const std::ptrdiff_t x = lay.line(node.node, 0), y = x + lay.stride, z = y + lay.stride;
  return {state.u.data() + x,
          state.u.data() + y,
          state.u.data() + z,
          state.v.data() + x,
          state.v.data() + y,
          state.v.data() + z,
          f[0],
          f[1],
          f[2],
          b.body.inverse_mass.data() + x,
          b.cos_node[node.block].data(),
          b.sin_node[node.block].data(),
          b.turns() ? line_radius(b.body, node.block, node.node) : 0.0};
}

// Stations begin <= j < end of one section node (fem/stepper.hpp has the scheme). measured: with run-up damping and
// sums. Everything a loop needs stands in locals, and nothing in it branches: it is compiled to packs.
template <SweepKind kind, bool measured>
void advance_rows(const NodeRows& node, const RollingBody& b, const StepScope& scope, int begin, int end,
                  UpdateSums& sums) {
  constexpr bool turning = kind == SweepKind::revolve;
  const NodeRows n = node;
  const NodeStep step = node_step<kind>(b.frame, b.mean, scope.dt, scope.damping_rate, scope.gravity);
  const double radius = n.radius;
  NodeSums of_rows;
  RAILSTRATA_INDEPENDENT
  for (int j = begin; j < end; ++j)
    advance_node<kind, measured>(step, n.inverse_mass[j], radius, turning ? n.cosine[j] : 1.0,
                                 turning ? n.sine[j] : 0.0, n.fx[j], n.fy[j], n.fz[j], n.ux[j], n.uy[j], n.uz[j],
                                 n.vx[j], n.vy[j], n.vz[j], of_rows);
  if constexpr (measured) sums += {0.5 * of_rows.twice_kinetic, of_rows.power, of_rows.px, of_rows.pz, of_rows.angular};
}

void advance(RollingBody& b, BodyState& state, const StepScope& scope, SectionNode node, int begin, int end,
             const double* const (&f)[3], UpdateSums& sums) {
  const NodeRows rows = rows_of(b, state, node, f);
  const bool measured = scope.sums_wanted();
  if (b.turns() && measured)
    advance_rows<SweepKind::revolve, true>(rows, b, scope, begin, end, sums);
  else if (b.turns())
    advance_rows<SweepKind::revolve, false>(rows, b, scope, begin, end, sums);
  else if (measured)
    advance_rows<SweepKind::extrude, true>(rows, b, scope, begin, end, sums);
  else
    advance_rows<SweepKind::extrude, false>(rows, b, scope, begin, end, sums);
}

// Work of both bodies as one range: the first body's items, then the second's.
struct Item {
  std::size_t body;
  std::ptrdiff_t index;
};
Item item_of(std::ptrdiff_t k, std::ptrdiff_t first_count) {
  return k < first_count ? Item{0, k} : Item{1, k - first_count};
}

// One chain of a body, its nodes updated while their forces are in cache.
UpdateSums fused_chain(RollingBody& b, BodyState& state, const StepScope& scope, const Chain& chain) {
  UpdateSums sums;
  const auto update = [&](const Tile& tile, int begin, int node, const double* rows) {
    if (!b.schedule.at_once[tile.block][node]) return false;
    const double* const f[3] = {rows - tile.first, rows + kTile - tile.first, rows + 2 * kTile - tile.first};
    const SectionNode at{tile.block, node};
    if (begin == tile.first) advance(b, state, scope, at, begin, begin + 1, f, sums);  // the others: aligned to packs
    advance(b, state, scope, at, tile.first + 1, tile.end, f, sums);
    return true;
  };
  const auto expect = [&](const Tile& tile, int node, Prefetch& lines) {
    if (!b.schedule.at_once[tile.block][node]) return;
    const BlockLayout& lay = b.body.layout.blocks[tile.block];
    const std::ptrdiff_t x = lay.line(node, 0) + tile.first;
    for (int i = 0; i < 3; ++i) lines.add(&state.v[x + i * lay.stride]);
    lines.add(&b.body.inverse_mass[x]);
  };
  b.elements.chain_forces(chain, state.u, state.f, state.history, FuseUpdate{update, expect});
  return sums;
}

}  // namespace

void evaluate_elements(RollingBodies& bodies, BodyStates& states, const std::array<double, 2>& drift,
                       const StepScope& scope, RankExchange* exchange) {
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    bodies[k].elements.begin(states[k].u, drift[k]);
    const TileCut* cut = scope.energy_wanted ? nullptr : &bodies[k].cut;  // energies read the history of all
    advance_plastic_elements(bodies[k].body, states[k].u, drift[k], states[k].history, scope.look, cut);
    chain_tiles(bodies[k], scope.sums_wanted());
  }
  const auto count = [&](std::size_t k) { return static_cast<std::ptrdiff_t>(bodies[k].schedule.own.size()); };
  const auto run = [&](std::ptrdiff_t task) {
    const Item item = item_of(task, count(0));
    RollingBody& b = bodies[item.body];
    BodyState& state = states[item.body];
    const int own = b.schedule.own[item.index];
    const Chain& chain = b.schedule.chains[own];
    UpdateSums& sums = b.schedule.chain_sums[own];
    if (scope.energy_wanted) {
      b.elements.chain_forces(chain, state.u, state.f, state.history, StoreForces{});
      sums = {};
    } else {
      sums = fused_chain(b, state, scope, chain);
    }
  };
  for_each(count(0) + count(1), run, true);
  if (exchange) {
    exchange->share_forces(bodies, states, scope);
    return;
  }
  for (std::size_t k = 0; k < bodies.size(); ++k) bodies[k].elements.end(bodies[k].schedule.chains, states[k].f);
}

void update_waiting_nodes(RollingBodies& bodies, BodyStates& states, const StepScope& scope) {
  const auto waiting = [&](std::size_t k) { return static_cast<std::ptrdiff_t>(bodies[k].schedule.waiting.size()); };
  const auto count = [&](std::size_t k) {
    return waiting(k) + static_cast<std::ptrdiff_t>(bodies[k].schedule.bordered.size());
  };
  for_each(count(0) + count(1), [&](std::ptrdiff_t task) {
    Item item = item_of(task, count(0));
    RollingBody& b = bodies[item.body];
    BodyState& state = states[item.body];
    UpdateSchedule& schedule = b.schedule;
    const bool border = item.index >= waiting(item.body);
    if (border) item.index -= waiting(item.body);
    const SectionNode node = border ? schedule.bordered[item.index] : schedule.waiting[item.index];
    const BlockLayout& lay = b.body.layout.blocks[node.block];
    const double* line = state.f.data() + lay.line(node.node, 0);
    const double* const f[3] = {line, line + lay.stride, line + 2 * lay.stride};
    UpdateSums sums;
    if (border && !scope.energy_wanted) {
      for (int j : schedule.borders[node.block]) advance(b, state, scope, node, j, j + 1, f, sums);
    } else {
      advance(b, state, scope, node, 0, lay.stations, f, sums);
    }
    (border ? schedule.border_sums : schedule.waiting_sums)[item.index] = sums;
  });
}

std::array<UpdateSums, 2> update_sums(const RollingBodies& bodies, const StepScope& scope) {
  std::array<UpdateSums, 2> out;
  if (!scope.sums_wanted()) return out;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const UpdateSchedule& schedule = bodies[k].schedule;
    if (!scope.energy_wanted)
      for (const UpdateSums& s : schedule.chain_sums) out[k] += s;
    for (const UpdateSums& s : schedule.waiting_sums) out[k] += s;
    for (const UpdateSums& s : schedule.border_sums) out[k] += s;
  }
  return out;
}

}  // namespace railstrata
