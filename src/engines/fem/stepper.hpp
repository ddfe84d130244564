#pragma once
// Explicit rolling: central differences with half-step velocities.
//
//   v(n+1/2) = v(n-1/2) + dt a(n),   u(n+1) = u(n) + dt v(n+1/2)
//   m a = contact + weight - internal forces - absorbers - run-up damping
// The wheel's nodes are followed in a reference frame that travels and turns uniformly, with the speed V and the spin
// omega of the start: with X a node's arm from the axle, R the frame's rotation, D = R(omega dt) that of one step,
//   x(n) = V t e_x + R(n) (X + d(n)),   w(n+1/2) = (D d(n+1) - d(n))/dt
//   w(n+1/2) = D^T w(n-1/2) + dt (R^T a + 2 (1 - cos omega dt)/dt^2 P X),   d(n+1) = D^T (d(n) + dt w(n+1/2))
// (P: projector normal to the axle). It is the same scheme exactly, and d stays as small as the deformation and the
// drift from uniform rolling: no digits are lost to the rigid motion, not even by elements in single precision. A rail
// that is a ring is followed likewise about its own axle, with the spin -V/R; both frames then travel nowhere.
//
// Nodes whose forces come from their elements alone are updated as soon as a tile has finished their forces, while
// everything is in cache, those between chains when all have run; running surface and tied lines follow the contact.
// The axle turns with the bore's forces, the torque and the suspension. Run-up damping acts on vibration only: on
// velocities relative to the rigid rolling motion, with a rate that fades to zero: the mean travel and spin of the
// wheel's free nodes are the reference, so that it takes neither momentum along x nor angular momentum.
#include <optional>
#include <span>
#include <string>

#include "fem/axle_step.hpp"
#include "fem/contact_step.hpp"
#include "fem/energy.hpp"
#include "fem/interface_step.hpp"
#include "fem/preload.hpp"
#include "fem/rank_exchange.hpp"
#include "fem/rolling_state.hpp"
#include "fem/rolling_system.hpp"
#include "fem/step_engine.hpp"
#include "fem/step_plan.hpp"
#include "fem/track_step.hpp"

namespace railstrata {

class Stepper {
 public:
  /// Starts from the static solution with the rolling speed; the pattern of deformation travels with the wheel from the
  /// first step on: v_rail = -V du/dx, v_wheel = V e_x + omega x (X - axle) - omega du/dtheta.
  /// ranks: that share the steps; all make a stepper and call the same functions in the same order. Throws CaseError if
  /// there are more of them than tiles.
  Stepper(const RollingSystem& system, const PreloadResult& preload, const Ranks& ranks = {});
  /// Goes on where the restart state was taken, by any number of ranks. Throws CaseError if it is not that of a system
  /// of this size.
  Stepper(const RollingSystem& system, RestartState restart, const Ranks& ranks = {});
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;

  /// From now on the engine has the fields: state().bodies and what is made of them are old between a step and
  /// complete(). One rank only.
  void use(const EngineOf& engine_of);

  void step();
  /// Until the wheel is at `position` [m], or a restart point, the caller reads scalars alone after a step: time,
  /// position, creepage and forces. An engine may be so many steps ahead; complete() is for later.
  void check_next_at(double position) { next_look_ = position; }
  /// Makes the state whole, with what only other ranks or the engine know. To be called before the state of a whole
  /// body is read: restart_state(), displacement(), samples. All ranks call it.
  void complete();
  /// A restart state may be taken now: where the contact is searched anew.
  bool is_restart_point() const { return state_.step % ContactStep::kSearchInterval == 0; }
  RestartState restart_state() const;

  const RollingState& state() const { return state_; }
  /// Displacements in the model frame, u = x - X.
  Field displacement(BodyId body) const;
  const ContactForces& forces() const { return engine_ ? record_.forces : contact_.forces(); }
  /// Pa, of the last step; of an engine's steps too.
  double largest_pressure() const;
  const RollingSystem& system() const { return sys_; }
  double dt() const { return plan_.limits.chosen; }
  /// Position of the wheel, m from the start; on a ring the arc that has passed below it.
  double position() const { return sys_.on_ring() ? speed() * state_.time : state_.axle.x; }
  /// V, m/s, of the wheel along the rail.
  double speed() const { return sys_.on_ring() ? sys_.spec().drive.speed : state_.axle.vx; }
  /// Rigid slip of wheel against rail over the speed, (V - omega r)/V: negative when driving.
  double creepage() const { return (speed() - state_.axle.spin * sys_.model.reference.rolling_radius) / speed(); }
  /// Of the axle and of a rail that is a ring, model frame.
  AxlePose pose() const;
  /// Rigid slip in the contact plane over the speed, positive where the wheel slides to the field side.
  double lateral_creepage() const;
  double torque() const { return axle_drive().torque; }
  double damping_rate() const;
  /// Energies at the beginning of the last step (kinetic energy v(n-1/2).v(n+1/2)/2, exact for the scheme).
  const EnergyBalance& energy() const { return recorded_; }
  /// Ask for the energies with the next step.
  void want_energy() { want_energy_ = true; }
  /// Between layers that have come off and their base.
  InterfaceGap interface_gap() const { return interface_.gap(state_.bodies[kRail].u); }
  /// Time the parts of the steps that follow; nullptr: no more.
  void time_parts(StepLaps* laps) { laps_ = laps; }
  bool reached_edge() const { return engine_ ? record_.reached_edge : contact_.reached_edge(); }
  /// First node whose displacement is not finite, described; empty if all is well.
  std::string check_finite() const;

  const StepPlan& plan() const { return plan_; }

 private:
  Stepper(const RollingSystem& system, const Ranks& ranks);
  void fetch();
  void start(const PreloadResult& preload);
  std::array<double, 2> drift() const;
  AxleDrive axle_drive() const;
  AxlePose pose_in_frame() const;
  RankExchange* exchange() { return exchange_ ? &*exchange_ : nullptr; }
  void extend_hot_elements(const std::array<double, 2>& turned);
  void book_stored_energy(const std::array<double, 2>& drift);
  std::array<double, 2> reduce_ties(const std::array<double, 2>& drift);
  void book_ring_drive(double tie_moment);
  void absorb_at_ends();
  void book_track();
  void press_interface(const StepScope& scope);
  void step_on_engine();
  void take_over(const StepRecord& record);
  int steps_until_look() const;
  void require_none_ahead() const;
  RestartState restart_beside_state() const;  // all but the state itself
  RestartState release_state();
  void restore_state(RestartState restart);
  void book_update(const StepScope& scope);
  void book_kinetic_energy(double axle);
  void advance_clock();

  const RollingSystem& sys_;
  StepPlan plan_;
  RollingState state_;
  RollingBodies bodies_;
  std::optional<RankExchange> exchange_;  // none: one rank
  ContactStep contact_;
  TrackStep track_;
  InterfaceStep interface_;
  EnergyBalance balance_, recorded_;
  std::array<UpdateSums, 2> sums_;  // of this step
  RollingStart start_;
  bool want_energy_ = false;
  StepLaps* laps_ = nullptr;
  std::unique_ptr<StepEngine> engine_;
  std::span<const StepRecord> ahead_;  // steps that the engine has taken and this has not
  StepRecord record_;                  // of the last one
  double next_look_ = 0;               // m
  bool fields_here_ = true;
};

}  // namespace railstrata
