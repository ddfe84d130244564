#include "fem/rolling_body.hpp"

#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/parallel.hpp"
#include "fem/contact_law.hpp"
#include "mesh/split_interface.hpp"

namespace railstrata {
namespace {

// du/dt along the sweep by central differences on unequal spacing.
template <class F>
double station_derivative(const Block& block, int stations, int j, F&& value) {
  const auto& at = block.stations.at;
  const bool closed = block.stations.closed;
  const double period = 2 * std::numbers::pi;
  const int before = j > 0 ? j - 1 : closed ? stations - 1 : j;
  const int after = j + 1 < stations ? j + 1 : closed ? 0 : j;
  double t0 = at[before], t1 = at[after];
  if (closed && before > j) t0 -= period;
  if (closed && after < j) t1 += period;
  return (value(after) - value(before)) / (t1 - t0);
}

// Nodes that are not free are not updated at all.
UpdateSchedule schedule_of(const Body& body, const ContactSurface& surface, const MassScaling& scaling) {
  UpdateSchedule out;
  const SweptBody& mesh = body.mesh;
  out.at_once = no_nodes(mesh);
  for (const NodeLine& l : body.lines) out.at_once[l.block][l.node] = 1;
  const auto wait = [&](int block, int node) {
    if (!out.at_once[block][node]) return;
    out.waiting.push_back({block, node});
    out.at_once[block][node] = 0;
  };
  for (int c = 0; c < surface.columns; ++c) wait(mesh.contact.block, c);
  for (const SectionNode& n : mesh.on_pads) wait(n.block, n.node);
  for (const SplitInterface& interface : mesh.interfaces)
    each_pair(interface, mesh.contact, [&](int above, int below) {
      wait(mesh.contact.block, above);
      wait(mesh.contact.block, below);
    });
  for (const Tie& t : mesh.ties) {
    wait(t.master_block, t.master_node0);
    wait(t.master_block, t.master_node1);
  }
  const auto each_node = [&](auto&& visit) {
    for (int b = 0; b < static_cast<int>(out.at_once.size()); ++b)
      for (int n = 0; n < static_cast<int>(out.at_once[b].size()); ++n) visit(b, n);
  };
  each_node([&](int b, int n) {
    if (scaling.acts_on(b, n)) wait(b, n);
  });
  each_node([&](int b, int n) {
    if (out.at_once[b][n]) out.bordered.push_back({b, n});
  });
  std::size_t sums = 0;
  for (const SectionNode& n : out.waiting) {
    out.first_waiting_sum.push_back(sums);
    sums += static_cast<std::size_t>(body.tiling.first_tile[n.block + 1] - body.tiling.first_tile[n.block]);
  }
  out.waiting_sums.resize(sums);
  out.tile_sums.resize(body.tiling.tiles.size());
  out.border_sums.resize(out.bordered.size());
  return out;
}

void set_vector(Field& f, std::ptrdiff_t x, int stride, Vec3 v) {
  f[x] = v.x;
  f[x + stride] = v.y;
  f[x + 2 * stride] = v.z;
}

// visit(block, node, station, index of x, stride)
template <class Visit>
void each_node(const Body& body, Visit&& visit) {
  for (int b = 0; b < static_cast<int>(body.layout.blocks.size()); ++b) {
    const BlockLayout& l = body.layout.blocks[b];
    for (int n = 0; n < l.nodes; ++n)
      for (int j = 0; j < l.stations; ++j) visit(b, n, j, l.line(n, 0) + j, l.stride);
  }
}

}  // namespace

RollingBody::RollingBody(const Body& body_, const ContactSurface& surface_, MassScaling& scaling_,
                         const ReferenceFrame& frame_, TileCut cut_)
    : body(body_),
      surface(surface_),
      scaling(scaling_),
      cut(std::move(cut_)),
      frame(frame_),
      elements(body_),
      schedule(schedule_of(body_, surface_, scaling_)) {
  for (const Block& b : body.mesh.blocks) {
    cos_node.emplace_back();
    sin_node.emplace_back();
    for (double t : b.stations.at) {
      cos_node.back().push_back(turns() ? std::cos(t) : 1.0);
      sin_node.back().push_back(turns() ? std::sin(t) : 0.0);
    }
  }
  if (!turns()) return;
  for (const NodeLine& l : body.lines) {
    if (l.component != 0) continue;
    const double z = line_radius(body, l.block, l.node);
    for (int j = 0; j < l.count; ++j) {
      free_mass += body.mass[l.first + j];
      free_inertia += body.mass[l.first + j] * z * z;
    }
  }
}

Vec3 RollingBody::arm(int block, int node, int station) const {
  if (!turns()) return {};
  const double radius = line_radius(body, block, node);
  return {-radius * sin_node[block][station], 0, radius * cos_node[block][station]};
}

void chain_tiles(RollingBody& b, bool sums_wanted) {
  constexpr int kChainsPerThread = 6, kSingleTiles = std::numeric_limits<int>::max();
  UpdateSchedule& schedule = b.schedule;
  const int wanted = sums_wanted ? kSingleTiles : kChainsPerThread * max_threads();
  if (wanted == schedule.chains_wanted) return;
  schedule.chains_wanted = wanted;
  schedule.chains = chains(b.body.tiling, wanted, b.cut, std::move(schedule.chains));
  schedule.own.clear();
  for (std::size_t k = 0; k < schedule.chains.size(); ++k)
    if (b.cut.is_own(schedule.chains[k].first_tile)) schedule.own.push_back(static_cast<int>(k));
  schedule.chain_sums.assign(schedule.chains.size(), {});
  schedule.plane_sums.assign(schedule.chains.size(), {});
}

const Field& surface_displacement(RollingBody& b, const BodyState& state) {
  if (!b.turns()) return state.u;
  const ContactSurface& surface = b.surface;
  const int block = b.body.mesh.contact.block, stations = surface.stations.nodes();
  const double* cosine = b.cos_node[block].data();
  const double* sine = b.sin_node[block].data();
  for_each(surface.columns, [&](std::ptrdiff_t column) {
    const std::ptrdiff_t x = surface.index(static_cast<int>(column), 0);
    const double radius = surface.node[column].z;
    for (int j = 0; j < stations; ++j)
      set_vector(b.surface_u, x + j, surface.stride,
                 own_displacement(b.frame, radius, cosine[j], sine[j], vector_at(state.u, x + j, surface.stride)));
  });
  return b.surface_u;
}

Field model_displacement(const RollingBody& b, const BodyState& state) {
  if (!b.turns()) return state.u;
  Field out = b.body.layout.field();
  each_node(b.body, [&](int block, int node, int station, std::ptrdiff_t x, int stride) {
    const Vec3 arm = b.arm(block, node, station), across{0, b.body.mesh.blocks[block].section.nodes[node].y, 0};
    const Vec3 turned = b.frame.travel() + b.frame.to_model(arm + vector_at(state.u, x, stride)) - arm;
    set_vector(out, x, stride, turned + yaw_displacement(b.frame.yaw_turn, across));
  });
  return out;
}

Field yawed_displacement(const Body& body, const Rotation<double>& yaw_turn, const Field& u) {
  assert(u.size() == static_cast<std::size_t>(body.layout.size));
  Field out = u;
  if (yaw_turn.s == 0) return out;
  each_node(body, [&](int block, int node, int station, std::ptrdiff_t x, int stride) {
    const Vec3 arm = reference_position(body, block, node, station) - body.mesh.origin;
    set_vector(out, x, stride, yaw(yaw_turn, vector_at(u, x, stride)) + yaw_displacement(yaw_turn, arm));
  });
  return out;
}

const Field& frame_velocity(RollingBody& b, const BodyState& state, bool before) {
  if (b.scaling.empty() || !b.turns()) return state.v;
  b.velocity.assign(state.v.size(), 0.0);
  each_node(b.body, [&](int block, int node, int station, std::ptrdiff_t x, int stride) {
    const Vec3 w = vector_at(state.v, x, stride) + b.frame.rigid_rate(b.arm(block, node, station));
    set_vector(b.velocity, x, stride, before ? b.frame.step_back(w) : w);
  });
  return b.velocity;
}

void start_velocities(const RollingBody& b, double rate, BodyState& state) {
  for (const NodeLine& l : b.body.lines) {
    const Block& block = b.body.mesh.blocks[l.block];
    for (int j = 0; j < l.count; ++j)
      state.v[l.first + j] = -rate * station_derivative(block, l.count, j, [&](int k) { return state.u[l.first + k]; });
  }
}

void add_rigid_motion(const RollingBody& b, const StartMotion& beyond, BodyState& state) {
  if (beyond.spin == 0 && beyond.lateral_speed == 0) return;
  const Vec3 aside = b.frame.to_frame({0, beyond.lateral_speed, 0});
  for (const NodeLine& l : b.body.lines)
    for (int j = 0; j < l.count; ++j) {
      const Vec3 arm = b.arm(l.block, l.node, j);
      const Vec3 v = aside + spun(beyond.spin, arm);
      state.v[l.first + j] += l.component == 0 ? v.x : l.component == 1 ? v.y : v.z;
    }
}

MeanMotion mean_motion(const RollingBody& b, const UpdateSums& sums) {
  return b.turns() ? mean_motion(b.frame, sums, b.free_mass, b.free_inertia) : MeanMotion{};
}

MeanMotion mean_motion(const RollingBody& b, const BodyState& state) {
  if (!b.turns()) return {};
  UpdateSums all;
  for (const NodeLine& l : b.body.lines) {
    if (l.component == 1) continue;
    const double z = line_radius(b.body, l.block, l.node);
    const std::vector<double>& turn = (l.component == 0 ? b.cos_node : b.sin_node)[l.block];
    for (int j = 0; j < l.count; ++j) {
      const double m = b.body.mass[l.first + j], w = state.v[l.first + j];
      (l.component == 0 ? all.momentum_x : all.momentum_z) += m * w;
      all.angular += m * z * turn[j] * w;
    }
  }
  return mean_motion(b, all);
}

double add_weight_moment(const RollingBody& b, const BodyState& state, double sum) {
  for (const NodeLine& l : b.body.lines) {
    if (!b.turns()) {
      if (l.component != 2) continue;
      for (int j = 0; j < l.count; ++j) sum += b.body.mass[l.first + j] * state.u[l.first + j];
      continue;
    }
    if (l.component == 1) continue;
    const double z = line_radius(b.body, l.block, l.node);
    for (int j = 0; j < l.count; ++j) {
      const double arm = l.component == 0 ? -z * b.sin_node[l.block][j] : z * b.cos_node[l.block][j];
      const double at = arm + state.u[l.first + j];
      sum += b.body.mass[l.first + j] * (l.component == 0 ? -b.frame.turn.s * at : b.frame.turn.c * at - arm);
    }
  }
  return sum;
}

}  // namespace railstrata
