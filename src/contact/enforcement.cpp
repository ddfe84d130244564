#include "contact/enforcement.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace railstrata {

void WheelNumbering::number(const MortarRows& rows, const ContactSurface& wheel, ContactSystem& system) {
  const std::ptrdiff_t node_stride = static_cast<std::ptrdiff_t>(wheel.stride) * 3;
  mark_.resize(static_cast<std::size_t>(wheel.columns) * wheel.stride, -1);
  auto slot = [&](std::ptrdiff_t index) -> int& {
    const std::ptrdiff_t k = index - wheel.first_line;
    assert(k >= 0 && k < node_stride * wheel.columns && k % node_stride < wheel.stride);
    return mark_[k / node_stride * wheel.stride + k % node_stride];
  };
  system.wheel_nodes.clear();
  system.weight_node.resize(rows.weights.size());
  for (std::size_t k = 0; k < rows.weights.size(); ++k) {
    int& m = slot(rows.weights[k].wheel);
    if (m < 0) {
      m = static_cast<int>(system.wheel_nodes.size());
      system.wheel_nodes.push_back(rows.weights[k].wheel);
    }
    system.weight_node[k] = m;
  }
  for (std::ptrdiff_t index : system.wheel_nodes) slot(index) = -1;
  system.wheel.ring_stations = wheel.stations.closed ? wheel.stations.nodes() : 0;
}

namespace {

// Velocities gained by an impulse [N s, model frame] on one of the nodes.
void apply_impulse(ContactSide& side, std::size_t node, Vec3 impulse) {
  if (!side.response) {
    side.velocity[node] += side.inverse_mass[node] * impulse;
    return;
  }
  const SurfaceNode from = side.nodes[node];
  const Vec3 own = rotate(from.frame, yaw_back(side.yaw, impulse));
  for (std::size_t n = 0; n < side.nodes.size(); ++n) {
    const Vec3 v = side.response->velocity(from.column, side.nodes[n].column, side.apart(from, side.nodes[n]), own);
    side.velocity[n] += yaw(side.yaw, rotate_back(from.frame, v));
  }
}

class Sweeper {
 public:
  Sweeper(const MortarRows& rows, double dt, const EnforcementOptions& options, ContactSystem& system,
          SurfaceTractions& tractions)
      : rows_(rows),
        dt_(dt),
        options_(options),
        film_(options.friction.film.flexibility() / dt),
        newest_(options.slip_time > 0 ? -std::expm1(-dt / options.slip_time) : 1.0),
        sys_(system),
        tractions_(tractions) {
    system.slips.assign(rows.rows.size(), 0);
    system.at_start.clear();
    if (film_ > 0)
      for (std::size_t r = 0; r < rows.rows.size(); ++r) system.at_start.push_back(node(r));
  }

  Vec3 relative_velocity(std::size_t r) const { return relative(r, sys_.rail.velocity, sys_.wheel.velocity); }
  Vec3 relative(std::size_t r, const std::vector<Vec3>& rail, const std::vector<Vec3>& wheel) const {
    const ContactRow& row = rows_.rows[r];
    Vec3 w = -rail[r];
    for (int k = row.first; k < row.first + row.count; ++k) w += rows_.weights[k].m * wheel[sys_.weight_node[k]];
    return w;
  }
  // The impulse of a traction on the rail [Pa] over the step, to the nodes of both bodies.
  void apply_traction(std::size_t r, Vec3 traction) {
    const ContactRow& row = rows_.rows[r];
    const Vec3 impulse = dt_ * row.area * traction;
    apply_impulse(sys_.rail, r, impulse);
    for (int k = row.first; k < row.first + row.count; ++k)
      apply_impulse(sys_.wheel, sys_.weight_node[k], -rows_.weights[k].m * impulse);
  }
  // Velocity gained per unit traction.
  double compliance(std::size_t r) const {
    const ContactRow& row = rows_.rows[r];
    double c = sys_.rail.inverse_mass[r];
    for (int k = row.first; k < row.first + row.count; ++k)
      c += rows_.weights[k].m * rows_.weights[k].m * sys_.wheel.inverse_mass[sys_.weight_node[k]];
    return dt_ * row.area * c;
  }

  void multipliers() {
    const std::size_t n = rows_.rows.size();
    std::vector<double>& diagonal = sys_.compliance;
    diagonal.resize(n);
    for (std::size_t r = 0; r < n; ++r) {
      diagonal[r] = compliance(r);
      if (const NodeTraction& t = node(r); t.p > 0 && !sys_.tractions_applied)
        apply_traction(r, traction_vector(t, rows_.rows[r].normal));
    }
    for (sys_.sweeps = 0; sys_.sweeps < options_.max_sweeps;) {
      double change = 0;
      const bool forward = sys_.sweeps % 2 == 0;
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t r = forward ? i : n - 1 - i;
        change = std::max(change, relax(r, diagonal[r]));
      }
      ++sys_.sweeps;
      if (change * dt_ < options_.tolerance) break;
    }
  }

  void penalty() {
    std::vector<Vec3>& last = sys_.last_tractions;
    last.assign(rows_.rows.size(), Vec3{});
    for (std::size_t r = 0; r < rows_.rows.size(); ++r) {
      const ContactRow& row = rows_.rows[r];
      NodeTraction& t = node(r);
      if (sys_.tractions_applied) last[r] = traction_vector(t, row.normal);
      const Vec3 w = relative(r, sys_.rail.before, sys_.wheel.before);
      const TangentFrame f = tangent_frame(row.normal);
      t.p = options_.penalty_stiffness * std::max(0.0, -row.gap);
      const double yields = 1 / (options_.penalty_stiffness * dt_) + film_;
      t.q1 += dot(w, f.t1) / yields;
      t.q2 += dot(w, f.t2) / yields;
      return_to_friction(r, yields, before(r).plastic, t);
    }
    for (std::size_t r = 0; r < rows_.rows.size(); ++r)
      apply_traction(r, traction_vector(node(r), rows_.rows[r].normal) - last[r]);
  }

  void record_slip() {
    for (std::size_t r = 0; r < rows_.rows.size(); ++r) {
      const TangentFrame f = tangent_frame(rows_.rows[r].normal);
      const Vec3 w = relative_velocity(r);
      NodeTraction& t = node(r);
      t.slip1 = dot(w, f.t1) - film_ * (t.q1 - before(r).q1);
      t.slip2 = dot(w, f.t2) - film_ * (t.q2 - before(r).q2);
      if (t.p <= 0) {
        t.stuck = NodeTraction::kPause;
        t.plastic = t.lost_friction = t.mean_slip1 = t.mean_slip2 = 0;
        continue;
      }
      t.stuck = sys_.slips[r] ? 0 : std::min(t.stuck + 1, NodeTraction::kPause);
      if (options_.friction.falling.falls()) remember_slip(t);
      t.contact_time += dt_;
      if (sys_.slips[r]) t.pressed_slip += dt_ * t.p * std::hypot(t.slip1, t.slip2);
      if (t.slips()) t.slip_time += dt_;
    }
  }

 private:
  // Without a film nothing is asked of the tractions before the step.
  const NodeTraction& before(std::size_t r) { return film_ > 0 ? sys_.at_start[r] : node(r); }
  void return_to_friction(std::size_t r, double compliance, double plastic_before, NodeTraction& t) {
    const FrictionStep step{t.p, compliance, dt_, plastic_before, t.lost_friction};
    const FrictionReturn law = return_to_law(options_.friction, step, t.q1, t.q2);
    sys_.slips[r] = law.slips;
    t.plastic = law.plastic;
  }
  void remember_slip(NodeTraction& t) const {
    t.mean_slip1 += newest_ * (t.slip1 - t.mean_slip1);
    t.mean_slip2 += newest_ * (t.slip2 - t.mean_slip2);
    t.lost_friction =
        lost_after(options_.friction.falling, t.lost_friction, std::hypot(t.mean_slip1, t.mean_slip2), dt_);
  }
  NodeTraction& node(std::size_t r) { return tractions_.at(rows_.rows[r].column, rows_.rows[r].station); }

  double relax(std::size_t r, double diagonal) {
    const ContactRow& row = rows_.rows[r];
    NodeTraction& t = node(r);
    const Vec3 w = relative_velocity(r);
    const double closing = -row.gap / dt_ - dot(w, row.normal);  // what the pressure must still take away
    if (t.p == 0 && closing <= 0) return 0;
    const TangentFrame f = tangent_frame(row.normal);
    NodeTraction next = t;
    next.p = std::max(0.0, t.p + closing / diagonal);
    const NodeTraction& start = before(r);
    const double yields = diagonal + film_;
    next.q1 += (dot(w, f.t1) - film_ * (t.q1 - start.q1)) / yields;
    next.q2 += (dot(w, f.t2) - film_ * (t.q2 - start.q2)) / yields;
    return_to_friction(r, yields, start.plastic, next);
    NodeTraction step = next;  // what this sweep changes
    step.p -= t.p;
    step.q1 -= t.q1;
    step.q2 -= t.q2;
    const Vec3 change = traction_vector(step, row.normal);
    apply_traction(r, change);
    t = next;
    return norm(change) * diagonal;
  }

  const MortarRows& rows_;
  double dt_;
  const EnforcementOptions& options_;
  double film_;    // (m/s)/Pa that an elastic film yields
  double newest_;  // share of the step in the mean slip velocity
  ContactSystem& sys_;
  SurfaceTractions& tractions_;
};

}  // namespace

void enforce_contact(const MortarRows& rows, double dt, const EnforcementOptions& options, ContactSystem& system,
                     SurfaceTractions& tractions) {
  Sweeper sweeper(rows, dt, options, system, tractions);
  if (options.penalty)
    sweeper.penalty();
  else
    sweeper.multipliers();
  sweeper.record_slip();
}

}  // namespace railstrata
