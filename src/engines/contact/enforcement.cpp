#include "contact/enforcement.hpp"

#include <algorithm>
#include <cmath>

namespace railstrata {

void number_wheel_nodes(const MortarRows& rows, const ContactSurface& wheel, ContactSystem& system) {
  const std::ptrdiff_t node_stride = static_cast<std::ptrdiff_t>(wheel.stride) * 3;
  system.mark.resize(static_cast<std::size_t>(wheel.columns) * wheel.stride, -1);
  auto slot = [&](std::ptrdiff_t index) -> int& {
    const std::ptrdiff_t k = index - wheel.first_line;
    assert(k >= 0 && k < node_stride * wheel.columns && k % node_stride < wheel.stride);
    return system.mark[k / node_stride * wheel.stride + k % node_stride];
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
}

namespace {

class Sweeper {
 public:
  Sweeper(const MortarRows& rows, double dt, const EnforcementOptions& options, ContactSystem& system,
          SurfaceTractions& tractions)
      : rows_(rows), options_(options), law_(row_law(options, dt)), sys_(system), tractions_(tractions) {
    system.slips.assign(rows.rows.size(), 0);
    system.at_start.clear();
    if (law_.film > 0)
      for (std::size_t r = 0; r < rows.rows.size(); ++r) system.at_start.push_back(row_start(node(r)));
  }

  Vec3 relative_velocity(std::size_t r) const {
    const ContactRow& row = rows_.rows[r];
    Vec3 w = -sys_.rail.velocity[r];
    for (int k = row.first; k < row.first + row.count; ++k)
      w += rows_.weights[k].m * sys_.wheel.velocity[sys_.weight_node[k]];
    return w;
  }
  // The impulse of a traction on the rail [Pa] over the step, to the nodes of both bodies.
  void apply_traction(std::size_t r, Vec3 traction) {
    const ContactRow& row = rows_.rows[r];
    const Vec3 impulse = law_.dt * row.area * traction;
    sys_.rail.velocity[r] += sys_.rail.inverse_mass[r] * impulse;
    for (int k = row.first; k < row.first + row.count; ++k) {
      const int node = sys_.weight_node[k];
      sys_.wheel.velocity[node] += sys_.wheel.inverse_mass[node] * (-rows_.weights[k].m * impulse);
    }
  }
  // Velocity gained per unit traction.
  double compliance(std::size_t r) const {
    const ContactRow& row = rows_.rows[r];
    double c = sys_.rail.inverse_mass[r];
    for (int k = row.first; k < row.first + row.count; ++k)
      c += rows_.weights[k].m * rows_.weights[k].m * sys_.wheel.inverse_mass[sys_.weight_node[k]];
    return law_.dt * row.area * c;
  }

  // Projected Gauss-Seidel: row after row tau <- P(tau + w/d), P the projection on p >= 0 and the friction disc. With d
  // at least the largest eigenvalue of the row's own 3x3 part of the (symmetric, positive) compliance, each row lowers
  // the energy that the multipliers minimise, so that the sweeps converge; forward and backward in turn.
  void multipliers() {
    const std::size_t n = rows_.rows.size();
    std::vector<double>& diagonal = sys_.compliance;
    diagonal.resize(n);
    for (std::size_t r = 0; r < n; ++r) {
      diagonal[r] = compliance(r);
      if (const NodeTraction& t = node(r); t.p > 0) apply_traction(r, traction_vector(t, rows_.rows[r].normal));
    }
    for (sys_.sweeps = 0; sys_.sweeps < options_.max_sweeps;) {
      double change = 0;
      const bool forward = sys_.sweeps % 2 == 0;
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t r = forward ? i : n - 1 - i;
        change = std::max(change, relax(r, diagonal[r]));
      }
      ++sys_.sweeps;
      if (change * law_.dt < options_.tolerance) break;
    }
  }

  void record_slip() {
    for (std::size_t r = 0; r < rows_.rows.size(); ++r) {
      const Vec3 w = relative_velocity(r);
      record_row(law(rows_.rows[r]), rows_.rows[r].normal, w, start(r), sys_.slips[r], node(r));
    }
  }

 private:
  const RowLaw& law(const ContactRow& row) {
    if (!options_.coefficient_across.empty()) law_.friction.coefficient = options_.coefficient_across[row.column];
    return law_;
  }
  // Without a film nothing is asked of the tractions before the step.
  RowStart start(std::size_t r) { return law_.film > 0 ? sys_.at_start[r] : row_start(node(r)); }
  NodeTraction& node(std::size_t r) { return tractions_.at(rows_.rows[r].column, rows_.rows[r].station); }

  double relax(std::size_t r, double diagonal) {
    const ContactRow& row = rows_.rows[r];
    NodeTraction& t = node(r);
    const RowChange change = relax_row(law(row), row.gap, row.normal, diagonal, relative_velocity(r), start(r), t);
    if (!change.acts) return 0;
    sys_.slips[r] = change.slips;
    apply_traction(r, change.traction);
    return norm(change.traction) * diagonal;
  }

  const MortarRows& rows_;
  const EnforcementOptions& options_;
  RowLaw law_;
  ContactSystem& sys_;
  SurfaceTractions& tractions_;
};

}  // namespace

RowLaw row_law(const EnforcementOptions& options, double dt) {
  return {options.friction, dt, options.friction.film.flexibility() / dt,
          options.slip_time > 0 ? -std::expm1(-dt / options.slip_time) : 1.0};
}

void enforce_contact(const MortarRows& rows, double dt, const EnforcementOptions& options, ContactSystem& system,
                     SurfaceTractions& tractions) {
  Sweeper sweeper(rows, dt, options, system, tractions);
  sweeper.multipliers();
  sweeper.record_slip();
}

}  // namespace railstrata
