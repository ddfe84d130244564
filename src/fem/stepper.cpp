#include "fem/stepper.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/faults.hpp"
#include "core/vectorize.hpp"

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
  for (double E::*sum : {&E::torque_work, &E::friction, &E::contact_normal, &E::damping, &E::absorbed, &E::dashpot})
    now.*sum = 0.5 * (before.*sum + now.*sum);
  return now;
}

}  // namespace

Stepper::Stepper(const RollingSystem& system)
    : sys_(system), contact_(system.rail_surface, system.wheel_surface), plan_(system) {
  enforcement_.penalty = sys_.model.spec.contact.method == ContactMethod::penalty;
  enforcement_.penalty_stiffness = sys_.penalty_stiffness;
  enforcement_.friction_coefficient = sys_.model.spec.drive.friction_coefficient;
  dt_ = plan_.limits.chosen;
  prepare();
}

Stepper::Stepper(const RollingSystem& system, const PreloadResult& preload) : Stepper(system) { start(preload); }

Stepper::Stepper(const RollingSystem& system, StepperMemory memory) : Stepper(system) {
  const RollingState& s = memory.state;
  const auto surface_nodes = static_cast<std::size_t>(sys_.rail_surface.columns) * sys_.rail_surface.stations.nodes();
  if (s.u_rail.size() != f_rail_.size() || s.v_rail.size() != f_rail_.size() || s.u_wheel.size() != f_wheel_.size() ||
      s.v_wheel.size() != f_wheel_.size() ||
      s.groups.size() != static_cast<std::size_t>(sys_.model.spec.vehicle.suspension_groups) ||
      s.tractions.all().size() != surface_nodes || s.tractions.stations() != sys_.rail_surface.stations.nodes())
    throw CaseError("the saved state is that of another mesh", "start the run anew");
  state_ = std::move(memory.state);
  balance_ = memory.balance;
  mean_ = memory.mean;
  axle_z0_ = memory.axle_z0;
  reached_edge_ = memory.reached_edge;
  contact_.recall(std::move(memory.facets));
  wheel_surface_u_ = state_.u_wheel;
  frame_.move_to(state_.time);
}

bool Stepper::can_be_remembered() const { return state_.step % kSearchInterval == 0; }

StepperMemory Stepper::memory() const {
  return {state_, balance_, mean_, contact_.memory(), axle_z0_, dt_, reached_edge_};
}

void ReferenceFrame::set_step(double dt) {
  const double turn = spin * dt, half = std::sin(0.5 * turn);
  cos_step = 1 - 2 * half * half;
  sin_step = std::sin(turn);
  centrifugal = 4 * half * half / (dt * dt);
  slope_cos = -2 * half * half / dt;
  slope_sin = sin_step / dt;
}

void ReferenceFrame::move_to(double time) {
  x = speed * time;
  psi = spin * time;
  cos_psi = std::cos(psi);
  sin_psi = std::sin(psi);
}

// All that does not change during the rolling.
void Stepper::prepare() {
  f_rail_ = sys_.rail.solid.layout().field();
  f_wheel_ = sys_.wheel.solid.layout().field();
  frame_.speed = sys_.model.spec.drive.speed;
  frame_.spin = sys_.start_spin;
  frame_.set_step(dt_);
  for (const Block& b : sys_.model.wheel.blocks) {
    cos_node_.emplace_back();
    sin_node_.emplace_back();
    for (double t : b.stations.at) {
      cos_node_.back().push_back(std::cos(t));
      sin_node_.back().push_back(std::sin(t));
    }
  }
  rail_schedule_ = schedule(sys_.rail, sys_.rail_surface, plan_.rail);
  wheel_schedule_ = schedule(sys_.wheel, sys_.wheel_surface, plan_.wheel);
  for (const DeformableBody::Line& l : sys_.wheel.lines) {
    if (l.component != 0) continue;
    const double z = sys_.model.wheel.blocks[l.block].section.nodes[l.node].z;
    for (int j = 0; j < l.count; ++j) {
      free_mass_ += sys_.wheel.mass[l.first + j];
      free_inertia_ += sys_.wheel.mass[l.first + j] * z * z;
    }
  }
}

void Stepper::start(const PreloadResult& preload) {
  const CaseSpec& spec = sys_.model.spec;
  state_.u_rail = preload.u_rail;
  state_.u_wheel = preload.u_wheel;
  state_.tractions = preload.tractions;
  state_.axle = {0, preload.axle_z, 0, spec.drive.speed, 0, sys_.start_spin};
  axle_z0_ = preload.axle_z;
  state_.groups.assign(spec.vehicle.suspension_groups, MassGroup{});
  state_.v_rail = sys_.rail.solid.layout().field();
  state_.v_wheel = sys_.wheel.solid.layout().field();
  for (const DeformableBody::Line& l : sys_.rail.lines) {
    const Block& block = sys_.model.rail.blocks[l.block];
    for (int j = 0; j < l.count; ++j)
      state_.v_rail[l.first + j] =
          -spec.drive.speed * station_derivative(block, l.count, j, [&](int k) { return state_.u_rail[l.first + k]; });
  }
  const double spin = state_.axle.spin;
  frame_.move_to(0);
  for (const DeformableBody::Line& l : sys_.wheel.lines) {
    const Block& block = sys_.model.wheel.blocks[l.block];
    for (int j = 0; j < l.count; ++j) {
      state_.v_wheel[l.first + j] =
          -spin * station_derivative(block, l.count, j, [&](int k) { return state_.u_wheel[l.first + k]; });
    }
  }
  wheel_surface_u_ = state_.u_wheel;

  Sums all;
  for (const DeformableBody::Line& l : sys_.wheel.lines) {
    if (l.component == 1) continue;
    const double z = sys_.model.wheel.blocks[l.block].section.nodes[l.node].z;
    const std::vector<double>& turn = (l.component == 0 ? cos_node_ : sin_node_)[l.block];
    for (int j = 0; j < l.count; ++j) {
      const double m = sys_.wheel.mass[l.first + j], w = state_.v_wheel[l.first + j];
      (l.component == 0 ? all.momentum_x : all.momentum_z) += m * w;
      all.angular += m * z * turn[j] * w;
    }
  }
  take_mean_motion(all);
}

// Nodes on the running surface, at ties, with added mass and those that local steps act on wait for the contact; those
// that are not free are not updated at all.
Stepper::Schedule Stepper::schedule(const DeformableBody& body, const ContactSurface& surface,
                                    const BodySteps& steps) const {
  Schedule out;
  const SweptBody& mesh = body.solid.body();
  for (const BlockLayout& b : body.solid.layout().blocks) out.at_once.emplace_back(b.nodes, 0);
  for (const DeformableBody::Line& l : body.lines) out.at_once[l.block][l.node] = 1;
  auto wait = [&](int block, int node) {
    if (out.at_once[block][node]) out.later.push_back({block, node}), out.at_once[block][node] = 0;
  };
  for (int c = 0; c < surface.columns; ++c) wait(mesh.contact.block, c);
  for (const Tie& t : mesh.ties) {
    wait(t.master_block, t.master_node0);
    wait(t.master_block, t.master_node1);
  }
  for (int b = 0; b < static_cast<int>(out.at_once.size()); ++b)
    for (int n = 0; n < static_cast<int>(out.at_once[b].size()); ++n)
      if (steps.scaling.acts_on(b, n) || steps.local.acts_on(b, n)) wait(b, n);
  for (int b = 0; b < static_cast<int>(out.at_once.size()); ++b)
    for (int n = 0; n < static_cast<int>(out.at_once[b].size()); ++n)
      if (out.at_once[b][n]) out.bordered.push_back({b, n});
  out.later_sums.resize(out.later.size());
  out.border_sums.resize(out.bordered.size());
  return out;
}

void Stepper::chain_tiles(const DeformableBody& body, Schedule& schedule) const {
  constexpr int kChainsPerThread = 6, kSingleTiles = std::numeric_limits<int>::max();
  const Solid& solid = body.solid;
  const int wanted = rate_ > 0 || want_energy_ ? kSingleTiles : kChainsPerThread * max_threads();
  if (wanted == schedule.chains_wanted) return;
  schedule.chains_wanted = wanted;
  schedule.chains = solid.chains(wanted, std::move(schedule.chains));
  schedule.chain_sums.assign(schedule.chains.size(), {});
  schedule.borders.resize(schedule.at_once.size());
  for (std::vector<int>& planes : schedule.borders) planes.clear();
  for (const Solid::Chain& c : schedule.chains) schedule.borders[solid.block(c)].push_back(solid.border_plane(c));
  for (std::size_t b = 0; b < schedule.borders.size(); ++b)
    if (const BlockLayout& l = solid.layout().blocks[b]; !l.closed) schedule.borders[b].push_back(l.elements);
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

AxlePose Stepper::pose_in_frame() const {
  const Vec3 at = frame_.to_frame({state_.axle.x - frame_.x, 0, state_.axle.z});
  return {at.x, at.z, state_.axle.psi - frame_.psi};
}

void Stepper::internal_forces() {
  const double drift = state_.axle.psi - frame_.psi;
  const Solid& rail = sys_.rail.solid;
  const Solid& wheel = sys_.wheel.solid;
  rail.begin_forces(state_.u_rail, 0);
  wheel.begin_forces(state_.u_wheel, drift);
  chain_tiles(sys_.rail, rail_schedule_);
  chain_tiles(sys_.wheel, wheel_schedule_);
  const bool fused = !want_energy_;
  const std::ptrdiff_t wheel_chains = static_cast<std::ptrdiff_t>(wheel_schedule_.chains.size()),
                       rail_chains = static_cast<std::ptrdiff_t>(rail_schedule_.chains.size());
  for_each(
      wheel_chains + rail_chains,
      [&](std::ptrdiff_t k) {
        const bool is_wheel = k < wheel_chains;
        if (!is_wheel) k -= wheel_chains;
        Schedule& plan = is_wheel ? wheel_schedule_ : rail_schedule_;
        Sums sums;
        const auto take = [&](const Solid::Tile& tile, int begin, int node, const double* rows) {
          if (!fused || !plan.at_once[tile.block][node]) return false;
          const double* const f[3] = {rows - tile.first, rows + Solid::kTile - tile.first,
                                      rows + 2 * Solid::kTile - tile.first};
          if (begin == tile.first)
            advance_node(is_wheel, {tile.block, node}, begin, begin + 1, f, sums);  // the others are aligned to packs
          advance_node(is_wheel, {tile.block, node}, tile.first + 1, tile.end, f, sums);
          return true;
        };
        const Solid& solid = is_wheel ? wheel : rail;
        const Field& v = is_wheel ? state_.v_wheel : state_.v_rail;
        const Field& inverse_mass = (is_wheel ? sys_.wheel : sys_.rail).inverse_mass;
        const auto expect = [&](const Solid::Tile& tile, int node, Prefetch& lines) {
          if (!plan.at_once[tile.block][node]) return;
          const std::ptrdiff_t x = solid.layout().blocks[tile.block].line(node, 0) + tile.first;
          for (int i = 0; i < 3; ++i) lines.add(&v[x + i * solid.layout().blocks[tile.block].stride]);
          lines.add(&inverse_mass[x]);
        };
        solid.chain_forces(plan.chains[k], is_wheel ? state_.u_wheel : state_.u_rail, is_wheel ? f_wheel_ : f_rail_,
                           take, expect);
        plan.chain_sums[k] = sums;
      },
      true);
  rail.end_forces(rail_schedule_.chains, f_rail_);
  wheel.end_forces(wheel_schedule_.chains, f_wheel_);
  const double c = std::cos(drift), s = std::sin(drift);
  double moment[6];  // what the ties' offsets hand to the rotation
  for_each(6, [&](std::ptrdiff_t k) {
    const int component = static_cast<int>(k % 3);
    moment[k] = k < 3 ? sys_.wheel.ties.collect_component(f_wheel_, component, c, s)
                      : sys_.rail.ties.collect_component(f_rail_, component, 1, 0);
  });
  double absorbed = 0;
  for (const EndDashpot& d : sys_.absorbers) {
    const double v = state_.v_rail[d.index];
    f_rail_[d.index] += d.coefficient * v;
    absorbed += d.coefficient * v * v;
  }
  balance_.absorbed += dt_ * absorbed;
  Vec3 bore{};
  bore_my_ = -(moment[0] + moment[1] + moment[2]);
  for (const BoreNode& n : sys_.axle.bore) {
    const double fx = -f_wheel_[n.index], fz = -f_wheel_[n.index + 2 * n.stride];
    const double rx = c * n.arm.x + s * n.arm.z, rz = c * n.arm.z - s * n.arm.x;
    bore.x += fx;
    bore.z += fz;
    bore_my_ += rz * fx - rx * fz;
  }
  bore = frame_.to_model(bore);
  bore_fx_ = bore.x;
  bore_fz_ = bore.z;
}

// Of a node on the running surface, model frame; zero for one that is not free.
Vec3 Stepper::free_acceleration(bool is_wheel, std::ptrdiff_t i) const {
  const double m = (is_wheel ? sys_.wheel : sys_.rail).inverse_mass[i];
  if (m == 0) return {};
  const Field& f = is_wheel ? f_wheel_ : f_rail_;
  const int stride = (is_wheel ? sys_.wheel_surface : sys_.rail_surface).stride;
  Vec3 a = -m * Vec3{f[i], f[i + stride], f[i + 2 * stride]};
  if (is_wheel) a = frame_.to_model(a);
  return a - Vec3{0, 0, sys_.gravity};
}

// From the axle to an undeformed node of the wheel's running surface, frame components.
Vec3 Stepper::wheel_arm(std::ptrdiff_t index) const {
  const ContactSurface& surface = sys_.wheel_surface;
  const std::ptrdiff_t k = index - surface.first_line;
  const auto column = k / (3 * surface.stride), station = k % (3 * surface.stride);
  const int block = sys_.model.wheel.contact.block;
  const double z = surface.node[column].z;
  return {-z * sin_node_[block][station], 0, z * cos_node_[block][station]};
}

// Displacements of the wheel's running surface in the model frame, for the contact.
void Stepper::lift_wheel_surface() {
  const ContactSurface& surface = sys_.wheel_surface;
  const int block = sys_.model.wheel.contact.block, stations = surface.stations.nodes();
  const double* cosine = cos_node_[block].data();
  const double* sine = sin_node_[block].data();
  const double c = frame_.cos_psi, s = frame_.sin_psi;
  for (int column = 0; column < surface.columns; ++column) {
    const std::ptrdiff_t x = surface.index(column, 0), y = x + surface.stride, z = y + surface.stride;
    const double radius = surface.node[column].z;
    for (int j = 0; j < stations; ++j) {
      const double ax = -radius * sine[j], az = radius * cosine[j], px = ax + state_.u_wheel[x + j],
                   pz = az + state_.u_wheel[z + j];
      wheel_surface_u_[x + j] = frame_.x + c * px + s * pz - ax;
      wheel_surface_u_[y + j] = state_.u_wheel[y + j];
      wheel_surface_u_[z + j] = c * pz - s * px - az;
    }
  }
}

// Velocities relative to the frame's travel, in this step's frame components: of the half step before, or the one after
// the update. Empty without added mass.
Field Stepper::wheel_velocity(bool before, Field reuse) const {
  Field out = std::move(reuse);
  if (plan_.wheel.scaling.empty()) return out;
  out.assign(state_.v_wheel.size(), 0.0);
  const auto& blocks = sys_.wheel.solid.layout().blocks;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (int n = 0; n < blocks[b].nodes; ++n) {
      const std::ptrdiff_t x = blocks[b].line(n, 0), y = blocks[b].line(n, 1), z = blocks[b].line(n, 2);
      const double radius = sys_.model.wheel.blocks[b].section.nodes[n].z;
      for (int j = 0; j < blocks[b].stations; ++j) {
        const Vec3 w = Vec3{state_.v_wheel[x + j], state_.v_wheel[y + j], state_.v_wheel[z + j]} +
                       frame_.rigid_rate({-radius * sin_node_[b][j], 0, radius * cos_node_[b][j]});
        const Vec3 v = before ? frame_.step_back(w) : w;
        out[x + j] = v.x;
        out[y + j] = v.y;
        out[z + j] = v.z;
      }
    }
  return out;
}

Field Stepper::wheel_displacement() const {
  Field out = sys_.wheel.solid.layout().field();
  const auto& blocks = sys_.wheel.solid.layout().blocks;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (int n = 0; n < blocks[b].nodes; ++n) {
      const std::ptrdiff_t x = blocks[b].line(n, 0), y = blocks[b].line(n, 1), z = blocks[b].line(n, 2);
      const double radius = sys_.model.wheel.blocks[b].section.nodes[n].z;
      for (int j = 0; j < blocks[b].stations; ++j) {
        const Vec3 arm{-radius * sin_node_[b][j], 0, radius * cos_node_[b][j]};
        const Vec3 u =
            Vec3{frame_.x, 0, 0} +
            frame_.to_model(arm + Vec3{state_.u_wheel[x + j], state_.u_wheel[y + j], state_.u_wheel[z + j]}) - arm;
        out[x + j] = u.x;
        out[y + j] = u.y;
        out[z + j] = u.z;
      }
    }
  return out;
}

// Local steps take over all that acts on their nodes, as it stands in the update.
void Stepper::refine_forces() {
  plan_.rail.local.refine(state_.u_rail, 0, {{0, 0, -sys_.gravity}, 0}, f_rail_);
  plan_.wheel.local.refine(state_.u_wheel, state_.axle.psi - frame_.psi,
                           {{frame_.sin_psi * sys_.gravity, 0, -frame_.cos_psi * sys_.gravity}, frame_.centrifugal},
                           f_wheel_);
}

// A force [N] of the wheel on the rail in a row of the contact, to the nodes of both bodies; add(is_wheel, index, force
// on the node).
template <class Add>
void Stepper::spread_contact_force(const MortarRows& rows, const ContactRow& row, Vec3 force, Add&& add) {
  const Vec3 turned = frame_.to_frame(force);
  const double on_rail[3] = {force.x, force.y, force.z}, on_wheel[3] = {-turned.x, -turned.y, -turned.z};
  for (int i = 0; i < 3; ++i) add(false, row.rail + i * sys_.rail_surface.stride, on_rail[i]);
  for (int w = row.first; w < row.first + row.count; ++w)
    for (int i = 0; i < 3; ++i)
      add(true, rows.weights[w].wheel + i * sys_.wheel_surface.stride, rows.weights[w].m * on_wheel[i]);
}

// Free velocities of the nodes of the contact and how they answer.
void Stepper::gather_contact(const MortarRows& rows) {
  ContactSystem& c = contact_system_;
  const ContactSurface &rail = sys_.rail_surface, &wheel = sys_.wheel_surface;
  numbering_.number(rows, wheel, c);
  c.tractions_held = plan_.local();
  c.rail.clear();
  c.wheel.clear();
  c.rail.response = plan_.rail.response.empty() ? nullptr : &plan_.rail.response;
  c.wheel.response = plan_.wheel.response.empty() ? nullptr : &plan_.wheel.response;
  auto velocity = [](const Field& v, std::ptrdiff_t i, int stride) {
    return Vec3{v[i], v[i + stride], v[i + 2 * stride]};
  };
  for (const ContactRow& r : rows.rows) {
    c.rail.before.push_back(velocity(state_.v_rail, r.rail, rail.stride));
    c.rail.velocity.push_back((1 - rate_ * dt_) * c.rail.before.back() + dt_ * free_acceleration(false, r.rail));
    c.rail.inverse_mass.push_back(c.rail.response ? c.rail.response->own(r.column)
                                                  : plan_.rail.scaling.share(r.rail) * sys_.rail.inverse_mass[r.rail]);
    if (c.rail.response) c.rail.places.push_back({r.column, r.station});
  }
  for (std::ptrdiff_t i : c.wheel_nodes) {
    const Vec3 arm = wheel_arm(i), w = velocity(state_.v_wheel, i, wheel.stride);
    c.wheel.before.push_back(Vec3{frame_.speed, 0, 0} + frame_.to_model(frame_.step_back(w + frame_.rigid_rate(arm))));
    Vec3 a = free_acceleration(true, i);
    if (rate_ > 0)
      a -= rate_ *
           frame_.to_model(frame_.step_back(w - Vec3{mean_.x + mean_.spin * arm.z, 0, mean_.z - mean_.spin * arm.x}));
    c.wheel.velocity.push_back(c.wheel.before.back() + dt_ * a);
    if (!c.wheel.response) {
      c.wheel.inverse_mass.push_back(plan_.wheel.scaling.share(i) * sys_.wheel.inverse_mass[i]);
      continue;
    }
    const std::ptrdiff_t k = i - wheel.first_line;
    const int column = static_cast<int>(k / (3 * wheel.stride)), station = static_cast<int>(k % (3 * wheel.stride));
    const double cosine = cos_node_[sys_.model.wheel.contact.block][station],
                 sine = sin_node_[sys_.model.wheel.contact.block][station];  // of theta
    c.wheel.inverse_mass.push_back(c.wheel.response->own(column));
    c.wheel.places.push_back({column, station, cosine * frame_.cos_psi + sine * frame_.sin_psi,
                              sine * frame_.cos_psi - cosine * frame_.sin_psi});
  }
}

// Local steps carry the tractions of the last step through their stages; then what the contact changes of them.
void Stepper::contact() {
  const double h = sys_.model.spec.mesh.element_size;
  lift_wheel_surface();
  if (state_.step % kSearchInterval == 0) {
    const double half = 1.5 * sys_.model.hertz.a + 3 * h;
    contact_.search(state_.u_rail, wheel_surface_u_, pose(), half, 0.25 * sys_.model.hertz.approach);
  }
  const MortarRows& rows = contact_.rows(state_.u_rail, wheel_surface_u_, pose());
  reached_edge_ = reached_edge_ || rows.reached_edge;
  // nodes that left the neighbourhood of the patch carry nothing
  if (state_.step % kSearchInterval == 0) {
    kept_.clear();
    for (const ContactRow& r : rows.rows) kept_.push_back(state_.tractions.at(r.column, r.station));
    for (NodeTraction& t : state_.tractions.all()) t = {};
    for (std::size_t k = 0; k < kept_.size(); ++k)
      state_.tractions.at(rows.rows[k].column, rows.rows[k].station) = kept_[k];
  }
  auto force_of = [&](const ContactRow& row) {
    return row.area * traction_vector(state_.tractions.at(row.column, row.station), row.normal);
  };  // on the rail

  held_.clear();
  if (plan_.local()) {
    for (const ContactRow& row : rows.rows) {
      held_.push_back(force_of(row));
      spread_contact_force(rows, row, held_.back(), [&](bool is_wheel, std::ptrdiff_t i, double force) {
        (is_wheel ? f_wheel_ : f_rail_)[i] -= force;
      });
    }
    refine_forces();
  }
  gather_contact(rows);
  enforce_contact(rows, dt_, enforcement_, contact_system_, state_.tractions);
  apply_contact(rows);

  const ContactSystem& c = contact_system_;
  forces_ = {};
  forces_.sweeps = c.sweeps;
  double friction = 0, normal = 0;
  for (std::size_t k = 0; k < rows.rows.size(); ++k) {
    const ContactRow& row = rows.rows[k];
    const double p = state_.tractions.at(row.column, row.station).p;
    if (p <= 0) continue;
    const Vec3 force = force_of(row);
    Vec3 slip = -0.5 * (c.rail.before[k] + c.rail.velocity[k]);  // mean of the step, wheel against rail
    for (int w = row.first; w < row.first + row.count; ++w) {
      const int n = c.weight_node[w];
      slip += (0.5 * rows.weights[w].m) * (c.wheel.before[n] + c.wheel.velocity[n]);
    }
    forces_.x -= force.x;
    forces_.y -= force.y;
    forces_.z -= force.z;
    forces_.penetration = std::max(forces_.penetration, -row.gap);
    ++forces_.nodes;
    const double normal_slip = dot(slip, row.normal);
    normal += -row.area * p * normal_slip;
    friction += dot(force, slip) + row.area * p * normal_slip;
  }
  balance_.friction += dt_ * friction;
  balance_.contact_normal += dt_ * normal;
}

// The tractions that were found, to the forces: what local steps hold already taken off and the rest through their
// stages.
void Stepper::apply_contact(const MortarRows& rows) {
  rail_change_.clear();
  wheel_change_.clear();
  for (std::size_t k = 0; k < rows.rows.size(); ++k) {
    const ContactRow& row = rows.rows[k];
    const NodeTraction& t = state_.tractions.at(row.column, row.station);
    if (t.p <= 0 && held_.empty()) continue;
    const Vec3 force = row.area * traction_vector(t, row.normal), change = held_.empty() ? force : force - held_[k];
    spread_contact_force(rows, row, change, [&](bool is_wheel, std::ptrdiff_t i, double part) {
      if (plan_.local())
        (is_wheel ? wheel_change_ : rail_change_).push_back({i, part});
      else if (is_wheel)
        plan_.wheel.scaling.add_force(f_wheel_, i, -part);
      else
        plan_.rail.scaling.add_force(f_rail_, i, -part);
    });
  }
  if (!plan_.local()) return;
  plan_.rail.local.add_forces(rail_change_, f_rail_);
  plan_.wheel.local.add_forces(wheel_change_, f_wheel_);
}

// Update of one section node's stations begin <= j < end; f: forces by station. measured: with run-up damping and sums.
template <SweepKind kind, bool measured>
void Stepper::advance_node(const DeformableBody& body, Field& u, Field& v, SectionNode node, int begin, int end,
                           const double* const (&f)[3], Sums& sums) const {
  constexpr bool turning = kind == SweepKind::revolve;
  const BlockLayout& lay = body.solid.layout().blocks[node.block];
  const std::ptrdiff_t x = lay.line(node.node, 0), y = x + lay.stride, z = y + lay.stride;
  double *ux = u.data() + x, *uy = u.data() + y, *uz = u.data() + z, *vx = v.data() + x, *vy = v.data() + y,
         *vz = v.data() + z;
  const double *fx = f[0], *fy = f[1], *fz = f[2];
  const double* inverse_mass = body.inverse_mass.data() + x;
  const double* cosine = turning ? cos_node_[node.block].data() : nullptr;
  const double* sine = turning ? sin_node_[node.block].data() : nullptr;
  const double radius = turning ? body.solid.body().blocks[node.block].section.nodes[node.node].z : 0.0;
  const double dt = dt_, rate = rate_, cd = frame_.cos_step, sd = frame_.sin_step;
  const double push = turning ? frame_.centrifugal * radius : 0.0;
  const double gx = turning ? frame_.sin_psi * sys_.gravity : 0.0,
               gz = turning ? -frame_.cos_psi * sys_.gravity : -sys_.gravity;
  const MeanMotion mean = mean_;
  double twice_kinetic = 0, power = 0, px = 0, pz = 0, angular = 0;
  RAILSTRATA_INDEPENDENT
  for (int j = begin; j < end; ++j) {
    const double m = inverse_mass[j];
    double wx = vx[j], wy = vy[j], wz = vz[j];
    double ax = gx - m * fx[j], ay = -m * fy[j], az = gz - m * fz[j];
    if constexpr (turning) {
      ax -= push * sine[j];
      az += push * cosine[j];
    }
    [[maybe_unused]] double rx = 0, ry = 0, rz = 0;  // what the run-up damping takes off
    if constexpr (measured) {
      rx = rate * wx;
      ry = rate * wy;
      rz = rate * wz;
      if constexpr (turning) {
        rx -= rate * (mean.x + mean.spin * radius * cosine[j]);
        rz -= rate * (mean.z + mean.spin * radius * sine[j]);
      }
    }
    double bx = wx, bz = wz;  // before, in the frame of this step
    if constexpr (turning) {
      bx = cd * wx - sd * wz;
      bz = sd * wx + cd * wz;
      if constexpr (measured) {
        const double r = rx;
        rx = cd * r - sd * rz;
        rz = sd * r + cd * rz;
      }
    }
    if constexpr (measured) {
      ax -= rx;
      ay -= ry;
      az -= rz;
    }
    const double qx = bx + dt * ax, qy = wy + dt * ay, qz = bz + dt * az;
    vx[j] = qx;
    vy[j] = qy;
    vz[j] = qz;
    const double dx = ux[j] + dt * qx, dz = uz[j] + dt * qz;
    uy[j] += dt * qy;
    if constexpr (turning) {
      ux[j] = cd * dx - sd * dz;
      uz[j] = sd * dx + cd * dz;
    } else {
      ux[j] = dx;
      uz[j] = dz;
    }
    if constexpr (measured) {
      const double mass = 1 / m;
      double before_x = bx, before_z = bz, after_x = qx, after_z = qz;
      if constexpr (turning) {  // to velocities in the model frame, components of this step's frame
        const double armx = -radius * sine[j], armz = radius * cosine[j];
        const double slope_x = frame_.slope_cos * armx + frame_.slope_sin * armz,
                     slope_z = frame_.slope_cos * armz - frame_.slope_sin * armx;
        const double travel_x = frame_.cos_psi * frame_.speed, travel_z = frame_.sin_psi * frame_.speed;
        before_x += cd * slope_x - sd * slope_z + travel_x;
        before_z += sd * slope_x + cd * slope_z + travel_z;
        after_x += slope_x + travel_x;
        after_z += slope_z + travel_z;
        px += mass * qx;
        pz += mass * qz;
        angular += mass * radius * (cosine[j] * qx + sine[j] * qz);
      }
      twice_kinetic += mass * (before_x * after_x + wy * qy + before_z * after_z);
      power += 0.5 * mass * (rx * (before_x + after_x) + ry * (wy + qy) + rz * (before_z + after_z));
    }
  }
  if constexpr (measured) sums += {0.5 * twice_kinetic, power, px, pz, angular};
}

void Stepper::advance_node(bool is_wheel, SectionNode node, int begin, int end, const double* const (&f)[3],
                           Sums& sums) {
  const bool measured = rate_ > 0 || want_energy_;
  if (is_wheel && measured)
    advance_node<SweepKind::revolve, true>(sys_.wheel, state_.u_wheel, state_.v_wheel, node, begin, end, f, sums);
  else if (is_wheel)
    advance_node<SweepKind::revolve, false>(sys_.wheel, state_.u_wheel, state_.v_wheel, node, begin, end, f, sums);
  else if (measured)
    advance_node<SweepKind::extrude, true>(sys_.rail, state_.u_rail, state_.v_rail, node, begin, end, f, sums);
  else
    advance_node<SweepKind::extrude, false>(sys_.rail, state_.u_rail, state_.v_rail, node, begin, end, f, sums);
}

// The nodes that waited for the contact, and the border planes of the others.
void Stepper::advance_later() {
  const auto waiting = [](const Schedule& s) { return static_cast<std::ptrdiff_t>(s.later.size()); };
  const auto bordered = [](const Schedule& s) { return static_cast<std::ptrdiff_t>(s.bordered.size()); };
  const std::ptrdiff_t wheel_later = waiting(wheel_schedule_), wheel_all = wheel_later + bordered(wheel_schedule_),
                       rail_later = waiting(rail_schedule_), rail_all = rail_later + bordered(rail_schedule_);
  for_each(wheel_all + rail_all, [&](std::ptrdiff_t k) {
    const bool is_wheel = k < wheel_all;
    if (!is_wheel) k -= wheel_all;
    Schedule& plan = is_wheel ? wheel_schedule_ : rail_schedule_;
    const BodyLayout& layout = (is_wheel ? sys_.wheel : sys_.rail).solid.layout();
    const Field& force = is_wheel ? f_wheel_ : f_rail_;
    const bool border = k >= (is_wheel ? wheel_later : rail_later);
    if (border) k -= is_wheel ? wheel_later : rail_later;
    const SectionNode node = border ? plan.bordered[k] : plan.later[k];
    const BlockLayout& lay = layout.blocks[node.block];
    const double* line = force.data() + lay.line(node.node, 0);
    const double* const f[3] = {line, line + lay.stride, line + 2 * lay.stride};
    Sums sums;
    if (border && !want_energy_) {
      for (int j : plan.borders[node.block]) advance_node(is_wheel, node, j, j + 1, f, sums);
    } else {
      advance_node(is_wheel, node, 0, lay.stations, f, sums);
    }
    (border ? plan.border_sums : plan.later_sums)[k] = sums;
  });
  sums_ = {};
  if (rate_ == 0 && !want_energy_) return;
  Sums wheel;
  for (const Schedule* plan : {&wheel_schedule_, &rail_schedule_}) {
    Sums all;
    if (!want_energy_)
      for (const Sums& s : plan->chain_sums) all += s;
    for (const Sums& s : plan->later_sums) all += s;
    for (const Sums& s : plan->border_sums) all += s;
    if (plan == &wheel_schedule_) wheel = all;
    sums_ += all;
  }
  take_mean_motion(wheel);
}

// The run-up damping spares the mean travel along the rail and the mean spin, not the vertical motion.
void Stepper::take_mean_motion(const Sums& wheel) {
  const double travel = (frame_.cos_psi * wheel.momentum_x + frame_.sin_psi * wheel.momentum_z) / free_mass_;
  const Vec3 in_frame = frame_.to_frame({travel, 0, 0});
  mean_ = {in_frame.x, in_frame.z, wheel.angular / free_inertia_};
}

void Stepper::advance_axle() {
  const VehicleSpec& v = sys_.model.spec.vehicle;
  AxleMotion& a = state_.axle;
  const SuspensionForce spring = step_suspension(v, a.z - axle_z0_, a.vz, dt_, state_.groups);
  const double suspension = -v.sprung_mass * sys_.gravity - spring.on_masses;
  balance_.dashpot += dt_ * spring.dashpot_power;
  const double rate = rate_, moment = torque();
  const double vx = a.vx, vz = a.vz, spin = a.spin;
  a.vx += dt_ * bore_fx_ / sys_.axle.mass_x;
  a.vz += dt_ * ((bore_fz_ + suspension) / sys_.axle.mass_z - sys_.gravity - rate * a.vz);
  a.spin += dt_ * (bore_my_ + moment) / sys_.axle.inertia;
  a.x += dt_ * a.vx;
  a.z += dt_ * a.vz;
  a.psi += dt_ * a.spin;
  balance_.torque_work += dt_ * moment * 0.5 * (spin + a.spin);
  balance_.damping += dt_ * rate * sys_.axle.mass_z * vz * 0.5 * (vz + a.vz);
  axle_kinetic_ =
      0.5 * (sys_.axle.mass_x * vx * a.vx + sys_.axle.mass_z * vz * a.vz + sys_.axle.inertia * spin * a.spin);
  const double share = v.sprung_mass / static_cast<double>(state_.groups.size());
  for (const MassGroup& m : state_.groups) axle_kinetic_ += 0.5 * share * m.vz * m.vz;
}

double Stepper::weight_potential() const {
  double sum = 0;
  for (const DeformableBody::Line& l : sys_.rail.lines)
    if (l.component == 2)
      for (int j = 0; j < l.count; ++j) sum += sys_.rail.mass[l.first + j] * state_.u_rail[l.first + j];
  for (const DeformableBody::Line& l : sys_.wheel.lines) {
    if (l.component == 1) continue;
    const double z = sys_.model.wheel.blocks[l.block].section.nodes[l.node].z;
    for (int j = 0; j < l.count; ++j) {
      const double arm = l.component == 0 ? -z * sin_node_[l.block][j] : z * cos_node_[l.block][j],
                   at = arm + state_.u_wheel[l.first + j];
      sum += sys_.wheel.mass[l.first + j] * (l.component == 0 ? -frame_.sin_psi * at : frame_.cos_psi * at - arm);
    }
  }
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
  rate_ = damping_rate();
  if (want_energy_) {
    const StrainEnergy rail = sys_.rail.solid.energy(state_.u_rail, 0),
                       wheel = sys_.wheel.solid.energy(state_.u_wheel, state_.axle.psi - frame_.psi);
    balance_.strain = rail.strain + wheel.strain;
    balance_.hourglass = rail.hourglass + wheel.hourglass;
    balance_.weight = weight_potential();
    balance_.spring = spring_energy();
    rail_stretch_ = plan_.rail.scaling.differences(state_.v_rail, std::move(rail_stretch_));
    wheel_velocity_ = wheel_velocity(true, std::move(wheel_velocity_));
    wheel_stretch_ = plan_.wheel.scaling.differences(wheel_velocity_, std::move(wheel_stretch_));
  }
  internal_forces();
  plan_.rail.scaling.scale(f_rail_);
  plan_.wheel.scaling.scale(f_wheel_);
  contact();
  advance_later();
  balance_.damping += dt_ * sums_.damping;
  advance_axle();
  if (want_energy_) {
    wheel_velocity_ = wheel_velocity(false, std::move(wheel_velocity_));
    balance_.kinetic = sums_.kinetic + axle_kinetic_ + plan_.rail.scaling.kinetic(rail_stretch_, state_.v_rail) +
                       plan_.wheel.scaling.kinetic(wheel_stretch_, wheel_velocity_);
    recorded_ = halfway(before, balance_);
  }
  state_.time += dt_;
  ++state_.step;
  frame_.move_to(state_.time);
  sys_.apply_constraints(state_.u_rail, state_.u_wheel, pose_in_frame());
  want_energy_ = false;
}

std::string Stepper::check_finite() const {
  auto look = [](const DeformableBody& body, const Field& u) -> std::string {
    for (const DeformableBody::Line& l : body.lines)
      for (int j = 0; j < l.count; ++j)
        if (!std::isfinite(u[l.first + j])) {
          const Vec3 x = body.solid.reference_position(l.block, l.node, j);
          return fmt::format("{} {}, node near x = {:.1f} mm, y = {:.1f} mm, z = {:.1f} mm", body.solid.body().name,
                             body.solid.body().blocks[l.block].name, 1e3 * x.x, 1e3 * x.y, 1e3 * x.z);
        }
    return {};
  };
  const std::string rail = look(sys_.rail, state_.u_rail);
  return rail.empty() ? look(sys_.wheel, state_.u_wheel) : rail;
}

}  // namespace railstrata
