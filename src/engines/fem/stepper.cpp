#include "fem/stepper.hpp"

#include <fmt/format.h>

#include <cmath>

#include "body/field_algebra.hpp"
#include "core/faults.hpp"
#include "core/parallel.hpp"
#include "rules/support.hpp"

namespace railstrata {
namespace {

ReferenceFrame rolling_frame(const RollingSystem& sys, double dt) {
  ReferenceFrame frame;
  frame.speed = sys.on_ring() ? 0.0 : sys.spec().drive.speed;
  frame.lateral_speed = sys.options.lateral_speed;
  frame.spin = sys.start_spin;
  frame.yaw_turn = sys.wheel_surface().yaw;
  frame.set_step(dt);
  return frame;
}

// A straight rail is at rest in the model frame.
ReferenceFrame rail_frame(const RollingSystem& sys, double dt) {
  ReferenceFrame frame;
  if (!sys.on_ring()) return frame;
  frame.spin = sys.rail_spin;
  frame.set_step(dt);
  return frame;
}

bool same_sizes(const RestartState& r, const RollingSystem& sys) {
  for (std::size_t k = 0; k < sys.bodies.size(); ++k)
    if (!fits(sys.bodies[k], r.state.bodies[k])) return false;
  const ContactSurface& surface = sys.rail_surface();
  const auto surface_nodes = static_cast<std::size_t>(surface.columns) * surface.stations.nodes();
  return r.state.groups.size() == kSuspensionGroups && r.state.sleepers.size() == sys.pads.x.size() &&
         r.state.tractions.all().size() == surface_nodes && r.state.tractions.stations() == surface.stations.nodes();
}

RollingBodies rolling_bodies(const RollingSystem& sys, StepPlan& plan, const Ranks& ranks) {
  std::vector<TileCut> cuts = cut_tiles({&sys.rail(), &sys.wheel()}, ranks.count, ranks.rank);
  return {RollingBody(sys.rail(), sys.rail_surface(), plan.scaling[kRail], rail_frame(sys, plan.limits.chosen),
                      std::move(cuts[kRail])),
          RollingBody(sys.wheel(), sys.wheel_surface(), plan.scaling[kWheel], rolling_frame(sys, plan.limits.chosen),
                      std::move(cuts[kWheel]))};
}

}  // namespace

Stepper::Stepper(const RollingSystem& system, const Ranks& ranks)
    : sys_(system),
      plan_(system),
      bodies_(rolling_bodies(system, plan_, ranks)),
      contact_(system),
      track_(system.pads),
      interface_(system.rail()) {
  require_stable(system.pads, system.rail(), dt(), system.model.spec.run.step_safety);
  if (!ranks.alone()) require_support(uses::kRanks, system.model.spec);
  if (!ranks.alone()) exchange_.emplace(ranks, system.model, bodies_);
}

Stepper::Stepper(const RollingSystem& system, const PreloadResult& preload, const Ranks& ranks)
    : Stepper(system, ranks) {
  start(preload);
}

Stepper::Stepper(const RollingSystem& system, RestartState restart, const Ranks& ranks) : Stepper(system, ranks) {
  if (!same_sizes(restart, sys_)) throw CaseError("the saved state is that of another mesh", "start the run anew");
  restore_state(std::move(restart));
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    state_.bodies[k].f = sys_.bodies[k].layout.field();
    sys_.bodies[k].plastic.index(state_.bodies[k].history);
    bodies_[k].frame.move_to(state_.time);
    if (bodies_[k].turns()) bodies_[k].surface_u = state_.bodies[k].u;
  }
}

RestartState Stepper::restart_state() const {
  RestartState out = restart_beside_state();
  out.state = {state_.time, state_.step, {}, state_.axle, state_.groups, state_.sleepers, state_.tractions};
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    for (const StateArray& a : kStateArrays) out.state.bodies[k].*a.values = state_.bodies[k].*a.values;
    out.state.bodies[k].history = state_.bodies[k].history;
  }
  return out;
}

RestartState Stepper::restart_beside_state() const {
  RestartState out;
  out.balance = balance_;
  out.mean = bodies_[kWheel].mean;
  out.start = start_;
  out.dt = dt();
  contact_.save(out);
  return out;
}

void Stepper::start(const PreloadResult& preload) {
  state_.tractions = preload.tractions;
  const bool ring = sys_.on_ring();
  state_.axle = {.z = preload.axle_z,
                 .vx = ring ? 0.0 : sys_.spec().drive.speed,
                 .vy = preload.motion.lateral_speed,
                 .spin = preload.motion.spin};
  start_ = {.axle_z = preload.axle_z,
            .side_force = -preload.contact_force.y,
            .torque_ramp = preload.steady_passes > 0 ? 0.0 : sys_.spec().drive.torque_ramp};
  state_.groups.assign(kSuspensionGroups, MassGroup{});
  // of the pattern against the material: m/s, rad/s
  const double rate[2] = {ring ? sys_.rail_spin : sys_.spec().drive.speed, preload.motion.spin};
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    RollingBody& b = bodies_[k];
    BodyState& state = state_.bodies[k];
    state = BodyState(b.body);
    state.u = preload.u[k];
    state.history = preload.history[k];
    b.frame.move_to(0);
    if (b.turns()) b.surface_u = state.u;
    if (k == kRail && !preload.before.empty()) add(state.u, -1, preload.before);  // what was there does not travel
    start_velocities(b, rate[k], state);
    if (k == kWheel)
      add_rigid_motion(
          b, {preload.motion.spin - sys_.start_spin, preload.motion.lateral_speed - sys_.options.lateral_speed}, state);
    state.u = preload.u[k];
    if (k == kRail) state_.sleepers = sleepers_below(sys_.pads, state.u, state.v);
    if (k == kWheel) b.mean = mean_motion(b, state);  // a ring has nothing to keep: its shaft turns it
  }
}

double Stepper::damping_rate() const {
  const RunSpec& run = sys_.spec().run;
  const double run_up = *run.run_up;
  return run_up > 0 ? run.run_up_damping * (1 - smooth_rise(position() / run_up)) : 0;
}

// Rotation of each body relative to its frame.
std::array<double, 2> Stepper::drift() const { return {0.0, state_.axle.psi - bodies_[kWheel].frame.psi}; }

AxlePose Stepper::pose() const {
  AxlePose out = state_.axle.pose();
  out.rail_psi = bodies_[kRail].frame.psi;
  return out;
}

AxlePose Stepper::pose_in_frame() const {
  const ReferenceFrame& frame = bodies_[kWheel].frame;
  const Vec3 at = frame.to_frame({state_.axle.x - frame.x, state_.axle.y - frame.y, state_.axle.z});
  return {at.x, at.y, at.z, state_.axle.psi - frame.psi};
}

AxleDrive Stepper::axle_drive() const {
  return {drive_torque(sys_, state_.time, start_.torque_ramp), start_.side_force};
}

double Stepper::lateral_creepage() const {
  const RigidContact& contact = sys_.model.reference;
  const AxleMotion& a = state_.axle;
  return (a.vy - a.spin * contact.rolling_radius * std::tan(contact.yaw)) / (speed() * std::cos(contact.angle));
}

void Stepper::step() {
  if (engine_) return step_on_engine();
  const EnergyBalance before = balance_;
  const PlasticLook look = state_.step % kLookInterval == 0 ? PlasticLook::all : PlasticLook::awake;
  const StepScope scope{dt(), sys_.gravity, damping_rate(), want_energy_, look, laps_};
  if (laps_) laps_->start();
  const std::array<double, 2> turned = drift();
  const AxlePose pose = this->pose();

  if (state_.step % kExtendInterval == 0) extend_hot_elements(turned);
  if (exchange_) {
    exchange_->mark(state_.time, state_.axle.z);
    exchange_->prepare(bodies_, state_.bodies, scope, pose);
  }
  evaluate_elements(bodies_, state_.bodies, turned, scope, exchange());
  scope.lap(StepPart::planes);
  if (want_energy_) book_stored_energy(turned);
  const std::array<double, 2> tie_moment = reduce_ties(turned);
  scope.lap(StepPart::tie_forces);
  if (!sys_.pads.none())
    track_.press(state_.bodies[kRail].u, state_.bodies[kRail].v, dt(), state_.sleepers, state_.bodies[kRail].f);
  interface_.join(state_.bodies[kRail].f);
  absorb_at_ends();
  const AxleLoads loads = bore_loads(sys_.axle.bore, state_.bodies[kWheel].f, rotation_by(turned[kWheel]),
                                     tie_moment[kWheel], bodies_[kWheel].frame);
  if (sys_.on_ring()) book_ring_drive(tie_moment[kRail]);
  for (std::size_t k = 0; k < bodies_.size(); ++k) bodies_[k].scaling.scale(state_.bodies[k].f);
  press_interface(scope);
  scope.lap(StepPart::ends);

  contact_.find_rows(state_.step, bodies_, state_.bodies, pose, state_.tractions);
  scope.lap(StepPart::rows);
  contact_.gather(bodies_, state_.bodies, scope);
  contact_.enforce(scope.dt, state_.tractions);
  contact_.apply_tractions(bodies_, state_.bodies, state_.tractions);
  const ContactLosses lost = contact_.measure(scope.dt, state_.tractions);
  balance_.friction += scope.dt * lost.friction;
  balance_.contact_normal += scope.dt * lost.normal;
  scope.lap(StepPart::contact);

  update_waiting_nodes(bodies_, state_.bodies, scope);
  if (!sys_.pads.none()) book_track();
  scope.lap(StepPart::waiting);
  sums_ = update_sums(bodies_, scope, exchange());
  book_update(scope);
  const double axle_kinetic = advance_axle(axle_law(sys_, start_.axle_z), loads, axle_drive(), scope.dt,
                                           scope.damping_rate, state_.axle, state_.groups, balance_);
  if (want_energy_) {
    book_kinetic_energy(axle_kinetic + track_.kinetic());
    recorded_ = halfway(before, balance_);
  }
  advance_clock();
  sys_.apply_constraints(state_.bodies[kRail].u, state_.bodies[kWheel].u, pose_in_frame(),
                         {bodies_[kRail].part, bodies_[kWheel].part});
  scope.lap(StepPart::constraints);
  want_energy_ = false;
}

void Stepper::complete() {
  fetch();
  if (exchange_) exchange_->complete(bodies_, state_.bodies);
}

void Stepper::extend_hot_elements(const std::array<double, 2>& turned) {
  if (!sys_.rail().plastic.empty() || !sys_.wheel().plastic.empty()) complete();
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    bodies_[k].elements.begin(state_.bodies[k].u, turned[k]);  // the ghosts of a ring
    extend_plastic_elements(bodies_[k].body, state_.bodies[k].u, turned[k], state_.bodies[k].history);
  }
}

// At u(n) and v(n-1/2); elements read what they have committed.
void Stepper::book_stored_energy(const std::array<double, 2>& turned) {
  balance_.strain = balance_.hourglass = balance_.plastic = 0;
  double weight = 0;
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    RollingBody& b = bodies_[k];
    BodyState& state = state_.bodies[k];
    const StrainEnergy energy = b.elements.energy(state.u, turned[k], state.history);
    balance_.strain += energy.strain;
    balance_.hourglass += energy.hourglass;
    balance_.plastic += plastic_work(b.body, state.history);
    weight = add_weight_moment(b, state, weight);
    b.stretch = b.scaling.differences(frame_velocity(b, state, true), std::move(b.stretch));
  }
  balance_.weight = sys_.gravity * (weight + sys_.axle.mass_z * state_.axle.z);
  for (const EndLoad& l : sys_.end_loads) balance_.weight -= l.force * state_.bodies[kRail].u[l.index];
  balance_.spring = spring_energy(axle_law(sys_, start_.axle_z), state_.axle.z, state_.groups);
}

// Forces on slaves go to their masters; returns what the offsets hand to the rotation of a body that turns.
std::array<double, 2> Stepper::reduce_ties(const std::array<double, 2>& turned) {
  const TiedField tied[] = {{.ties = sys_.rail().ties, .values = state_.bodies[kRail].f, .part = bodies_[kRail].part},
                            {.ties = sys_.wheel().ties,
                             .values = state_.bodies[kWheel].f,
                             .turn = rotation_by(turned[kWheel]),
                             .part = bodies_[kWheel].part}};
  if (!sys_.on_ring()) return {0.0, collect_ties(tied)};
  return {collect_ties({&tied[kRail], 1}), collect_ties({&tied[kWheel], 1})};
}

// The work of the shaft that keeps the ring's spin.
void Stepper::book_ring_drive(double tie_moment) {
  const ReferenceFrame& frame = bodies_[kRail].frame;
  balance_.guide_work -=
      dt() * sys_.rail_spin * bore_loads(sys_.rail_bore, state_.bodies[kRail].f, {}, tie_moment, frame).moment;
}

void Stepper::absorb_at_ends() {
  BodyState& rail = state_.bodies[kRail];
  double absorbed = 0;
  for (const EndDashpot& d : sys_.absorbers) {
    double v = rail.v[d.index];
    // the mean of those before and after the update: stable at any coefficient, hence on coarse ends too
    if (!sys_.pads.none()) {
      const double mobility = dt() * sys_.rail().inverse_mass[d.index], half = 0.5 * d.coefficient * mobility;
      v = (v - 0.5 * mobility * rail.f[d.index]) / (1 + half);
    }
    rail.f[d.index] += d.coefficient * v;
    absorbed += d.coefficient * v * v;
  }
  balance_.absorbed += dt() * absorbed;
  for (const EndLoad& l : sys_.end_loads) rail.f[l.index] -= l.force;
}

// Springs and dashpots of the track stand with the suspension's.
void Stepper::book_track() {
  const TrackLosses losses = track_.losses(state_.bodies[kRail].v);
  balance_.dashpot += losses.pads + losses.ballast;
  if (want_energy_) balance_.spring += track_.elastic();
}

// The absorbers have come to both sides of the end planes since the sides were joined.
void Stepper::press_interface(const StepScope& scope) {
  BodyState& rail = state_.bodies[kRail];
  interface_.join(rail.f);
  const InterfaceLosses losses = interface_.press(rail.u, rail.v, scope.dt, damping_of(bodies_[kRail], scope), rail.f);
  balance_.friction += losses.friction;
  balance_.contact_normal += losses.normal;
}

// Damping losses of the update, and the mean motion that the next step's damping spares.
void Stepper::book_update(const StepScope& scope) {
  balance_.damping += scope.dt * (sums_[kWheel].damping + sums_[kRail].damping);
  if (scope.sums_wanted()) bodies_[kWheel].mean = mean_motion(bodies_[kWheel], sums_[kWheel]);
}

void Stepper::book_kinetic_energy(double axle) {
  balance_.kinetic = sums_[kWheel].kinetic + sums_[kRail].kinetic + axle;
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    RollingBody& b = bodies_[k];
    balance_.kinetic += b.scaling.kinetic(b.stretch, frame_velocity(b, state_.bodies[k], false));
  }
}

void Stepper::advance_clock() {
  state_.time += dt();
  ++state_.step;
  for (RollingBody& b : bodies_) b.frame.move_to(state_.time);
}

Field Stepper::displacement(BodyId body) const {
  return model_displacement(bodies_[index_of(body)], state_.bodies[index_of(body)]);
}

double Stepper::largest_pressure() const {
  if (engine_) return record_.largest_pressure;
  double p = 0;
  for (const NodeTraction& t : state_.tractions.all()) p = std::max(p, t.p);
  return p;
}

std::string Stepper::check_finite() const {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const Body& body = sys_.bodies[k];
    for (const NodeLine& l : body.lines)
      for (int j = 0; j < l.count; ++j) {
        if (std::isfinite(state_.bodies[k].u[l.first + j])) continue;
        const Vec3 x = reference_position(body, l.block, l.node, j);
        return fmt::format("{} {}, node near x = {:.1f} mm, y = {:.1f} mm, z = {:.1f} mm", body.mesh.name,
                           body.mesh.blocks[l.block].name, 1e3 * x.x, 1e3 * x.y, 1e3 * x.z);
      }
  }
  return {};
}

}  // namespace railstrata
