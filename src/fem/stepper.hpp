#pragma once
// Explicit rolling: central differences with half-step velocities.
//
//   v(n+1/2) = v(n-1/2) + dt a(n),   u(n+1) = u(n) + dt v(n+1/2),   m a = contact + weight - internal forces - absorbers - run-up damping
// The axle turns with the bore's forces, the torque and the suspension. Run-up damping acts on vibration only: on velocities relative to the rigid rolling motion,
// with a rate that fades to zero: the mean travel and spin of the wheel's free nodes are the reference, so that it takes neither momentum along x nor angular momentum.
#include "fem/preload.hpp"
#include "fem/rolling_system.hpp"
#include "fem/step_plan.hpp"
#include "fem/suspension.hpp"

namespace railstrata {

/// Work and energy since the start of the rolling [J]. Closure: kinetic + strain + hourglass + weight + spring + dissipated = their start + torque_work.
struct EnergyBalance {
  double kinetic = 0, strain = 0, hourglass = 0;
  double weight = 0;          ///< potential of gravity
  double spring = 0;          ///< suspension springs, with their static force
  double torque_work = 0;
  double friction = 0;        ///< dissipated by sliding
  double contact_normal = 0;  ///< lost in the normal direction of the contact
  double damping = 0;         ///< run-up damping
  double absorbed = 0;        ///< end absorbers
  double dashpot = 0;         ///< suspension dashpots
  double total() const { return kinetic + strain + hourglass + weight + spring + friction + contact_normal + damping + absorbed + dashpot - torque_work; }
};

struct AxleMotion {
  double x = 0, z = 0, psi = 0;     ///< displacement from the start of the rolling's reference (rigid contact position), spin angle
  double vx = 0, vz = 0, spin = 0;  ///< half-step velocities
};

/// The only thing that changes.
struct RollingState {
  double time = 0;
  long step = 0;
  Field u_rail, v_rail, u_wheel, v_wheel;
  AxleMotion axle;
  std::vector<MassGroup> groups;
  TractionMemory tractions{0, 0};
};

/// Forces of the last step, on the wheel [N]; slip and penetration of its contact.
struct ContactForces {
  double x = 0, y = 0, z = 0;
  double penetration = 0;      ///< m, largest at the start of the step among nodes that carry pressure
  int nodes = 0, sweeps = 0;
};

class Stepper {
 public:
  /// Starts from the static solution with the rolling speed; the pattern of deformation travels with the wheel from the first step on:
  /// v_rail = -V du/dx, v_wheel = V e_x + omega x (X - axle) - omega du/dtheta.
  Stepper(const RollingSystem& system, const PreloadResult& preload);

  void step();

  const RollingState& state() const { return state_; }
  const ContactForces& forces() const { return forces_; }
  const RollingSystem& system() const { return sys_; }
  double dt() const { return dt_; }
  /// Position of the wheel, m from the start.
  double position() const { return state_.axle.x; }
  /// Rigid slip of wheel against rail over the speed, (V - omega r)/V: negative when driving.
  double creepage() const { return (state_.axle.vx - state_.axle.spin * sys_.rolling_radius) / state_.axle.vx; }
  double torque() const;
  double damping_rate() const;
  /// Energies at the beginning of the last step (kinetic energy v(n-1/2).v(n+1/2)/2, exact for the scheme).
  const EnergyBalance& energy() const { return recorded_; }
  /// Ask for the energies with the next step.
  void want_energy() { want_energy_ = true; }
  bool reached_edge() const { return reached_edge_; }
  /// First node whose displacement is not finite, described; empty if all is well.
  std::string check_finite() const;

  const StepPlan& plan() const { return plan_; }

 private:
  void start(const PreloadResult& preload);
  void internal_forces();
  void contact();
  void advance(DeformableBody const& body, Field& u, Field& v, const Field& f, bool is_wheel, double& kinetic, double& damping_power);
  void measure_rigid_motion();
  void advance_axle();
  Vec3 free_acceleration(const DeformableBody& body, const Field& f, std::ptrdiff_t index, int stride) const;
  AxlePose pose() const { return {state_.axle.x, state_.axle.z, state_.axle.psi}; }
  double weight_potential() const;
  double spring_energy() const;

  const RollingSystem& sys_;
  RollingState state_;
  MortarContact contact_;
  WheelNumbering numbering_;
  ContactSystem contact_system_;
  EnforcementOptions enforcement_;
  ContactForces forces_;
  EnergyBalance balance_, recorded_;
  StepPlan plan_;
  double dt_ = 0;
  Field f_rail_, f_wheel_;
  double bore_fx_ = 0, bore_fz_ = 0, bore_my_ = 0;
  double axle_z0_ = 0;
  double axle_kinetic_ = 0;
  bool want_energy_ = false, reached_edge_ = false;
  double old_spin_ = 0;
  std::vector<double> line_kinetic_, line_damping_;
  double mean_travel_ = 0, mean_spin_ = 0;                // of the wheel's free nodes (run-up only)
  std::vector<std::vector<double>> cos_node_, sin_node_;  // per wheel block and station, of theta - psi (run-up only)
};

}  // namespace railstrata
