#pragma once
// Internal forces of a body in two kernels. Every element leaves what it adds to its corners in rows of its own; then
// every node at every station adds up the rows of the elements around it, in the order of the body's sweep plan. So no
// two threads add to one number, and the sums have one order.
#include "core/rotation.hpp"
#include "device/memory.hpp"
#include "device/records.hpp"
#include "device/step_state.hpp"
#include "element/swept_hex.hpp"
#include "fem/node_law.hpp"
#include "material/plastic.hpp"

namespace railstrata::device {

/// By element: StationScale; Q of the element class.
template <class Real>
struct StationTables {
  View<const Real> inv_sigma, inv_c, sigma_c, sigma, c;
  View<const double> cos_q, sin_q;
  RAILSTRATA_POINTWISE StationScale<Real> scale(int k) const {
    return {inv_sigma[k], inv_c[k], sigma_c[k], sigma[k], c[k]};
  }
};

/// Displacements at a corner's two ends as sum and difference, in the carried frame (body/scratch_rows.hpp).
template <SweepKind kind, class Real>
RAILSTRATA_POINTWISE void corner_ends(const View<const double>& u, std::ptrdiff_t x, int stride, int front, int behind,
                                      const Rotation<double>& frame, int component, Real& sum, Real& difference) {
  if (kind == SweepKind::extrude || component == 1) {
    const std::ptrdiff_t line = x + static_cast<std::ptrdiff_t>(component) * stride;
    sum = static_cast<Real>(u[line + behind] + u[line + front]);
    difference = static_cast<Real>(u[line + behind] - u[line + front]);
    return;
  }
  const std::ptrdiff_t z = x + 2 * static_cast<std::ptrdiff_t>(stride);
  const double a = u[x + behind] + u[x + front], b = u[z + behind] + u[z + front];
  const double da = u[x + behind] - u[x + front], db = u[z + behind] - u[z + front];
  const PlaneVector<double> both = frame.forward(a, b), apart = frame.forward(da, db);
  sum = static_cast<Real>(component == 0 ? both.x : both.z);
  difference = static_cast<Real>(component == 0 ? apart.x : apart.z);
}

/// Where the hourglass stiffness of an element begins.
RAILSTRATA_POINTWISE std::ptrdiff_t hourglass_table(const QuadRecord& q, const View<const int>& classes, int e) {
  constexpr int kGroup = 8;  // elements that share one: kHourglassGroup
  const std::ptrdiff_t table =
      q.hourglass + static_cast<std::ptrdiff_t>(classes[q.groups_at + e / kGroup]) * q.hourglass_step;
  return table * kHourglassEntries;
}

/// f of the elements at displacement u: an index for every lane of every piece.
template <SweepKind kind, class Real>
struct ElementForces {
  View<const Piece> pieces;
  View<const QuadRecord> quads;
  View<const HexReference<Real>> references;
  View<const Real> hourglass;  ///< [table][kHourglassEntries]
  View<const int> classes;     ///< per group of elements
  View<const Real> eigenstress;
  StationTables<Real> at;
  View<const double> u;
  View<const StepState> now;
  View<Real> rows;

  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const {
    const Rotation<double> turn = now[0].turn_of_body<kind>();
    const Piece piece = pieces[i / kLanes];
    const QuadRecord& q = quads[piece.record];
    const int lane = static_cast<int>(i % kLanes), e = piece.first + lane;
    if (lane >= piece.count) return;
    const int k = q.stations_at + e;
    const StationScale<Real> scale = at.scale(k);
    Rotation<double> frame;
    if constexpr (kind == SweepKind::revolve) frame = Rotation<double>{at.cos_q[k], at.sin_q[k]}.minus(turn);
    const int behind = e + 1 < q.stations ? e + 1 : 0;
    const auto corner = [&](int c, int component, Real& sum, Real& difference) {
      corner_ends<kind>(u, q.corner[c], q.stride, e, behind, frame, component, sum, difference);
    };
    const std::ptrdiff_t table = hourglass_table(q, classes, e);
    const auto eigen = [&](int n) { return eigenstress[q.eigenstress + n]; };
    const auto hourglass_of = [&](ElementKinematics<Real>& kin) {
      hourglass_forces([&](int n) { return hourglass[table + n]; }, kin);
      if (q.eigenstress < 0) return;
      for (int n = 0; n < 3; ++n) {
        kin.even[n] -= eigen(6 + n);
        for (int m = 0; m < 3; ++m) kin.odd[m][n] -= eigen(9 + 3 * m + n);
      }
    };
    const auto leave = [&](int c, int component, auto&& add) {
      Real sum = 0, difference = 0;
      add(sum, difference);
      const std::ptrdiff_t row = q.rows + (static_cast<std::ptrdiff_t>(6) * c + component) * q.row_stride + e;
      rows[row] = sum;
      rows[row + 3 * static_cast<std::ptrdiff_t>(q.row_stride)] = difference;
    };
    const auto relieve = [&](Real(&s)[6]) {
      if (q.eigenstress < 0) return;
      for (int n = 0; n < 6; ++n) s[n] -= eigen(n);
    };
    const Rotation<Real> turned{static_cast<Real>(turn.c), static_cast<Real>(turn.s)};
    hex_forces<kind, Evaluation::finite>(references[q.reference], scale, turned, corner, hourglass_of, leave, relieve);
  }
};

/// Strain and hourglass energy of every lane, from tables in double precision: energies [2][lane].
template <SweepKind kind>
struct ElementEnergies {
  View<const Piece> pieces;
  View<const QuadRecord> quads;
  View<const HexReference<double>> references;
  View<const double> hourglass;
  View<const int> classes;
  View<const double> eigenstress;
  StationTables<double> at;
  View<const double> u;
  View<const StepState> now;
  View<double> energies;

  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const {
    const Piece piece = pieces[i / kLanes];
    const int lane = static_cast<int>(i % kLanes);
    double strain = 0, stored = 0;
    if (lane < piece.count) of_element(quads[piece.record], piece.first + lane, strain, stored);
    energies[i] = strain;
    energies[pieces.size() * kLanes + i] = stored;
  }

 private:
  RAILSTRATA_POINTWISE void of_element(const QuadRecord& q, int e, double& strain, double& stored) const {
    const int k = q.stations_at + e, behind = e + 1 < q.stations ? e + 1 : 0;
    const StationScale<double> scale = at.scale(k);
    const Rotation<double> turn = now[0].turn_of_body<kind>();
    Rotation<double> frame;
    if constexpr (kind == SweepKind::revolve) frame = Rotation<double>{at.cos_q[k], at.sin_q[k]}.minus(turn);
    const auto& reference = references[q.reference];
    const auto corner = [&](int c, int component, double& sum, double& difference) {
      corner_ends<kind>(u, q.corner[c], q.stride, e, behind, frame, component, sum, difference);
    };
    auto kin = element_kinematics<kind, double>(reference.shape, scale, corner);
    const auto stress = hex_stress<kind, double>(reference, turn, kin);
    const std::ptrdiff_t table = hourglass_table(q, classes, e);
    stored = hourglass_forces([&](int n) { return hourglass[table + n]; }, kin);
    const double volume = reference.shape.volume * scale.sigma_c;
    strain = 0.5 * volume * double_contraction(stress.strain, stress.s);
    if (q.eigenstress >= 0)  // the initial stress
      strain -= volume * double_contraction(stress.strain, &eigenstress[q.eigenstress]);
  }
};

/// The complete internal forces on the nodes. Nodes that wait for nothing are updated at once (fem/stepper.hpp): their
/// displacements and velocities move on; the forces on the others go to f. updates false: all forces go to f.
template <SweepKind kind, class Real, bool updates, bool measured>
struct NodeForces {
  View<const Piece> pieces;
  View<const NodeRecord> nodes;
  View<const std::ptrdiff_t> corners;  ///< first row of the corner
  View<const double> cos_q, sin_q;
  View<const StepState> now;
  View<const Real> rows;
  View<double> f;
  // of an update
  View<const double> inverse_mass, cos_node, sin_node;
  View<double> u, v;
  View<double> sums;  ///< [of UpdateSums][index]

  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const {
    const Piece piece = pieces[i / kLanes];
    const NodeRecord& n = nodes[piece.record];
    const int lane = static_cast<int>(i % kLanes), j = piece.first + lane;
    UpdateSums added;
    if (lane < piece.count) {
      double force[3];
      complete(n, j, force);
      if (updates && n.at_once && (n.closed || (j > 0 && j + 1 < n.stations)))
        update(n, j, force, added);
      else
        for (int k = 0; k < 3; ++k) f[n.x + static_cast<std::ptrdiff_t>(k) * n.stride + j] = force[k];
    }
    if constexpr (measured) {
      const std::ptrdiff_t each = pieces.size() * kLanes;
      const double all[5] = {added.kinetic, added.damping, added.momentum_x, added.momentum_z, added.angular};
      for (int k = 0; k < 5; ++k) sums[k * each + i] = all[k];
    }
  }

 private:
  RAILSTRATA_POINTWISE void complete(const NodeRecord& n, int j, double (&force)[3]) const {
    for (double& x : force) x = 0;
    if (j < n.elements) add_element(n, j, -1, force);
    if (j > 0)
      add_element(n, j - 1, 1, force);
    else if (n.closed)
      add_element(n, n.elements - 1, 1, force);
  }
  // side: -1 of an element in front of the node, s - d; 1 of one behind it, s + d
  RAILSTRATA_POINTWISE void add_element(const NodeRecord& n, int e, int side, double (&force)[3]) const {
    Real s[3] = {}, d[3] = {};
    for (int k = n.first_corner; k < n.first_corner + n.corners; ++k)
      for (int i = 0; i < 3; ++i) {
        const std::ptrdiff_t row = corners[k] + static_cast<std::ptrdiff_t>(i) * n.row_stride + e;
        s[i] += rows[row];
        d[i] += rows[row + 3 * static_cast<std::ptrdiff_t>(n.row_stride)];
      }
    double carried[3];
    for (int i = 0; i < 3; ++i) carried[i] = side < 0 ? s[i] - d[i] : s[i] + d[i];
    force[1] += carried[1];
    if constexpr (kind == SweepKind::revolve) {
      const Rotation<double> own{cos_q[n.stations_at + e], sin_q[n.stations_at + e]};
      const PlaneVector<double> model = own.minus(now[0].turn).back(carried[0], carried[2]);
      force[0] += model.x;
      force[2] += model.z;
    } else {
      force[0] += carried[0];
      force[2] += carried[2];
    }
  }
  RAILSTRATA_POINTWISE void update(const NodeRecord& n, int j, const double (&force)[3], UpdateSums& added) const {
    const std::ptrdiff_t x = n.x + j, y = x + n.stride, z = y + n.stride;
    advance_node<kind, measured>(now[0].nodes<kind>(), inverse_mass[x], n.radius, cos_node[n.stations_at + j],
                                 sin_node[n.stations_at + j], force[0], force[1], force[2], u[x], u[y], u[z], v[x],
                                 v[y], v[z], added);
  }
};

/// The nodes that waited for the contact, from f; sums as of NodeForces.
template <SweepKind kind, bool measured>
struct WaitingNodes {
  View<const Piece> pieces;
  View<const NodeRecord> nodes;
  View<const double> f, inverse_mass, cos_node, sin_node;
  View<const StepState> now;
  View<double> u, v, sums;

  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const {
    const Piece piece = pieces[i / kLanes];
    const NodeRecord& n = nodes[piece.record];
    const int lane = static_cast<int>(i % kLanes), j = piece.first + lane;
    UpdateSums added;
    if (lane < piece.count) {
      const std::ptrdiff_t x = n.x + j, y = x + n.stride, z = y + n.stride;
      advance_node<kind, measured>(now[0].nodes<kind>(), inverse_mass[x], n.radius, cos_node[n.stations_at + j],
                                   sin_node[n.stations_at + j], f[x], f[y], f[z], u[x], u[y], u[z], v[x], v[y], v[z],
                                   added);
    }
    if constexpr (measured) {
      const std::ptrdiff_t each = pieces.size() * kLanes;
      const double all[5] = {added.kinetic, added.damping, added.momentum_x, added.momentum_z, added.angular};
      for (int k = 0; k < 5; ++k) sums[k * each + i] = all[k];
    }
  }
};

/// Mass times height above the undeformed body, a number a lane (add_weight_moment in fem/rolling_body.hpp).
template <SweepKind kind>
struct NodeHeights {
  View<const Piece> pieces;
  View<const NodeRecord> nodes;
  View<const double> mass, cos_node, sin_node, u;
  View<const StepState> now;
  View<double> moments;

  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const {
    const Piece piece = pieces[i / kLanes];
    const NodeRecord& n = nodes[piece.record];
    const int lane = static_cast<int>(i % kLanes), j = piece.first + lane;
    double moment = 0;
    if (lane < piece.count) {
      const std::ptrdiff_t x = n.x + j, z = x + 2 * static_cast<std::ptrdiff_t>(n.stride);
      if constexpr (kind == SweepKind::extrude) {
        moment = mass[z] * u[z];
      } else {
        const double ax = -n.radius * sin_node[n.stations_at + j], az = n.radius * cos_node[n.stations_at + j];
        const Rotation<double> turn = now[0].wheel.frame.turn;
        moment = mass[x] * (-turn.s * (ax + u[x])) + mass[z] * (turn.c * (az + u[z]) - az);
      }
    }
    moments[i] = moment;
  }
};

/// One level of a tree of fixed shape: out[k * pieces + p] is the sum of in[k * count + p], + pieces, + 2 pieces … so
/// that neighbouring threads read neighbouring numbers.
struct SumLevel {
  View<const double> in;
  View<double> out;
  std::ptrdiff_t count, pieces;
  RAILSTRATA_POINTWISE void operator()(std::ptrdiff_t i) const {
    const std::ptrdiff_t sum = i / pieces, first = i % pieces;
    double total = 0;
    for (std::ptrdiff_t k = first; k < count; k += pieces) total += in[sum * count + k];
    out[i] = total;
  }
};

}  // namespace railstrata::device
