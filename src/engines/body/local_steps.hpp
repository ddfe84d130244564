#pragma once
// Local time steps for thin or stiff parts of a body: leap-frog whose step the rest of the mesh allows, with p inner
// steps where elements are fast, real masses.
//
// Central differences u(n+1) - 2 u(n) + u(n-1) = D^2 a(u(n)) are exact but for the even part of the motion about t_n,
// z(tau) = (u(t_n + tau) + u(t_n - tau))/2 with u(n+1) + u(n-1) = 2 z(D). Local steps solve z'' = a(u_n + P (z - u_n)),
// z(0) = u_n, z'(0) = 0 over D, where P keeps the fine nodes alone: what the others feel from their own neighbours
// stays frozen. With d = z - u_n, p stages [DiazGrote2009], damped by nu as in [GroteMichelSauter2021]:
//   d_1 = D^2/(omega delta) a(u_n),   d_(k+1) = (1 + b_k) d_k - b_k d_(k-1) + 2 D^2/omega c_k a(u_n + P d_k),
//   delta = 1 + nu/p^2, omega = 2 T_p'(delta)/T_p(delta), b_k = T_(k-1)/T_(k+1), c_k = T_k/T_(k+1) at delta (Chebyshev
//   polynomials of the first kind)
// and a_eff = 2 d_p/D^2 takes the place of the acceleration in the usual update. a_eff = -B K u with B symmetric, so
// central differences conserve v(n-1/2).M v(n+1/2)/2 + u.M B K u/2 and are stable for 0 < D^2 lambda(B K) < 4, which is
// looked up by Lanczos steps. Forces that are frozen over the step (contact, absorbers, damping) are part of a(u_n),
// and K u = F is at rest whatever B is: statics are those of the real masses and so is the inertia of all that the step
// resolves. A fast mode, omega D >> 1, keeps its static compliance but oscillates with D^2 lambda anywhere in 2 (1 -+
// 1/cosh sqrt(2 nu)): the usual nu = 0.01, enough for stability, leaves [0.02, 3.98] and with it spurious slow modes of
// forty steps a period that loads of that duration excite (a pulse of 50 steps in a layer: 4 % error); nu = 0.5 leaves
// [0.7, 3.3] at 15 % more stages and 0.2 % error. Without damping the ends 0 and 4 are touched. Contact: tractions
// change from step to step, and what the contact asks of the surface at the end of the step must be what the stages
// then give. They first run with the tractions of the last step; what has to change is found with the stages' own
// answer to impulses on the surface (surface_response), and runs through them in turn (add_forces). A change of f moves
// velocities by D B M^-1 f, nothing else. Work: 2 p more evaluations of the elements that touch a fine node.
#include <memory>

#include "body/traversal.hpp"
#include "contact/surface.hpp"
#include "contact/surface_response.hpp"

namespace railstrata {

inline constexpr double kStageDamping = 0.5;  ///< nu

/// Chebyshev coefficients of p stages.
struct Stages {
  explicit Stages(int count, double damping = kStageDamping);
  int count;
  double delta, omega;
  std::vector<double> b, c;  ///< [k], k = 1 … count - 1
  /// Largest D^2 lambda of a wholly fine body, omega (1 + delta): about 4 count^2.
  double reach() const { return omega * (1 + delta); }
};

/// Accelerations that act beside the forces, as they stand in the update of a body's nodes: uniform + centrifugal * arm
/// from the axle (revolved bodies).
struct FrozenAcceleration {
  Vec3 uniform;            ///< m/s²: gravity
  double centrifugal = 0;  ///< 1/s²
};

/// Force on one component of a node; index into the body's fields.
struct NodalForce {
  std::ptrdiff_t index;
  double value;  ///< N
};

class LocalSteps {
 public:
  /// No fine nodes.
  LocalSteps() = default;
  /// Fine: all nodes of section quadrilaterals that a pressure wave crosses along an edge in less than `wanted_step`
  /// over kSlack.
  LocalSteps(const Body& body, const ElementOptions& options, double wanted_step);

  bool empty() const { return !part_; }
  /// The section node touches a fine node: its forces change.
  bool acts_on(int block, int node) const { return !empty() && acts_on_[block][node]; }
  /// Settles the step D [s]: the number of stages that the body's own stable step [s] asks for.
  void set_step(double step, double body_step, double damping = kStageDamping);
  double step() const { return step_; }
  int stages() const { return empty() ? 1 : stages_.count; }
  long fine_elements() const;  ///< that touch a fine node: evaluated in every inner step

  /// f: internal and frozen forces at u, accelerations -f/m + frozen. Leaves -m (a_eff - frozen), so that the usual
  /// update with `frozen` gives a_eff. psi: rotation of the body. Nodes that it does not act on are left alone. Same
  /// bits for any number of threads.
  void refine(const Field& u, double psi, const FrozenAcceleration& frozen, Field& f);
  /// The same for f = K u.
  void refine_linear(const Field& u, Field& f);
  /// Adds what further forces F [N] give to nodes at rest, -m a_eff: f -= M B M^-1 F. Model frame of a body that is not
  /// turned, or any frame that turns with it.
  void add_forces(const std::vector<NodalForce>& forces, Field& f);
  /// True at lines of fine nodes, per block and section node.
  const std::vector<std::vector<bool>>& fine() const { return fine_; }

 private:
  struct Copy {
    std::ptrdiff_t body, part;  // first value of a line in the body's fields and in the part's
    int count;
    bool free, fine;
  };
  struct Part {  // the elements that touch a fine node as a body of their own
    explicit Part(const SweptBody& mesh, const std::vector<Elastic>& materials, const ElementOptions& options);
    Body body;
    Traversal traversal;
    std::vector<Copy> lines;
    Field start, moved, stretched, force, frozen;  // u_n, u_n + P d, P d, forces; forces at u_n
    Field now, before, acceleration, inverse_mass, arm;
  };
  void add_line(const Body& whole, int block, int node, int component, int part_block, int part_node);
  /// Stages from the accelerations in part_ on; leaves d_p in part_->now. force: what is added to the frozen forces at
  /// u_n + P d.
  template <class Force>
  void run_stages(Force&& added_force);
  template <class Force>
  void refine_with(const Field& u, const FrozenAcceleration& frozen, Field& f, Force&& force);

  std::vector<std::vector<bool>> fine_, acts_on_;
  std::unique_ptr<Part> part_;
  Stages stages_{1};
  double step_ = 0;
};

/// How the running surface answers impulses on it, by the stages of local steps: B M^-1 for every surface column and
/// component, among the fine stations, whose spacing is the same. Stages carry an impulse no further than their number
/// of stations. Empty if no surface node is acted on.
SurfaceResponse surface_response(const Body& body, const ContactSurface& surface, LocalSteps& steps);

}  // namespace railstrata
