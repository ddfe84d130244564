#include "fem/node_update.hpp"

#include <algorithm>

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

// Data shared by the updates of one body's nodes in a step.
struct BodyUpdate {
  RollingBody& body;
  BodyState& state;
  NodeStep step;
  bool measured;  // with run-up damping and sums
};

BodyUpdate update_of(RollingBody& b, BodyState& state, const StepScope& scope) {
  return {b, state, node_step(b.frame, b.mean, scope.dt, damping_of(b, scope), scope.gravity), scope.sums_wanted()};
}

// Calls run.operator()<kind, measured>().
template <class Run>
void in_kind(const BodyUpdate& of, Run&& run) {
  if (of.body.turns() && of.measured)
    run.template operator()<SweepKind::revolve, true>();
  else if (of.body.turns())
    run.template operator()<SweepKind::revolve, false>();
  else if (of.measured)
    run.template operator()<SweepKind::extrude, true>();
  else
    run.template operator()<SweepKind::extrude, false>();
}

// Stations begin <= j < end of one section node (fem/stepper.hpp has the scheme). Everything a loop needs stands in
// locals, and nothing in it branches: it is compiled to packs.
template <SweepKind kind, bool measured>
void advance_rows(const NodeRows& node, const NodeStep& of_body, int begin, int end, UpdateSums& sums) {
  constexpr bool turning = kind == SweepKind::revolve;
  const NodeRows n = node;
  const NodeStep step = of_body;
  const double radius = n.radius;
  UpdateSums of_rows;
  RAILSTRATA_INDEPENDENT
  for (int j = begin; j < end; ++j)
    advance_node<kind, measured>(step, n.inverse_mass[j], radius, turning ? n.cosine[j] : 1.0,
                                 turning ? n.sine[j] : 0.0, n.fx[j], n.fy[j], n.fz[j], n.ux[j], n.uy[j], n.uz[j],
                                 n.vx[j], n.vy[j], n.vz[j], of_rows);
  if constexpr (measured) sums += of_rows;
}

// One station. Whether a plane lies within a chain or between two depends on the number of threads, its bits do not:
// both come here, and out of line, so that the compiler fuses the same products.
template <SweepKind kind, bool measured>
__attribute__((noinline)) void advance_station(const NodeRows& n, const NodeStep& step, int j, UpdateSums& sums) {
  constexpr bool turning = kind == SweepKind::revolve;
  advance_node<kind, measured>(step, n.inverse_mass[j], n.radius, turning ? n.cosine[j] : 1.0,
                               turning ? n.sine[j] : 0.0, n.fx[j], n.fy[j], n.fz[j], n.ux[j], n.uy[j], n.uz[j], n.vx[j],
                               n.vy[j], n.vz[j], sums);
}

void advance_at(const BodyUpdate& of, SectionNode node, int station, const double* const (&f)[3], UpdateSums& sums) {
  const NodeRows rows = rows_of(of.body, of.state, node, f);
  UpdateSums of_node;
  in_kind(of,
          [&]<SweepKind kind, bool measured>() { advance_station<kind, measured>(rows, of.step, station, of_node); });
  if (of.measured) sums += of_node;
}

void advance(const BodyUpdate& of, SectionNode node, int begin, int end, const double* const (&f)[3],
             UpdateSums& sums) {
  const NodeRows rows = rows_of(of.body, of.state, node, f);
  in_kind(of, [&]<SweepKind kind, bool measured>() { advance_rows<kind, measured>(rows, of.step, begin, end, sums); });
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
UpdateSums fused_chain(const BodyUpdate& of, const Chain& chain) {
  RollingBody& b = of.body;
  BodyState& state = of.state;
  UpdateSums sums;
  const auto update = [&](const Tile& tile, int begin, int node, const double* rows) {
    if (!b.schedule.at_once[tile.block][node]) return false;
    const double* const f[3] = {rows - tile.first, rows + kTile - tile.first, rows + 2 * kTile - tile.first};
    const SectionNode at{tile.block, node};
    if (begin == tile.first) advance_at(of, at, begin, f, sums);  // the others: aligned to packs
    advance(of, at, tile.first + 1, tile.end, f, sums);
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

// A node plane between elements of two chains, with the forces that they left there, [node][component], of the one that
// begins here and of the one that ends here. Nodes that wait for nothing are updated, the others' forces go to f.
template <SweepKind kind, bool measured>
UpdateSums advance_plane(const BodyUpdate& of, int block, int station, const double* all_front,
                         const double* all_behind) {
  const BlockLayout& lay = of.body.body.layout.blocks[block];
  const std::vector<char>& at_once = of.body.schedule.at_once[block];
  UpdateSums sums;
  for (int n = 0; n < lay.nodes; ++n) {
    const double *front = all_front + 3 * n, *behind = all_behind + 3 * n;
    const double force[3] = {behind[0] + front[0], behind[1] + front[1], behind[2] + front[2]};
    if (at_once[n]) {
      const double* const f[3] = {force - station, force + 1 - station, force + 2 - station};
      advance_station<kind, measured>(rows_of(of.body, of.state, {block, n}, f), of.step, station, sums);
    } else {
      double* const line = of.state.f.data() + lay.line(n, 0) + station;
      for (int i = 0; i < 3; ++i) line[static_cast<std::ptrdiff_t>(i) * lay.stride] = force[i];
    }
  }
  return sums;
}

void store_plane(const BodyUpdate& of, int block, int station, const double* forces) {
  const BlockLayout& lay = of.body.body.layout.blocks[block];
  const std::ptrdiff_t lines = static_cast<std::ptrdiff_t>(lay.nodes) * 3;
  double* const out = of.state.f.data() + lay.offset + station;
  for (std::ptrdiff_t line = 0; line < lines; ++line) out[line * lay.stride] = forces[line];
}

// The plane in front of a chain, and the last one of an open block. The ends of open blocks get their forces and wait
// for those from outside.
UpdateSums complete_planes(const BodyUpdate& of, const Chain& chain) {
  RollingBody& b = of.body;
  const Tiling& tiling = b.body.tiling;
  const int t = chain.first_tile, block = tiling.block(chain);
  const int block_first = tiling.first_tile[block], block_end = tiling.first_tile[block + 1];
  const BlockLayout& lay = b.body.layout.blocks[block];
  if (chain.end_tile == block_end && !lay.closed)
    store_plane(of, block, lay.elements, b.elements.rear_forces(block_end - 1));
  const int station = tiling.border_plane(chain);
  if (t == block_first && !lay.closed) {
    store_plane(of, block, station, b.elements.front_forces(t));
    return {};
  }
  const int before = t == block_first ? block_end - 1 : t - 1;
  const double *front = b.elements.front_forces(t), *behind = b.elements.rear_forces(before);
  UpdateSums sums;
  in_kind(of, [&]<SweepKind kind, bool measured>() {
    sums = advance_plane<kind, measured>(of, block, station, front, behind);
  });
  return sums;
}

// A tile's stations of a line, with the end of an open block.
StationRange stations_of(const Tile& tile, const BlockLayout& block) {
  return {tile.first, tile.end + (!block.closed && tile.end == block.elements)};
}

// A node that waited, with sums tile by tile: of the tiles that this rank has; all where energies are wanted.
void advance_measured(const BodyUpdate& of, std::size_t waiting, const double* const (&f)[3], bool all) {
  RollingBody& b = of.body;
  const SectionNode node = b.schedule.waiting[waiting];
  const Tiling& tiling = b.body.tiling;
  const int first = tiling.first_tile[node.block];
  for (int t = first; t < tiling.first_tile[node.block + 1]; ++t) {
    const StationRange at = stations_of(tiling.tiles[t], b.body.layout.blocks[node.block]);
    UpdateSums sums;
    if (all || b.part == nullptr || b.cut.is_own(t)) {
      advance(of, node, at.begin, at.end, f, sums);
      b.schedule.waiting_sums[b.schedule.first_waiting_sum[waiting] + static_cast<std::size_t>(t - first)] = sums;
      continue;
    }
    for (const StationRange& kept : b.part->values[node.block][node.node]) {
      const int begin = std::max(kept.begin, at.begin), end = std::min(kept.end, at.end);
      if (begin < end) advance(of, node, begin, end, f, sums);
    }
  }
}

void add_up_tiles(RollingBody& b, bool all) {
  UpdateSchedule& schedule = b.schedule;
  const Tiling& tiling = b.body.tiling;
  std::fill(schedule.tile_sums.begin(), schedule.tile_sums.end(), UpdateSums{});
  if (!all)
    for (int c : schedule.own) {
      UpdateSums& sums = schedule.tile_sums[schedule.chains[c].first_tile];
      sums += schedule.chain_sums[c];
      sums += schedule.plane_sums[c];
    }
  for (std::size_t w = 0; w < schedule.waiting.size(); ++w) {
    const int block = schedule.waiting[w].block, first = tiling.first_tile[block];
    for (int t = first; t < tiling.first_tile[block + 1]; ++t)
      if (all || b.cut.is_own(t))
        schedule.tile_sums[t] +=
            schedule.waiting_sums[schedule.first_waiting_sum[w] + static_cast<std::size_t>(t - first)];
  }
}

}  // namespace

double damping_of(const RollingBody& body, const StepScope& scope) {
  return body.body.mesh.on_pads.empty() ? scope.damping_rate : 0.0;
}

void evaluate_elements(RollingBodies& bodies, BodyStates& states, const std::array<double, 2>& drift,
                       const StepScope& scope, RankExchange* exchange) {
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    bodies[k].elements.begin(states[k].u, drift[k]);
    const TileCut* cut = scope.energy_wanted ? nullptr : &bodies[k].cut;  // energies read the history of all
    advance_plastic_elements(bodies[k].body, states[k].u, drift[k], states[k].history, scope.look, cut);
    chain_tiles(bodies[k], scope.sums_wanted());
  }
  scope.lap(StepPart::begin);
  const BodyUpdate updates[] = {update_of(bodies[0], states[0], scope), update_of(bodies[1], states[1], scope)};
  const auto own = [&](std::size_t k) { return static_cast<std::ptrdiff_t>(bodies[k].schedule.own.size()); };
  const auto run = [&](std::ptrdiff_t task) {
    const Item item = item_of(task, own(0));
    RollingBody& b = bodies[item.body];
    BodyState& state = states[item.body];
    const int k = b.schedule.own[item.index];
    const Chain& chain = b.schedule.chains[k];
    UpdateSums& sums = b.schedule.chain_sums[k];
    if (scope.energy_wanted) {
      b.elements.chain_forces(chain, state.u, state.f, state.history, StoreForces{});
      sums = {};
    } else {
      sums = fused_chain(updates[item.body], chain);
    }
  };
  for_each_apart(own(0) + own(1), run);
  scope.lap(StepPart::elements);
  if (exchange)
    exchange->share_forces(bodies, states, drift, scope);
  else if (scope.energy_wanted)
    for (std::size_t k = 0; k < bodies.size(); ++k) bodies[k].elements.end(bodies[k].schedule.chains, states[k].f);
  scope.lap(StepPart::exchange);
  if (scope.energy_wanted) return;
  const auto chains = [&](std::size_t k) { return static_cast<std::ptrdiff_t>(bodies[k].schedule.chains.size()); };
  const auto complete = [&](std::ptrdiff_t task) {
    const Item item = item_of(task, chains(0));
    UpdateSchedule& schedule = bodies[item.body].schedule;
    schedule.plane_sums[item.index] = complete_planes(updates[item.body], schedule.chains[item.index]);
  };
  for_each(chains(0) + chains(1), complete, true);
}

void update_waiting_nodes(RollingBodies& bodies, BodyStates& states, const StepScope& scope) {
  const BodyUpdate updates[] = {update_of(bodies[0], states[0], scope), update_of(bodies[1], states[1], scope)};
  const auto waiting = [&](std::size_t k) { return static_cast<std::ptrdiff_t>(bodies[k].schedule.waiting.size()); };
  const auto count = [&](std::size_t k) {
    return waiting(k) + static_cast<std::ptrdiff_t>(bodies[k].schedule.bordered.size());
  };
  const auto update = [&](int, std::ptrdiff_t task) {
    Item item = item_of(task, count(0));
    RollingBody& b = bodies[item.body];
    UpdateSchedule& schedule = b.schedule;
    const bool border = item.index >= waiting(item.body);
    if (border) item.index -= waiting(item.body);
    const SectionNode node = border ? schedule.bordered[item.index] : schedule.waiting[item.index];
    const BlockLayout& lay = b.body.layout.blocks[node.block];
    const double* line = states[item.body].f.data() + lay.line(node.node, 0);
    const double* const f[3] = {line, line + lay.stride, line + 2 * lay.stride};
    if (!border && scope.sums_wanted()) {
      advance_measured(updates[item.body], static_cast<std::size_t>(item.index), f, scope.energy_wanted);
      return;
    }
    UpdateSums sums;
    if (!border && b.part != nullptr) {
      for (const StationRange& at : b.part->values[node.block][node.node])
        advance(updates[item.body], node, at.begin, at.end, f, sums);
    } else if (!border || scope.energy_wanted) {
      advance(updates[item.body], node, 0, lay.stations, f, sums);
    } else if (!lay.closed) {
      advance_at(updates[item.body], node, 0, f, sums);
      advance_at(updates[item.body], node, lay.elements, f, sums);
    }
    if (border) schedule.border_sums[item.index] = sums;
  };
  for_each_in_stages(
      1, [&](int) { return count(0) + count(1); }, update);
}

std::array<UpdateSums, 2> update_sums(RollingBodies& bodies, const StepScope& scope, RankExchange* exchange) {
  std::array<UpdateSums, 2> out;
  if (!scope.sums_wanted()) return out;
  for (RollingBody& b : bodies) add_up_tiles(b, scope.energy_wanted);
  if (exchange && !scope.energy_wanted) exchange->share_sums(bodies);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    for (const UpdateSums& s : bodies[k].schedule.tile_sums) out[k] += s;
    for (const UpdateSums& s : bodies[k].schedule.border_sums) out[k] += s;
  }
  return out;
}

}  // namespace railstrata
