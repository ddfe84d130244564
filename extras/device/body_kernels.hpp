#pragma once
// Kernels of a step for the forces and displacements of whole lines: ties, added mass, the ends of the rail, the bore.
#include "core/rotation.hpp"
#include "core/sweep_kind.hpp"
#include "device/memory.hpp"
#include "device/records.hpp"
#include "device/step_state.hpp"

namespace railstrata::device {

/// Interpolation between stations of two blocks, and its transpose (body/ties.hpp).
struct TieTables {
  View<const TieRecord> ties;
  View<const int> left, right;
  View<const double> weight;
  View<const int> first, from;
  View<const double> share, delta_x, delta_z;
};

/// The three components of a node: `x` of the first, the others `stride` and twice that behind it.
RAILSTRATA_POINTWISE Vec3 gather(const View<const double>& values, std::ptrdiff_t x, std::ptrdiff_t stride) {
  return {values[x], values[x + stride], values[x + 2 * stride]};
}

/// Component, piece and station behind an index that counts components, then lanes of pieces.
struct Place {
  int component, record, station;
  bool held;  ///< the lane has a station
  RAILSTRATA_POINTWISE Place(View<const Piece> pieces, std::ptrdiff_t i) {
    const std::ptrdiff_t lanes = pieces.size() * kLanes;
    const Piece piece = pieces[i % lanes / kLanes];
    const int lane = static_cast<int>(i % kLanes);
    component = static_cast<int>(i / lanes);
    record = piece.record;
    station = piece.first + lane;
    held = lane < piece.count;
  }
};

/// Displacements of the slaves of one level; index: component, then lanes of pieces.
template <SweepKind kind>
struct ApplyTies {
  TieTables tables;
  View<const Piece> pieces;
  View<const StepState> now;
  View<double> u;

  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const {
    const Place place(pieces, i);
    if (!place.held) return;
    const int component = place.component, j = place.station;
    const TieRecord& t = tables.ties[place.record];
    const std::ptrdiff_t line = static_cast<std::ptrdiff_t>(component) * t.master_stride;
    const auto carried = [&](int station) {
      return (1 - t.weight1) * u[t.master0 + line + station] + t.weight1 * u[t.master1 + line + station];
    };
    const double a = carried(tables.left[t.between + j]), b = carried(tables.right[t.between + j]);
    double value = a + tables.weight[t.between + j] * (b - a);
    const double dx = tables.delta_x[t.delta + j], dz = tables.delta_z[t.delta + j];
    const Rotation<double> turn = now[0].turn_of_body<kind>();
    if (component == 0) value += (turn.c - 1) * dx + turn.s * dz;
    if (component == 2) value += (turn.c - 1) * dz - turn.s * dx;
    u[t.slave + static_cast<std::ptrdiff_t>(component) * t.slave_stride + j] = value;
  }
};

/// Forces of the slaves of one level to their masters: an index for every component of every lane of the masters.
struct GatherTies {
  TieTables tables;
  View<const MasterRecord> masters;
  View<const TieShare> shares;
  View<const Piece> pieces;
  View<double> f;

  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const {
    const Place place(pieces, i);
    if (!place.held) return;
    const int component = place.component, j = place.station;
    const MasterRecord& m = masters[place.record];
    double& at = f[m.x + static_cast<std::ptrdiff_t>(component) * m.stride + j];
    double sum = at;
    for (int s = m.first_share; s < m.first_share + m.shares; ++s) {
      const TieRecord& t = tables.ties[shares[s].tie];
      const std::ptrdiff_t slave = t.slave + static_cast<std::ptrdiff_t>(component) * t.slave_stride;
      double gathered = 0;
      for (int k = tables.first[t.share_first + j]; k < tables.first[t.share_first + j + 1]; ++k)
        gathered += tables.share[k] * f[slave + tables.from[k]];
      sum += shares[s].weight * gathered;
    }
    at = sum;
  }
};

/// Moments of the slaves' offsets on the body's rotation [N m], one number a lane; clears the slaves' forces.
template <SweepKind kind>
struct ClearTies {
  TieTables tables;
  View<const Piece> pieces;
  View<const StepState> now;
  View<double> f, moments;

  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const {
    const Piece piece = pieces[i / kLanes];
    const TieRecord& t = tables.ties[piece.record];
    const int lane = static_cast<int>(i % kLanes), j = piece.first + lane;
    double moment = 0;
    if (lane < piece.count) {
      const std::ptrdiff_t x = t.slave + j, y = x + t.slave_stride, z = y + t.slave_stride;
      if constexpr (kind == SweepKind::revolve) {
        const Rotation<double> turn = now[0].turn;
        const double dx = tables.delta_x[t.delta + j], dz = tables.delta_z[t.delta + j];
        moment = f[x] * (turn.c * dz - turn.s * dx) - f[z] * (turn.c * dx + turn.s * dz);
      }
      f[x] = f[y] = f[z] = 0;
    }
    moments[i] = moment;
  }
};

/// Added mass (body/mass_scaling.hpp).
struct ChainTables {
  View<const ChainRecord> chains;
  View<const ChainNode> nodes;
  View<const double> forward, pivot, backward, response;
};

/// f <- M (M + A)^-1 f on the chains; index: component, then lanes of pieces.
struct ScaleForces {
  ChainTables tables;
  View<const Piece> pieces;
  View<double> f;

  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const {
    const Place place(pieces, i);
    if (!place.held) return;
    const int component = place.component, j = place.station;
    const ChainRecord& c = tables.chains[place.record];
    const auto at = [&](int k) -> double& {
      return f[tables.nodes[c.first_node + k].x + static_cast<std::ptrdiff_t>(component) * c.stride + j];
    };
    const auto factor = [&](int k) { return c.factor + static_cast<std::ptrdiff_t>(k) * c.stations + j; };
    const int last = c.nodes - 1;
    for (int k = 0; k < last; ++k) at(k + 1) += tables.forward[factor(k)] * at(k);
    at(last) *= tables.pivot[factor(last)];
    for (int k = last - 1; k >= 0; --k)
      at(k) = tables.pivot[factor(k)] * at(k) + tables.backward[factor(k)] * at(k + 1);
  }
};

/// Velocity of a node of a chain, of the half step before or after, in the components of this step's frame
/// (frame_velocity in fem/rolling_body.hpp).
template <SweepKind kind, bool before>
RAILSTRATA_POINTWISE Vec3 chain_velocity(const ReferenceFrame& frame, const View<const double>& v, const ChainNode& n,
                                         int stride, int station, double cosine, double sine) {
  const Vec3 w = gather(v, n.x + station, stride);
  if constexpr (kind == SweepKind::extrude) return w;
  const Vec3 arm{-n.radius * sine, 0, n.radius * cosine}, moving = w + frame.rigid_rate(arm);
  return before ? frame.step_back(moving) : moving;
}

/// Kinetic energy of the added mass, 1/2 v A w from the half steps before and after a step. before: leaves the
/// differences of v across the edges; else: a number a lane from those and w.
template <SweepKind kind, bool before>
struct ChainEnergy {
  ChainTables tables;
  View<const Piece> pieces;
  View<const double> added, cos_node, sin_node, v;
  View<const StepState> now;
  View<double> differences;  ///< [edge][component][station], three times the factors' index
  View<double> kinetic;

  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const {
    const Piece piece = pieces[i / kLanes];
    const ChainRecord& c = tables.chains[piece.record];
    const int lane = static_cast<int>(i % kLanes), j = piece.first + lane;
    double sum = 0;
    if (lane < piece.count) {
      const double cosine = cos_node[c.stations_at + j], sine = sin_node[c.stations_at + j];
      const auto velocity = [&](int k) {
        return chain_velocity<kind, before>(now[0].nodes<kind>().frame, v, tables.nodes[c.first_node + k], c.stride, j,
                                            cosine, sine);
      };
      Vec3 here = velocity(0);
      for (int k = 0; k + 1 < c.nodes; ++k) {
        const Vec3 below = velocity(k + 1), difference = here - below;
        const std::ptrdiff_t factor = c.factor + static_cast<std::ptrdiff_t>(k) * c.stations;
        const std::ptrdiff_t at = 3 * factor + j;
        if constexpr (before) {
          differences[at] = difference.x;
          differences[at + c.stations] = difference.y;
          differences[at + 2 * static_cast<std::ptrdiff_t>(c.stations)] = difference.z;
        } else {
          sum += 0.5 * added[factor + j] * dot(gather(differences, at, c.stations), difference);
        }
        here = below;
      }
    }
    if constexpr (!before) kinetic[i] = sum;
  }
};

/// Absorbers at the ends of the rail; the power that each takes [W].
struct AbsorbAtEnds {
  View<const EndDashpotRecord> dashpots;
  View<const double> v;
  View<double> f, power;

  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const {
    const EndDashpotRecord& d = dashpots[i];
    const double speed = v[d.index];
    f[d.index] += d.coefficient * speed;
    power[i] = d.coefficient * speed * speed;
  }
};

/// Support of the rail beyond its ends.
struct HoldEnds {
  View<const EndLoadRecord> loads;
  View<double> f;
  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const { f[loads[i].index] -= loads[i].force; }
};

/// J, that these forces have done.
struct EndWork {
  View<const EndLoadRecord> loads;
  View<const double> u;
  View<double> work;
  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const { work[i] = loads[i].force * u[loads[i].index]; }
};

/// Loads of the bore's nodes on the axle, by node: force x, y, z and moment, the wheel's frame.
struct BoreForces {
  View<const BoreRecord> bore;
  View<const double> f;
  View<const StepState> now;
  View<double> loads;  ///< [4][node]

  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const {
    const BoreRecord& n = bore[i];
    const Vec3 given = -gather(f, n.x, n.stride);
    const PlaneVector<double> r = now[0].turn.forward(n.arm_x, n.arm_z);
    const double all[4] = {given.x, given.y, given.z, r.z * given.x - r.x * given.z};
    for (int k = 0; k < 4; ++k) loads[k * bore.size() + i] = all[k];
  }
};

/// The bore moves with the axle.
struct MoveBore {
  View<const BoreRecord> bore;
  View<const StepState> now;
  View<double> u;

  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const {
    const BoreRecord& n = bore[i];
    const AxlePose& pose = now[0].in_frame;
    const PlaneVector<double> shift = rigid_displacement({pose.x, pose.z}, now[0].turn, {n.arm_x, n.arm_z});
    u[n.x] = shift.x;
    u[n.x + n.stride] = pose.y;
    u[n.x + 2 * static_cast<std::ptrdiff_t>(n.stride)] = shift.z;
  }
};

}  // namespace railstrata::device
