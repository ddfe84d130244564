#pragma once
// The laws of contact/enforcement.hpp at one row, pointwise: compiled for the sweeps of the processor and for the
// threads of a device.
#include <algorithm>
#include <cmath>

#include "core/simd.hpp"
#include "core/vec.hpp"
#include "friction/friction_memory.hpp"
#include "friction/friction_step.hpp"

namespace railstrata {

/// State of a rail node's contact, kept from step to step: traction on the rail in the node's own frame (normal into
/// the rail, rolling direction, lateral) and slip velocity.
struct NodeTraction {
  double p = 0, q1 = 0, q2 = 0;  ///< Pa
  double slip1 = 0, slip2 = 0;   ///< m/s, wheel relative to rail, mean of the step; without a film's elastic shear
  double plastic = 0;            ///< m, path of plastic shear of a film
  double lost_friction = 0;      ///< share of the coefficient at rest that slip has taken (friction_memory.hpp)
  double mean_slip1 = 0, mean_slip2 = 0;   ///< m/s, as a falling law sees it (EnforcementOptions::slip_time)
  long stuck = kPause;                     ///< steps since the law last let it slip, up to kPause
  double contact_time = 0, slip_time = 0;  ///< s, in contact and slipping since it came near the patch
  double friction_work = 0;                ///< J/m², of q over the slip since the start, that of a step its mean
  double pressed_slip = 0;  ///< J/m², of p over the path of its slips since the start: what Archard's wear goes with

  /// In the fastest vibration of a mesh, three to four steps of central differences long, the pressure of a sliding
  /// node rises so fast that it sticks for a step or two: such a pause is not the end of its slip.
  static constexpr long kPause = 4;
  RAILSTRATA_POINTWISE bool slips() const { return p > 0 && stuck < kPause; }
};

/// A node that left the neighbourhood of the patch: only the history in its state is kept.
RAILSTRATA_POINTWISE NodeTraction apart(const NodeTraction& t) {
  NodeTraction out;
  out.contact_time = t.contact_time;
  out.slip_time = t.slip_time;
  out.friction_work = t.friction_work;
  out.pressed_slip = t.pressed_slip;
  return out;
}

/// Unit vectors of the contact plane at a rail node with the normal n: t1 upright in the plane of rolling; of a
/// straight rail, n_x = 0, along x.
struct TangentFrame {
  Vec3 t1, t2;
};
RAILSTRATA_POINTWISE TangentFrame tangent_frame(Vec3 n) {
  if (n.x == 0) return {{1, 0, 0}, {0, n.z, -n.y}};
  const double length = std::sqrt(n.x * n.x + n.z * n.z);
  const Vec3 along{n.z / length, 0, -n.x / length};
  return {along, cross(n, along)};
}

/// Traction on the rail as a vector in the model frame.
RAILSTRATA_POINTWISE Vec3 traction_vector(const NodeTraction& t, Vec3 n) {
  const TangentFrame f = tangent_frame(n);
  return -t.p * n + t.q1 * f.t1 + t.q2 * f.t2;
}

/// Values that all rows of a step share.
struct RowLaw {
  FrictionLaws friction;
  double dt = 0;      ///< s
  double film = 0;    ///< (m/s)/Pa that an elastic film yields
  double newest = 1;  ///< share of the step in the mean slip velocity
};

/// State of a row before the step; used only where there is a film.
struct RowStart {
  double q1 = 0, q2 = 0, plastic = 0;
};
RAILSTRATA_POINTWISE RowStart row_start(const NodeTraction& t) { return {t.q1, t.q2, t.plastic}; }

/// Brings the tangential traction of t back to what the laws let it carry, where it yields `compliance` per traction;
/// true where it slips.
RAILSTRATA_POINTWISE bool return_to_friction(const RowLaw& law, double compliance, double plastic_before,
                                             NodeTraction& t) {
  const FrictionStep step{t.p, compliance, law.dt, plastic_before, t.lost_friction};
  const FrictionReturn back = return_to_law(law.friction, step, t.q1, t.q2);
  t.plastic = back.plastic;
  return back.slips;
}

/// Changes by one relaxation of a row.
struct RowChange {
  bool acts = false, slips = false;
  Vec3 traction;  ///< Pa, on the rail
};

/// The traction that leaves the row neither a closing velocity nor a slip below friction's bound, at the relative
/// velocity w with the present one; diagonal: velocity per unit traction.
RAILSTRATA_POINTWISE RowChange relax_row(const RowLaw& law, double gap, Vec3 normal, double diagonal, Vec3 w,
                                         const RowStart& start, NodeTraction& t) {
  const double closing = -gap / law.dt - dot(w, normal);  // what the pressure must still take away
  if (t.p == 0 && closing <= 0) return {};
  const TangentFrame f = tangent_frame(normal);
  NodeTraction next = t;
  next.p = std::max(0.0, t.p + closing / diagonal);
  const double yields = diagonal + law.film;
  next.q1 += (dot(w, f.t1) - law.film * (t.q1 - start.q1)) / yields;
  next.q2 += (dot(w, f.t2) - law.film * (t.q2 - start.q2)) / yields;
  RowChange out{true, return_to_friction(law, yields, start.plastic, next), {}};
  NodeTraction step = next;  // what this sweep changes
  step.p -= t.p;
  step.q1 -= t.q1;
  step.q2 -= t.q2;
  out.traction = traction_vector(step, normal);
  t = next;
  return out;
}

/// Slip and what goes with it, at the relative velocity w after the step; slips: the law's verdict.
RAILSTRATA_POINTWISE void record_row(const RowLaw& law, Vec3 normal, Vec3 w, const RowStart& start, bool slips,
                                     NodeTraction& t) {
  const TangentFrame f = tangent_frame(normal);
  t.slip1 = dot(w, f.t1) - law.film * (t.q1 - start.q1);
  t.slip2 = dot(w, f.t2) - law.film * (t.q2 - start.q2);
  if (t.p <= 0) {
    t.stuck = NodeTraction::kPause;
    t.plastic = t.lost_friction = t.mean_slip1 = t.mean_slip2 = 0;
    return;
  }
  t.stuck = slips ? 0 : t.stuck < NodeTraction::kPause ? t.stuck + 1 : NodeTraction::kPause;
  if (law.friction.falling.falls()) {
    t.mean_slip1 += law.newest * (t.slip1 - t.mean_slip1);
    t.mean_slip2 += law.newest * (t.slip2 - t.mean_slip2);
    t.lost_friction = lost_after(law.friction.falling, t.lost_friction, std::hypot(t.mean_slip1, t.mean_slip2), law.dt);
  }
  t.contact_time += law.dt;
  if (slips) t.pressed_slip += law.dt * t.p * std::hypot(t.slip1, t.slip2);
  if (t.slips()) t.slip_time += law.dt;
}

/// W, lost at a row; slip: mean of the step, wheel against rail.
struct RowLosses {
  double normal = 0, friction = 0;
};
RAILSTRATA_POINTWISE RowLosses row_losses(double area, Vec3 normal, Vec3 force_on_rail, double p, Vec3 slip) {
  const double pressed = area * p * dot(slip, normal);
  return {-pressed, dot(force_on_rail, slip) + pressed};
}

}  // namespace railstrata
