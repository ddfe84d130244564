#pragma once
// Explicit rolling: central differences with half-step velocities.
//
//   v(n+1/2) = v(n-1/2) + dt a(n),   u(n+1) = u(n) + dt v(n+1/2),   m a = contact + weight - internal forces -
//   absorbers - run-up damping
// The wheel's nodes are followed in a reference frame that travels and turns uniformly, with the speed V and the spin
// omega of the start: with X a node's arm from the axle, R the frame's rotation, D = R(omega dt) that of one step,
//   x(n) = V t e_x + R(n) (X + d(n)),   w(n+1/2) = (D d(n+1) - d(n))/dt
//   w(n+1/2) = D^T w(n-1/2) + dt (R^T a + 2 (1 - cos omega dt)/dt^2 P X),   d(n+1) = D^T (d(n) + dt w(n+1/2))
// (P: projector normal to the axle). It is the same scheme exactly, and d stays as small as the deformation and the
// drift from uniform rolling: no digits are lost to the rigid motion, not even by elements in single precision.
//
// Nodes whose forces come from their elements alone are updated as soon as a tile has finished their forces, while
// everything is in cache; the running surface, tied lines and the tiles' border planes follow after the contact. The
// axle turns with the bore's forces, the torque and the suspension. Run-up damping acts on vibration only: on
// velocities relative to the rigid rolling motion, with a rate that fades to zero: the mean travel and spin of the
// wheel's free nodes are the reference, so that it takes neither momentum along x nor angular momentum.
#include "fem/preload.hpp"
#include "fem/rolling_system.hpp"
#include "fem/step_plan.hpp"
#include "fem/suspension.hpp"

namespace railstrata {

/// Work and energy since the start of the rolling [J]. Closure: kinetic + strain + hourglass + weight + spring +
/// dissipated = their start + torque_work.
struct EnergyBalance {
  double kinetic = 0, strain = 0, hourglass = 0;
  double weight = 0;  ///< potential of gravity
  double spring = 0;  ///< suspension springs, with their static force
  double torque_work = 0;
  double friction = 0;        ///< dissipated by sliding
  double contact_normal = 0;  ///< lost in the normal direction of the contact
  double damping = 0;         ///< run-up damping
  double absorbed = 0;        ///< end absorbers
  double dashpot = 0;         ///< suspension dashpots
  double total() const {
    return kinetic + strain + hourglass + weight + spring + friction + contact_normal + damping + absorbed + dashpot -
           torque_work;
  }
};

struct AxleMotion {
  double x = 0, z = 0,
         psi = 0;  ///< displacement from the start of the rolling's reference (rigid contact position), spin angle
  double vx = 0, vz = 0, spin = 0;  ///< half-step velocities
};

/// Uniform travel and turn.
struct ReferenceFrame {
  double speed = 0, spin = 0;
  double x = 0, cos_psi = 1, sin_psi = 0, psi = 0;
  double cos_step = 1, sin_step = 0;    ///< of the turn in one step
  double centrifugal = 0;               ///< 2 (1 - cos omega dt)/dt^2
  double slope_cos = 0, slope_sin = 0;  ///< (cos omega dt - 1)/dt, sin omega dt/dt
  void set_step(double dt);
  void move_to(double time);
  Vec3 to_model(Vec3 v) const { return {cos_psi * v.x + sin_psi * v.z, v.y, cos_psi * v.z - sin_psi * v.x}; }
  Vec3 to_frame(Vec3 v) const { return {cos_psi * v.x - sin_psi * v.z, v.y, sin_psi * v.x + cos_psi * v.z}; }
  Vec3 step_back(Vec3 v) const {
    return {cos_step * v.x - sin_step * v.z, v.y, sin_step * v.x + cos_step * v.z};
  }  ///< D^T v
  Vec3 rigid_rate(Vec3 arm) const {
    return {slope_cos * arm.x + slope_sin * arm.z, 0, slope_cos * arm.z - slope_sin * arm.x};
  }  ///< (D - 1) X / dt
};

/// The only thing that changes. Wheel: displacements d and velocities w relative to the reference frame; rail: model
/// frame.
struct RollingState {
  double time = 0;
  long step = 0;
  Field u_rail, v_rail, u_wheel, v_wheel;
  AxleMotion axle;
  std::vector<MassGroup> groups;
  SurfaceTractions tractions{0, 0};
};

/// Forces of the last step, on the wheel [N]; slip and penetration of its contact.
struct ContactForces {
  double x = 0, y = 0, z = 0;
  double penetration = 0;  ///< m, largest at the start of the step among nodes that carry pressure
  int nodes = 0, sweeps = 0;
};

/// Mean motion of the wheel's free nodes relative to the reference frame, in its components.
struct MeanMotion {
  double x = 0, z = 0, spin = 0;
};

/// All that a step takes over from the one before, where the contact is searched anew. A stepper that goes on from it
/// computes the same bits as the one that gave it.
struct StepperMemory {
  RollingState state;
  EnergyBalance balance;
  MeanMotion mean;
  std::vector<MortarContact::Facet> facets;
  double axle_z0 = 0;  ///< m, height of the axle at the start of the rolling
  double dt = 0;       ///< s
  bool reached_edge = false;
};

class Stepper {
 public:
  /// Starts from the static solution with the rolling speed; the pattern of deformation travels with the wheel from the
  /// first step on: v_rail = -V du/dx, v_wheel = V e_x + omega x (X - axle) - omega du/dtheta.
  Stepper(const RollingSystem& system, const PreloadResult& preload);
  /// Goes on where memory() was taken. Throws CaseError if the memory is not that of a system of this size.
  Stepper(const RollingSystem& system, StepperMemory memory);

  void step();
  /// memory() may be taken now: every sixteen steps.
  bool can_be_remembered() const;
  StepperMemory memory() const;

  const RollingState& state() const { return state_; }
  /// Of the wheel, model frame, u = x - X.
  Field wheel_displacement() const;
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
  /// What an update adds up.
  struct Sums {
    double kinetic = 0, damping = 0;                     // energy, power
    double momentum_x = 0, momentum_z = 0, angular = 0;  // of w, wheel only
    Sums& operator+=(const Sums& o) {
      kinetic += o.kinetic;
      damping += o.damping;
      momentum_x += o.momentum_x;
      momentum_z += o.momentum_z;
      angular += o.angular;
      return *this;
    }
  };
  /// How a body's nodes are updated: as soon as their forces are complete, or after the contact.
  struct Schedule {
    std::vector<std::vector<char>> at_once;  // per block and section node
    std::vector<SectionNode> later;          // free nodes that wait
    std::vector<SectionNode> bordered;       // nodes updated at once, but for the border planes
    int chains_wanted = 0;                   // what chains and borders were made for
    std::vector<Solid::Chain> chains;  // as many as keep the threads busy; single tiles if sums are wanted, whose bits
                                       // are not to depend on the threads
    std::vector<std::vector<int>> borders;  // per block, border stations
    std::vector<Sums> chain_sums, later_sums, border_sums;
  };

  explicit Stepper(const RollingSystem& system);
  void prepare();
  void start(const PreloadResult& preload);
  Schedule schedule(const DeformableBody& body, const ContactSurface& surface, const BodySteps& steps) const;
  void chain_tiles(const DeformableBody& body, Schedule& schedule) const;
  void internal_forces();
  void contact();
  void gather_contact(const MortarRows& rows);
  void apply_contact(const MortarRows& rows);
  void refine_forces();
  template <class Add>
  void spread_contact_force(const MortarRows& rows, const ContactRow& row, Vec3 force, Add&& add);
  template <SweepKind kind, bool measured>
  void advance_node(const DeformableBody& body, Field& u, Field& v, SectionNode node, int begin, int end,
                    const double* const (&f)[3], Sums& sums) const;
  void advance_node(bool is_wheel, SectionNode node, int begin, int end, const double* const (&f)[3], Sums& sums);
  void advance_later();
  Vec3 wheel_arm(std::ptrdiff_t surface_index) const;
  void lift_wheel_surface();
  Field wheel_velocity(bool before, Field reuse) const;
  void take_mean_motion(const Sums& sums);
  void advance_axle();
  Vec3 free_acceleration(bool is_wheel, std::ptrdiff_t surface_index) const;
  AxlePose pose() const { return {state_.axle.x, state_.axle.z, state_.axle.psi}; }
  AxlePose pose_in_frame() const;
  double weight_potential() const;
  double spring_energy() const;

  const RollingSystem& sys_;
  RollingState state_;
  ReferenceFrame frame_;
  MortarContact contact_;
  WheelNumbering numbering_;
  ContactSystem contact_system_;
  EnforcementOptions enforcement_;
  std::vector<Vec3> held_;  // forces of the rows that local steps have felt already
  std::vector<NodalForce> rail_change_, wheel_change_;
  ContactForces forces_;
  EnergyBalance balance_, recorded_;
  StepPlan plan_;
  double dt_ = 0;
  Field f_rail_, f_wheel_;
  Field wheel_surface_u_;  // model frame, valid on the wheel's surface lines
  Schedule rail_schedule_, wheel_schedule_;
  double bore_fx_ = 0, bore_fz_ = 0, bore_my_ = 0;
  double axle_z0_ = 0;
  double axle_kinetic_ = 0;
  bool want_energy_ = false, reached_edge_ = false;
  // memory that one step leaves to the next
  std::vector<NodeTraction> kept_;
  Field rail_stretch_, wheel_stretch_, wheel_velocity_;
  double rate_ = 0;  // run-up damping of this step
  Sums sums_;        // of this step
  MeanMotion mean_;
  double free_mass_ = 0, free_inertia_ = 0;               // of the wheel's free nodes
  std::vector<std::vector<double>> cos_node_, sin_node_;  // per wheel block and station
};

}  // namespace railstrata
