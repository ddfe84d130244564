#include "fem/stepper.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace railstrata {
namespace {

constexpr int kSearchInterval = 16;  // steps; the wheel moves less than 0.1 mm between searches

/// Smooth rise from 0 to 1 over [0, 1] with zero slope at both ends.
double smooth_rise(double t) { return t <= 0 ? 0 : t >= 1 ? 1 : t * t * (3 - 2 * t); }

// du/dt along the sweep by central differences on unequal spacing.
template <class F>
double station_derivative(const Block& block, int stations, int j, F&& value) {
  const auto& at = block.stations.at;
  const bool closed = block.stations.closed;
  const double period = 2 * std::numbers::pi;
  const int before = j > 0 ? j - 1 : closed ? stations - 1 : j, after = j + 1 < stations ? j + 1 : closed ? 0 : j;
  double t0 = at[before], t1 = at[after];
  if (closed && before > j) t0 -= period;
  if (closed && after < j) t1 += period;
  return (value(after) - value(before)) / (t1 - t0);
}

// Work and losses are summed over whole steps; the moment between two steps has half of the one that follows.
EnergyBalance halfway(const EnergyBalance& before, EnergyBalance now) {
  using E = EnergyBalance;
  for (double E::*sum : {&E::torque_work, &E::friction, &E::contact_normal, &E::damping, &E::absorbed, &E::dashpot}) now.*sum = 0.5 * (before.*sum + now.*sum);
  return now;
}

}  // namespace

Stepper::Stepper(const RollingSystem& system, const PreloadResult& preload) : sys_(system), contact_(system.rail_surface, system.wheel_surface), plan_(system) {
  enforcement_.penalty = sys_.model.spec.contact.method == "penalty";
  enforcement_.penalty_stiffness = sys_.penalty_stiffness;
  enforcement_.friction_coefficient = sys_.model.spec.drive.friction_coefficient;
  start(preload);
  dt_ = plan_.limits.chosen;
}

void Stepper::start(const PreloadResult& preload) {
  const CaseSpec& spec = sys_.model.spec;
  state_.u_rail = preload.u_rail;
  state_.u_wheel = preload.u_wheel;
  state_.tractions = preload.tractions;
  state_.axle = {0, preload.axle_z, 0, spec.drive.speed, 0, sys_.start_spin};
  axle_z0_ = preload.axle_z;
  old_spin_ = state_.axle.spin;
  state_.groups.assign(spec.vehicle.suspension_groups, MassGroup{});
  state_.v_rail = sys_.rail.solid.layout().field();
  state_.v_wheel = sys_.wheel.solid.layout().field();
  f_rail_ = state_.v_rail;
  f_wheel_ = state_.v_wheel;
  for (const DeformableBody::Line& l : sys_.rail.lines) {
    const Block& block = sys_.model.rail.blocks[l.block];
    for (int j = 0; j < l.count; ++j)
      state_.v_rail[l.first + j] = -spec.drive.speed * station_derivative(block, l.count, j, [&](int k) { return state_.u_rail[l.first + k]; });
  }
  const double spin = state_.axle.spin;
  for (const DeformableBody::Line& l : sys_.wheel.lines) {
    const Block& block = sys_.model.wheel.blocks[l.block];
    const double z = block.section.nodes[l.node].z;
    for (int j = 0; j < l.count; ++j) {
      const double t = block.stations.at[j];
      const double rigid = l.component == 0 ? spec.drive.speed + spin * z * std::cos(t) : l.component == 2 ? spin * z * std::sin(t) : 0.0;
      state_.v_wheel[l.first + j] = rigid - spin * station_derivative(block, l.count, j, [&](int k) { return state_.u_wheel[l.first + k]; });
    }
  }
  line_kinetic_.resize(std::max(sys_.rail.lines.size(), sys_.wheel.lines.size()));
  line_damping_.resize(line_kinetic_.size());
  for (const Block& b : sys_.model.wheel.blocks) {
    cos_node_.emplace_back(b.stations.nodes());
    sin_node_.emplace_back(b.stations.nodes());
  }
}

double Stepper::torque() const {
  const double ramp = sys_.model.spec.drive.torque_ramp;
  return ramp > 0 ? sys_.torque * smooth_rise(state_.time / ramp) : sys_.torque;
}

double Stepper::damping_rate() const {
  const RunSpec& run = sys_.model.spec.run;
  if (run.run_up <= 0) return 0;
  return run.run_up_damping * (1 - smooth_rise(state_.axle.x / run.run_up));
}

void Stepper::internal_forces() {
  sys_.rail.solid.internal_force(state_.u_rail, 0, f_rail_);
  sys_.wheel.solid.internal_force(state_.u_wheel, state_.axle.psi, f_wheel_);
  sys_.rail.ties.collect(f_rail_);
  const double offset_moment = sys_.wheel.ties.collect_turning(f_wheel_, state_.axle.psi);
  double absorbed = 0;
  for (const EndDashpot& d : sys_.absorbers) {
    const double v = state_.v_rail[d.index];
    f_rail_[d.index] += d.coefficient * v;
    absorbed += d.coefficient * v * v;
  }
  balance_.absorbed += dt_ * absorbed;
  const double c = std::cos(state_.axle.psi), s = std::sin(state_.axle.psi);
  bore_fx_ = bore_fz_ = 0;
  bore_my_ = -offset_moment;
  for (const BoreNode& n : sys_.axle.bore) {
    const double fx = -f_wheel_[n.index], fz = -f_wheel_[n.index + 2 * n.stride];
    const double rx = c * n.arm.x + s * n.arm.z, rz = c * n.arm.z - s * n.arm.x;
    bore_fx_ += fx;
    bore_fz_ += fz;
    bore_my_ += rz * fx - rx * fz;
  }
}

Vec3 Stepper::free_acceleration(const DeformableBody& body, const Field& f, std::ptrdiff_t i, int stride) const {
  const double m = body.inverse_mass[i];
  return {-m * f[i], -m * f[i + stride], -m * f[i + 2 * stride] - (m > 0 ? sys_.gravity : 0.0)};
}

void Stepper::contact() {
  const double h = sys_.model.spec.mesh.element_size;
  if (state_.step % kSearchInterval == 0) {
    const double half = 1.5 * sys_.model.hertz.a + 3 * h;
    contact_.search(state_.u_rail, state_.u_wheel, pose(), half, 0.25 * sys_.model.hertz.approach);
  }
  const MortarRows& rows = contact_.rows(state_.u_rail, state_.u_wheel, pose());
  reached_edge_ = reached_edge_ || rows.reached_edge;
  // nodes that left the neighbourhood of the patch carry nothing
  if (state_.step % kSearchInterval == 0) {
    std::vector<NodeTraction> kept;
    for (const ContactRow& r : rows.rows) kept.push_back(state_.tractions.at(r.column, r.station));
    for (NodeTraction& t : state_.tractions.all()) t = {};
    for (std::size_t k = 0; k < kept.size(); ++k) state_.tractions.at(rows.rows[k].column, rows.rows[k].station) = kept[k];
  }

  ContactSystem& c = contact_system_;
  numbering_.number(rows, sys_.wheel_surface, c);
  const int rs = sys_.rail_surface.stride, ws = sys_.wheel_surface.stride;
  const double rate = damping_rate();
  auto velocity = [](const Field& v, std::ptrdiff_t i, int stride) { return Vec3{v[i], v[i + stride], v[i + 2 * stride]}; };
  c.rail_velocity.clear(), c.rail_inverse_mass.clear(), c.wheel_velocity.clear(), c.wheel_inverse_mass.clear();
  c.rail_before.clear(), c.wheel_before.clear();
  for (const ContactRow& r : rows.rows) {
    c.rail_before.push_back(velocity(state_.v_rail, r.rail, rs));
    c.rail_velocity.push_back((1 - rate * dt_) * c.rail_before.back() + dt_ * free_acceleration(sys_.rail, f_rail_, r.rail, rs));
    c.rail_inverse_mass.push_back(plan_.rail.share(r.rail) * sys_.rail.inverse_mass[r.rail]);
  }
  for (std::ptrdiff_t i : c.wheel_nodes) {
    const Vec3 v = velocity(state_.v_wheel, i, ws);
    c.wheel_before.push_back(v);
    Vec3 a = free_acceleration(sys_.wheel, f_wheel_, i, ws);
    if (rate > 0) {
      const std::ptrdiff_t k = i - sys_.wheel_surface.first_line;
      const int column = static_cast<int>(k / (3 * ws)), station = static_cast<int>(k % (3 * ws));
      const double z = sys_.wheel_surface.node[column].z, t = sys_.wheel_surface.stations.at[station] - state_.axle.psi;
      a -= rate * (v - Vec3{mean_travel_ + mean_spin_ * z * std::cos(t), 0, mean_spin_ * z * std::sin(t)});
    }
    c.wheel_velocity.push_back(v + dt_ * a);
    c.wheel_inverse_mass.push_back(plan_.wheel.share(i) * sys_.wheel.inverse_mass[i]);
  }

  enforce_contact(rows, dt_, enforcement_, c, state_.tractions);

  forces_ = {};
  forces_.sweeps = c.sweeps;
  double friction = 0, normal = 0;
  for (std::size_t k = 0; k < rows.rows.size(); ++k) {
    const ContactRow& row = rows.rows[k];
    const NodeTraction& t = state_.tractions.at(row.column, row.station);
    if (t.p <= 0) continue;
    const Vec3 force = row.area * traction_vector(t, row.normal);  // on the rail
    const double component[3] = {force.x, force.y, force.z};
    Vec3 slip = -0.5 * (c.rail_before[k] + c.rail_velocity[k]);      // mean of the step, wheel against rail
    for (int i = 0; i < 3; ++i) plan_.rail.add_force(f_rail_, row.rail + i * rs, -component[i]);
    for (int w = row.first; w < row.first + row.count; ++w) {
      const WheelWeight& weight = rows.weights[w];
      for (int i = 0; i < 3; ++i) plan_.wheel.add_force(f_wheel_, weight.wheel + i * ws, weight.m * component[i]);
      const int n = c.weight_node[w];
      slip += (0.5 * weight.m) * (c.wheel_before[n] + c.wheel_velocity[n]);
    }
    forces_.x -= force.x, forces_.y -= force.y, forces_.z -= force.z;
    forces_.penetration = std::max(forces_.penetration, -row.gap);
    ++forces_.nodes;
    const double normal_slip = dot(slip, row.normal);
    normal += -row.area * t.p * normal_slip;
    friction += dot(force, slip) + row.area * t.p * normal_slip;
  }
  balance_.friction += dt_ * friction;
  balance_.contact_normal += dt_ * normal;
}

void Stepper::advance(const DeformableBody& body, Field& u, Field& v, const Field& f, bool is_wheel, double& kinetic, double& damping_power) {
  const double rate = damping_rate(), g = sys_.gravity, dt = dt_;
  const bool energy = want_energy_;
  const auto lines = static_cast<std::ptrdiff_t>(body.lines.size());
  for_each(lines, [&](std::ptrdiff_t n) {
    const DeformableBody::Line& l = body.lines[n];
    const double weight = l.component == 2 ? g : 0.0;
    double* pu = u.data() + l.first;
    double* pv = v.data() + l.first;
    const double* pf = f.data() + l.first;
    const double* pm = body.inverse_mass.data() + l.first;
    if (rate == 0 && !energy) {
      for (int j = 0; j < l.count; ++j) {
        pv[j] -= dt * (pm[j] * pf[j] + weight);
        pu[j] += dt * pv[j];
      }
      return;
    }
    const double* turn = is_wheel && rate > 0 && l.component != 1 ? (l.component == 0 ? cos_node_ : sin_node_)[l.block].data() : nullptr;
    const double arm = turn ? mean_spin_ * body.solid.body().blocks[l.block].section.nodes[l.node].z : 0.0;
    const double travel = turn && l.component == 0 ? mean_travel_ : 0.0;
    double twice_kinetic = 0, power = 0;
    for (int j = 0; j < l.count; ++j) {
      const double relative = pv[j] - (turn ? travel + arm * turn[j] : 0.0);
      const double before = pv[j], m = 1 / pm[j];
      pv[j] -= dt * (pm[j] * pf[j] + weight + rate * relative);
      pu[j] += dt * pv[j];
      twice_kinetic += m * before * pv[j];
      power += m * rate * relative * 0.5 * (before + pv[j]);
    }
    line_kinetic_[n] = 0.5 * twice_kinetic;
    line_damping_[n] = power;
  });
  if (rate == 0 && !energy) return;
  for (std::ptrdiff_t n = 0; n < lines; ++n) kinetic += line_kinetic_[n], damping_power += line_damping_[n];
}

// Mean travel and spin of the wheel's free nodes, and the turned station angles the run-up damping needs.
void Stepper::measure_rigid_motion() {
  for (std::size_t b = 0; b < cos_node_.size(); ++b)
    for (std::size_t j = 0; j < cos_node_[b].size(); ++j) {
      const double t = sys_.model.wheel.blocks[b].stations.at[j] - state_.axle.psi;
      cos_node_[b][j] = std::cos(t);
      sin_node_[b][j] = std::sin(t);
    }
  const auto lines = static_cast<std::ptrdiff_t>(sys_.wheel.lines.size());
  std::vector<std::array<double, 4>> part(lines);  // mass, m v_x, m r^2, angular momentum
  for_each(lines, [&](std::ptrdiff_t n) {
    const DeformableBody::Line& l = sys_.wheel.lines[n];
    part[n] = {};
    if (l.component == 1) return;
    const double z = sys_.model.wheel.blocks[l.block].section.nodes[l.node].z;
    const double* turn = (l.component == 0 ? cos_node_ : sin_node_)[l.block].data();
    for (int j = 0; j < l.count; ++j) {
      const double m = sys_.wheel.mass[l.first + j], v = state_.v_wheel[l.first + j];
      if (l.component == 0) part[n][0] += m, part[n][1] += m * v, part[n][2] += m * z * z;
      part[n][3] += m * z * turn[j] * v;
    }
  });
  double mass = 0, momentum = 0, inertia = 0, angular = 0;
  for (const auto& p : part) mass += p[0], momentum += p[1], inertia += p[2], angular += p[3];
  mean_travel_ = momentum / mass;
  mean_spin_ = angular / inertia;
}

void Stepper::advance_axle() {
  const VehicleSpec& v = sys_.model.spec.vehicle;
  AxleMotion& a = state_.axle;
  const SuspensionForce spring = step_suspension(v, a.z - axle_z0_, a.vz, dt_, state_.groups);
  const double suspension = -v.sprung_mass * sys_.gravity - spring.on_masses;
  balance_.dashpot += dt_ * spring.dashpot_power;
  const double rate = damping_rate(), moment = torque();
  const double vx = a.vx, vz = a.vz, spin = a.spin;
  a.vx += dt_ * bore_fx_ / sys_.axle.mass_x;
  a.vz += dt_ * ((bore_fz_ + suspension) / sys_.axle.mass_z - sys_.gravity - rate * a.vz);
  a.spin += dt_ * (bore_my_ + moment) / sys_.axle.inertia;
  a.x += dt_ * a.vx;
  a.z += dt_ * a.vz;
  a.psi += dt_ * a.spin;
  balance_.torque_work += dt_ * moment * 0.5 * (spin + a.spin);
  balance_.damping += dt_ * rate * sys_.axle.mass_z * vz * 0.5 * (vz + a.vz);
  axle_kinetic_ = 0.5 * (sys_.axle.mass_x * vx * a.vx + sys_.axle.mass_z * vz * a.vz + sys_.axle.inertia * spin * a.spin);
  const double share = v.sprung_mass / static_cast<double>(state_.groups.size());
  for (const MassGroup& m : state_.groups) axle_kinetic_ += 0.5 * share * m.vz * m.vz;
}

double Stepper::weight_potential() const {
  double sum = 0;
  auto add = [&](const DeformableBody& body, const Field& u) {
    for (const DeformableBody::Line& l : body.lines)
      if (l.component == 2)
        for (int j = 0; j < l.count; ++j) sum += body.mass[l.first + j] * u[l.first + j];
  };
  add(sys_.rail, state_.u_rail);
  add(sys_.wheel, state_.u_wheel);
  return sys_.gravity * (sum + sys_.axle.mass_z * state_.axle.z);
}

double Stepper::spring_energy() const {
  const VehicleSpec& v = sys_.model.spec.vehicle;
  const double k = v.suspension_stiffness / static_cast<double>(state_.groups.size());
  double sum = v.sprung_mass * sys_.gravity * state_.axle.z;
  for (const MassGroup& m : state_.groups) {
    const double squeeze = state_.axle.z - axle_z0_ - m.z;
    sum += 0.5 * k * squeeze * squeeze;
  }
  return sum;
}

void Stepper::step() {
  const EnergyBalance before = balance_;
  internal_forces();
  plan_.rail.scale(f_rail_);
  plan_.wheel.scale(f_wheel_);
  if (damping_rate() > 0) measure_rigid_motion();
  contact();
  Field rail_before, wheel_before;
  if (want_energy_) {
    const StrainEnergy rail = sys_.rail.solid.energy(state_.u_rail, 0), wheel = sys_.wheel.solid.energy(state_.u_wheel, state_.axle.psi);
    balance_.strain = rail.strain + wheel.strain;
    balance_.hourglass = rail.hourglass + wheel.hourglass;
    balance_.weight = weight_potential();
    balance_.spring = spring_energy();
    rail_before = plan_.rail.differences(state_.v_rail);
    wheel_before = plan_.wheel.differences(state_.v_wheel);
  }
  double kinetic = 0, damping = 0;
  advance(sys_.rail, state_.u_rail, state_.v_rail, f_rail_, false, kinetic, damping);
  advance(sys_.wheel, state_.u_wheel, state_.v_wheel, f_wheel_, true, kinetic, damping);
  balance_.damping += dt_ * damping;
  advance_axle();
  if (want_energy_) {
    balance_.kinetic = kinetic + axle_kinetic_ + plan_.rail.kinetic(rail_before, state_.v_rail) + plan_.wheel.kinetic(wheel_before, state_.v_wheel);
    recorded_ = halfway(before, balance_);
  }
  sys_.apply_constraints(state_.u_rail, state_.u_wheel, pose());
  state_.time += dt_;
  ++state_.step;
  want_energy_ = false;
}

std::string Stepper::check_finite() const {
  auto look = [](const DeformableBody& body, const Field& u) -> std::string {
    for (const DeformableBody::Line& l : body.lines)
      for (int j = 0; j < l.count; ++j)
        if (!std::isfinite(u[l.first + j])) {
          const Vec3 x = body.solid.reference_position(l.block, l.node, j);
          return fmt::format("{} {}, node near x = {:.1f} mm, y = {:.1f} mm, z = {:.1f} mm", body.solid.body().name, body.solid.body().blocks[l.block].name, 1e3 * x.x, 1e3 * x.y, 1e3 * x.z);
        }
    return {};
  };
  const std::string rail = look(sys_.rail, state_.u_rail);
  return rail.empty() ? look(sys_.wheel, state_.u_wheel) : rail;
}

}  // namespace railstrata
